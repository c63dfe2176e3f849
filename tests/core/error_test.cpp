// Protects: a message always says where, what, limit and remedy, and leaves no empty brackets.
#include <gtest/gtest.h>

#include "bn/error.h"

namespace bn {
namespace {

TEST(Error, SaysEveryPart) {
  const Error error({.code = ErrorCode::invalid_input,
                     .what = "radius 40",
                     .where = "a.toml:7",
                     .limit = "1..32",
                     .remedy = "choose a smaller radius"});
  EXPECT_STREQ(error.what(), "a.toml:7: radius 40 (allowed: 1..32); choose a smaller radius");
  EXPECT_EQ(error.code(), ErrorCode::invalid_input);
}

TEST(Error, LeavesOutEmptyParts) {
  const Error error({.code = ErrorCode::io, .what = "disk full", .where = "", .limit = "", .remedy = ""});
  EXPECT_STREQ(error.what(), "disk full");
}

}  // namespace
}  // namespace bn
