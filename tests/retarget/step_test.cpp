// Protects: orbit lengths against counting, and the automatic step against a search of every step.
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "bn/error.h"
#include "bn/retarget.h"

namespace bn {
namespace {

std::int64_t count_orbit(Extent size, Offset step) {
  std::set<std::pair<int, int>> seen;
  for (std::int64_t t = 0;; ++t) {
    if (!seen.insert({wrap(t * step.x, size.width), wrap(t * step.y, size.height)}).second) return t;
  }
}

TEST(Step, OrbitLengthIsTheNumberOfOffsetsVisited) {
  for (const Extent size : {Extent{1, 1}, Extent{4, 6}, Extent{5, 7}, Extent{9, 1}, Extent{16, 16}}) {
    for (int y = -2; y <= 7; ++y) {
      for (int x = -5; x <= 9; ++x) EXPECT_EQ(orbit_length(size, {x, y}), count_orbit(size, {x, y}));
    }
  }
  EXPECT_EQ(orbit_length({64, 64}, {48, 36}), 16);
  EXPECT_EQ(orbit_length({64, 64}, {49, 37}), 64);
  EXPECT_EQ(orbit_length({16384, 16381}, {1, 1}), std::int64_t{16384} * 16381);
  EXPECT_THROW(orbit_length({0, 4}, {1, 1}), Error);
}

TEST(Step, AutoIsTheNearestOfLongestOrbit) {
  const double g = 1.32471795724474602596;
  for (int height = 1; height <= 24; ++height) {
    for (int width = 1; width <= 24; ++width) {
      const Extent size{width, height};
      std::tuple<std::int64_t, double, int, int> best{0, 0, 0, 0};
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double dx = x - width / g, dy = y - height / (g * g);
          best = std::min(best, {-orbit_length(size, {x, y}), dx * dx + dy * dy, y, x});
        }
      }
      const AutoStep found = auto_step(size);
      EXPECT_EQ(found.orbit_length, -std::get<0>(best));
      EXPECT_EQ(found.step, (Offset{std::get<3>(best), std::get<2>(best)})) << width << "x" << height;
    }
  }
  EXPECT_EQ(auto_step({64, 64}).step, (Offset{48, 37}));
  EXPECT_EQ(auto_step({64, 64}).orbit_length, 64);
}

}  // namespace
}  // namespace bn
