// Protects: text is told from other bytes exactly.
#include "core/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace bn {
namespace {

using namespace std::string_view_literals;

TEST(Utf8, KnowsTheFirstAndLastOfEachLength) {
  for (const std::string_view text :
       {""sv, "\0\x7f"sv, "\xc2\x80"sv, "\xdf\xbf"sv, "\xe0\xa0\x80"sv, "\xed\x9f\xbf"sv, "\xee\x80\x80"sv,
        "\xef\xbf\xbf"sv, "\xf0\x90\x80\x80"sv, "\xf4\x8f\xbf\xbf"sv}) {
    EXPECT_TRUE(is_utf8(text)) << text;
    EXPECT_TRUE(is_utf8("a" + std::string(text) + "b"));
  }
}

TEST(Utf8, RefusesEverythingElse) {
  for (const std::string_view text :
       {"\x80"sv, "\xbf"sv, "\xc0\x80"sv, "\xc1\xbf"sv, "\xe0\x9f\xbf"sv, "\xed\xa0\x80"sv, "\xed\xbf\xbf"sv,
        "\xf0\x8f\xbf\xbf"sv, "\xf4\x90\x80\x80"sv, "\xf5\x80\x80\x80"sv, "\xff"sv, "\xc2"sv, "\xe2\x82"sv,
        "\xf0\x9f\x98"sv, "\xc2\x41"sv, "\xe2\x28\xa1"sv, "m\xe9.png"sv}) {
    EXPECT_FALSE(is_utf8(text)) << text.size();
    EXPECT_FALSE(is_utf8("a" + std::string(text) + "b"));
  }
}

}  // namespace
}  // namespace bn
