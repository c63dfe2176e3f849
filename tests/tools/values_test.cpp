// Protects: a value is read whole or not at all, in its range, the same in every locale; messages name the
// option and the range; what a kind shows, it reads back.
#include "tools/values.h"

#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn/options.h"

namespace bn::tools {
namespace {

template <class T>
std::string refusal(const ValueKind<T>& kind, std::string_view text) {
  try {
    kind.parse(text, "--flag");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    return error.what();
  }
  return "accepted";
}

TEST(Values, IntegersAreWholeAndInRange) {
  const auto kind = integer_in(1, 32);
  EXPECT_EQ(kind.parse("1", ""), 1);
  EXPECT_EQ(kind.parse("32", ""), 32);
  EXPECT_EQ(refusal(kind, "33"), "--flag: '33' is out of range (allowed: 1..32)");
  EXPECT_EQ(refusal(kind, "99999999999999999999"),
            "--flag: '99999999999999999999' is out of range (allowed: 1..32)");
  for (const char* text : {"", " ", "6x", " 6", "6 ", "+6", "6.0", "0x6", "six", "--6"}) {
    EXPECT_NE(refusal(kind, text).find("is no whole number (allowed: 1..32)"), std::string::npos) << text;
  }
}

TEST(Values, ListsOfIntegers) {
  const auto kind = integer_list(0, 63, 3);
  EXPECT_EQ(kind.parse("5", ""), (std::vector<int>{5}));
  EXPECT_EQ(kind.parse("0,63,2", ""), (std::vector<int>{0, 63, 2}));
  EXPECT_EQ(kind.show({1, 2}), "1,2");
  EXPECT_EQ(refusal(kind, "0,64"),
            "--flag: '0,64' has a number out of range (allowed: 1..3 whole numbers, each 0..63)");
  EXPECT_NE(refusal(kind, "1,2,3,4").find("is too long"), std::string::npos);
  for (const char* text : {"", ",", "1,", ",1", "1;2", "1, 2", "a"})
    EXPECT_NE(refusal(kind, text).find("is no list of numbers"), std::string::npos) << text;
}

TEST(Values, RealsRefuseNanAndInfinity) {
  const auto kind = real_in(0.3, 16, "pixels");
  EXPECT_EQ(kind.parse("1.9", ""), 1.9);
  EXPECT_EQ(kind.parse("16", ""), 16.0);
  for (const char* text : {"nan", "inf", "-1", "0.29", "16.01", "1e9"}) {
    EXPECT_EQ(refusal(kind, text),
              std::string("--flag: '") + text + "' is out of range (allowed: 0.3..16 pixels)");
  }
  for (const char* text : {"", "1,9", "1.9px", "1.9 ", "1e999"}) {
    EXPECT_NE(refusal(kind, text), "accepted") << text;
  }
}

TEST(Values, PercentagesNeedTheirSign) {
  const auto kind = percentage_in(0, 100);
  EXPECT_EQ(kind.parse("0.5%", ""), 0.005);
  EXPECT_EQ(kind.parse("0", ""), 0.0);
  EXPECT_EQ(refusal(kind, "0.5"), "--flag: '0.5' has no % sign (allowed: 0%..100%); write 0.5%");
  EXPECT_NE(refusal(kind, "101%"), "accepted");
  EXPECT_NE(refusal(kind, "%"), "accepted");
  EXPECT_NE(refusal(kind, "nan%"), "accepted");
}

TEST(Values, SeedsFitARecipe) {
  EXPECT_EQ(seed_value().parse("9223372036854775807", ""), ~std::uint64_t{0} >> 1);
  for (const char* text : {"9223372036854775808", "99999999999999999999", "-1", "", "1.0"}) {
    EXPECT_NE(refusal(seed_value(), text).find("(allowed: 0..9223372036854775807)"), std::string::npos)
        << text;
  }
}

TEST(Values, SizesAndSteps) {
  const auto size = extent_in(1, 16384);
  EXPECT_EQ(size.parse("256x128", ""), (Extent{256, 128}));
  for (const char* text :
       {"", "256", "256x", "x256", "256x128x4", "256X128", "256 x 128", "-1x4", "0x4", "16385x1"}) {
    EXPECT_NE(refusal(size, text), "accepted") << text;
  }
  const auto step = offset_or_auto();
  EXPECT_EQ(step.parse("48,36", ""), (Offset{48, 36}));
  EXPECT_EQ(step.parse("-5,0", ""), (Offset{-5, 0}));
  EXPECT_EQ(step.parse("auto", ""), std::nullopt);
  for (const char* text : {"", "48", "48,", ",36", "48,36,1", "48, 36", "Auto", "4.5,3", "9999999999,0"}) {
    EXPECT_NE(refusal(step, text), "accepted") << text;
  }
}

TEST(Values, MemorySizesSaturateNowhere) {
  const auto kind = memory_size();
  EXPECT_EQ(kind.parse("8G", ""), std::uint64_t{8} << 30);
  EXPECT_EQ(kind.parse("1M", ""), std::uint64_t{1} << 20);
  EXPECT_EQ(kind.parse("16777215T", ""), std::uint64_t{16777215} << 40);
  for (const char* text :
       {"", "8", "G", "8GB", "8g", "-8G", "1K", "16777216T", "99999999999999999999G", "1.5G"}) {
    EXPECT_NE(refusal(kind, text), "accepted") << text;
  }
}

TEST(Values, WhatIsShownReadsBack) {
  const auto check = [](const auto& kind, const auto& value) {
    EXPECT_EQ(kind.parse(kind.show(value), ""), value);
  };
  check(integer_in(-9, 9), -7);
  check(seed_value(), ~std::uint64_t{0} >> 1);
  check(real_in(0, 1), 0.1);
  check(percentage_in(0, 100), 0.005);
  check(extent_in(1, 9), Extent{3, 4});
  check(offset_or_auto(), std::optional<Offset>(Offset{-3, 4}));
  check(offset_or_auto(), std::optional<Offset>());
  check(memory_size(), std::uint64_t{1536} << 20);
  check(memory_size(), std::uint64_t{3} << 40);
}

TEST(Values, ChoicesSuggestTheNearest) {
  const auto kind = choice_of<int>({{"chebyshev", 1}, {"euclidean", 2}});
  EXPECT_EQ(kind.parse("euclidean", ""), 2);
  EXPECT_EQ(refusal(kind, "euclidian"),
            "--flag: 'euclidian' is not a choice (allowed: chebyshev, euclidean); did you mean euclidean?");
  EXPECT_EQ(refusal(kind, "manhattan"),
            "--flag: 'manhattan' is not a choice (allowed: chebyshev, euclidean)");
}

TEST(Values, NearestWordCountsEdits) {
  const std::vector<std::string> words{"bake", "noise", "info", "verify"};
  EXPECT_EQ(nearest_word("bkae", words), "bake");  // two letters swapped
  EXPECT_EQ(nearest_word("verfy", words), "verify");
  EXPECT_EQ(nearest_word("inof", words), "info");
  EXPECT_EQ(nearest_word("bakery", words), "bake");  // goes on after a whole word
  EXPECT_EQ(nearest_word("veri", words), "verify");  // breaks off
  EXPECT_EQ(nearest_word("spectrum", words), "");
  EXPECT_EQ(nearest_word("", words), "");
}

}  // namespace
}  // namespace bn::tools
