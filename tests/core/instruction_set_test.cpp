// Protects: every listed instruction set can be forced and undone, and others are refused.
#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn/execution.h"

namespace bn {
namespace {

TEST(InstructionSet, ListedOnesCanBeForced) {
  const auto names = instruction_sets();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.back(), "SCALAR") << "the scalar code runs everywhere";
  for (const auto& name : names) EXPECT_NO_THROW(use_instruction_set(name));
  use_instruction_set("");
  EXPECT_EQ(instruction_sets(), names) << "forcing one must not hide the others";
}

TEST(InstructionSet, OthersAreRefused) { EXPECT_THROW(use_instruction_set("AVX9"), Error); }

}  // namespace
}  // namespace bn
