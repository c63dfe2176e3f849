// Protects: a move and a schedule have the same colour in the window as on the contact sheet and in figures.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "bn/palette.h"
#include "ui/run_pictures.h"
#include "ui/theme.h"

namespace bn::ui {
namespace {

TEST(OffsetPicture, HasTheColoursOfThePalette) {
  RetargetOptions options{.motion = {1, 0}, .radius = 2};
  Grid<Offset> move({2, 2}, Offset{1, 0});
  move(1, 0) = {3, 0};
  move(0, 1) = {1, -2};
  const Picture picture = offset_picture(move, options);
  const auto colour = [&](Offset offset) {
    return screen_colour(move_colour(offset, longest_move(options)));
  };
  EXPECT_EQ(picture.colours[0], colour({0, 0})) << "the motion itself is no move";
  EXPECT_EQ(picture.colours[1], colour({2, 0}));
  EXPECT_EQ(picture.colours[2], colour({0, -2}));
  EXPECT_NE(picture.colours[0], IM_COL32_WHITE);
}

TEST(DifferencePicture, HasAScaleThatShowsWhatIsThere) {
  Grid<std::int32_t> levels({16, 16});
  for (std::size_t i = 0; i < levels.count(); ++i) levels[i] = static_cast<std::int32_t>(i);
  const Grid<Offset> still({16, 16}, Offset{0, 0});
  // Every level differs from its right neighbour's by 1, but at the border.
  EXPECT_EQ(difference_picture(levels, still, {1, 0}, 1).high, 255.0f);
  EXPECT_EQ(difference_picture(levels, still, {1, 0}, 8).high, 32.0f);
  EXPECT_EQ(difference_picture(levels, still, {0, 1}, 0).high, 255.0f) << "16, or 240 at the border";
  EXPECT_EQ(difference_picture(levels, still, {0, 0}, 0).high, 1.0f);
  levels[0] = 3;
  EXPECT_EQ(difference_picture(Grid<std::int32_t>({16, 16}, 5), still, {1, 0}, 0).high, 1.0f);
  Grid<std::int32_t> nearly({16, 16}, 5);
  for (std::size_t i = 0; i < 256; i += 4) nearly[i] = 17;
  EXPECT_EQ(difference_picture(nearly, still, {1, 0}, 0).high, 16.0f) << "the power of two above 12";
}

TEST(Palette, IsTheOneOfFiguresOnLightAndDarkPages) {
  std::ifstream file(BN_PLOTS "/figures.gnuplot");
  const std::string script(std::istreambuf_iterator<char>(file), {});
  for (const auto* palette : {&kCurvePalette, &kDarkCurvePalette}) {
    std::string hues;
    for (const Rgb8 c : *palette) {
      char hex[9];
      std::snprintf(hex, sizeof hex, "%s#%02x%02x%02x", hues.empty() ? "" : " ", c.red, c.green, c.blue);
      hues += hex;
    }
    EXPECT_NE(script.find('"' + hues + '"'), std::string::npos) << hues;
  }
}

TEST(Palette, TellsRunsOfOneScheduleApart) {
  EXPECT_EQ(schedule_colour("hajek"), curve_colour(schedule_colour_number("hajek")));
  EXPECT_NE(schedule_colour("hajek", 0), schedule_colour("hajek", 1));
  EXPECT_NE(schedule_colour("hajek", 1), schedule_colour("hajek", 2));
}

}  // namespace
}  // namespace bn::ui
