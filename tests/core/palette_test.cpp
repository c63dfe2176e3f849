// Protects: a move has one colour everywhere, told from others by its direction; schedules have colours of
// their own.
#include "bn/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <tuple>

namespace bn {
namespace {

int spread(const Rgb8& c) { return std::max({c.red, c.green, c.blue}) - std::min({c.red, c.green, c.blue}); }

TEST(MoveColour, IsGreyWithoutAMoveAndDiffersByDirection) {
  EXPECT_LE(spread(move_colour({0, 0}, 6.0)), 2);
  std::set<std::tuple<int, int, int>> seen;
  for (const Offset move : {Offset{6, 0}, {-6, 0}, {0, 6}, {0, -6}, {4, 4}, {-4, 4}, {4, -4}, {-4, -4}}) {
    const Rgb8 c = move_colour(move, 6.0);
    EXPECT_GT(spread(c), 60);
    EXPECT_TRUE(seen.emplace(c.red / 16, c.green / 16, c.blue / 16).second);
  }
}

TEST(MoveColour, GrowsWithTheLengthAndIsFullAtTheLongest) {
  int before = -1;
  for (int x = 0; x <= 6; ++x) {
    EXPECT_GT(spread(move_colour({x, 0}, 6.0)), before);
    before = spread(move_colour({x, 0}, 6.0));
  }
  EXPECT_EQ(move_colour({60, 0}, 6.0), move_colour({6, 0}, 6.0));
}

TEST(MoveDisc, ShowsEveryDirectionOnItsSide) {
  const Rgb8 outside{1, 2, 3};
  const Grid<Rgb8> disc = move_disc(65, outside);
  EXPECT_EQ(disc(0, 0), outside);
  EXPECT_EQ(disc(64, 64), outside);
  EXPECT_LE(spread(disc(32, 32)), 2);
  const auto near = [](const Rgb8& a, const Rgb8& b) {
    return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue) < 30;
  };
  EXPECT_TRUE(near(disc(63, 32), move_colour({6, 0}, 6.0)));
  EXPECT_TRUE(near(disc(32, 63), move_colour({0, 6}, 6.0)));
  EXPECT_TRUE(near(disc(1, 32), move_colour({-6, 0}, 6.0)));
  EXPECT_EQ(move_disc(1, outside).count(), 1u);
}

TEST(ScaleColour, GetsLighter) {
  int before = -1;
  for (int i = 0; i <= 20; ++i) {
    const Rgb8 c = scale_colour(i / 20.0);
    const int light = 3 * c.red + 6 * c.green + c.blue;
    EXPECT_GT(light, before);
    before = light;
  }
  EXPECT_EQ(scale_colour(-1.0), scale_colour(0.0));
  EXPECT_EQ(scale_colour(9.0), scale_colour(1.0));
}

TEST(ScheduleColour, IsOneOfTheCurvesForEveryName) {
  std::set<int> seen;
  for (const char* name :
       {"exponential", "kirkpatrick", "linear", "inverse", "hajek", "constant", "greedy"}) {
    EXPECT_TRUE(seen.insert(schedule_colour_number(name)).second) << name;
  }
  EXPECT_EQ(*seen.rbegin(), 6);
  EXPECT_EQ(schedule_colour_number("of my own"), 6);
}

}  // namespace
}  // namespace bn
