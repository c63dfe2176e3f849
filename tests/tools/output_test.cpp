// Protects: what people read: verdict words in colour as whole words only, nested results as lines.
#include "tools/output.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bn::tools {
namespace {

TEST(Output, ColoursVerdictsAndNothingElse) {
  EXPECT_EQ(with_coloured_verdicts("pass  a.png"), "\033[32mpass\033[0m  a.png");
  EXPECT_EQ(with_coloured_verdicts("b weak, c FAIL\n"), "b \033[33mweak\033[0m, c \033[1;31mFAIL\033[0m\n");
  for (const char* plain : {"", "4 of 4 checks passed", "bypass", "FAILED weakest 0.5", "grün"})
    EXPECT_EQ(with_coloured_verdicts(plain), plain);
}

TEST(Output, NestedNamesAreJoinedByDots) {
  EXPECT_EQ(lines_of({{"a", {{"b", 1}, {"c", {1, 2}}}}, {"long", true}}), "a.b   1\na.c   1,2\nlong  yes\n");
}

TEST(Output, AListOfThingsHasALineAThing) {
  const nlohmann::ordered_json files{{{"file", "a.png"}, {"hash", "1"}}, {{"file", "b.png"}, {"hash", "2"}}};
  EXPECT_EQ(lines_of({{"count", 2}, {"files", files}}), "count  2\nfiles  a.png  1\n       b.png  2\n");
}

TEST(Output, ParagraphsFitEightyColumnsAndLeaveWordsWhole) {
  EXPECT_EQ(paragraph("", 6), "");
  EXPECT_EQ(paragraph("short", 6), "      short\n");
  const std::string word(30, 'w');
  EXPECT_EQ(paragraph(word + " " + word + " " + word, 0), word + " " + word + "\n" + word + "\n");
  EXPECT_EQ(paragraph(std::string(80, 'x') + " y", 0), std::string(80, 'x') + "\ny\n");
  const std::string path = "/long/" + std::string(90, 'p');
  EXPECT_EQ(paragraph(path + ": it is", 2), "  " + path + ":\n  it is\n");
}

}  // namespace
}  // namespace bn::tools
