// Protects: the solver finds the optimum, with proof, on every small tile: against all permutations of
// tiny ones and against the Hungarian method on the full cost matrix, over all options.
#include <gtest/gtest.h>

#include <ostream>

#include "bn/error.h"
#include "bn/random.h"
#include "reference.h"

namespace bn {
namespace {

void expect_optimum(const MaskLevels& levels, const RetargetOptions& options, std::int64_t optimum) {
  const RetargetTile tile = solve_retarget(levels, options, {.threads = 1});
  SCOPED_TRACE(testing::Message() << levels.size().width << "x" << levels.size().height << " step "
                                  << options.step.x << "," << options.step.y << " motion " << options.motion.x
                                  << "," << options.motion.y << " radius " << options.radius << " euclidean "
                                  << (options.reach == Reach::euclidean) << " l2 "
                                  << (options.metric == Metric::l2) << " wrap " << options.wrap);
  EXPECT_EQ(tile.energy, optimum);
  EXPECT_EQ(tile.lower_bound, optimum);
  EXPECT_EQ(tile.energy, retarget_energy(levels, tile.move, options));
  EXPECT_NO_THROW(check_permutation(tile.move, options));
}

/// Calls body(options) for a spread of all options, motions and steps drawn from `seed`.
template <class Body>
void for_all_options(std::uint64_t seed, const std::vector<int>& radii, Body&& body) {
  std::uint64_t draw = 0;
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random_bits(seed, 2, draw++) % static_cast<std::uint64_t>(high - low + 1));
  };
  for (const int radius : radii) {
    for (const Reach reach : {Reach::chebyshev, Reach::euclidean}) {
      for (const Metric metric : {Metric::l1, Metric::l2}) {
        for (const bool wrapped : {true, false}) {
          RetargetOptions options;
          options.radius = radius;
          options.reach = reach;
          options.metric = metric;
          options.wrap = wrapped;
          options.step = {between(-9, 9), between(-9, 9)};
          options.motion = {between(-4, 4), between(-4, 4)};
          body(options);
        }
      }
    }
  }
}

TEST(SmallTiles, EveryPermutationOfTinyTiles) {
  std::uint64_t seed = 0;
  for (const Extent size :
       {Extent{1, 1}, Extent{2, 1}, Extent{1, 5}, Extent{2, 2}, Extent{2, 3}, Extent{3, 3}, Extent{4, 2}}) {
    for (const std::int32_t bound : {2, 7, 256}) {
      const auto levels = random_levels(size, ++seed, bound);
      for_all_options(seed, {1, 2, 6}, [&](const RetargetOptions& options) {
        expect_optimum(levels, options, enumerate_optimum(cost_matrix(levels, options)));
      });
    }
  }
}

TEST(SmallTiles, HungarianMethodOnSmallTiles) {
  std::uint64_t seed = 100;
  for (const Extent size : {Extent{5, 5}, Extent{5, 7}, Extent{8, 6}, Extent{8, 8}, Extent{1, 40},
                            Extent{33, 2}, Extent{17, 9}}) {
    for (const std::int32_t bound : {2, 16, 256, 65536, 1 << 24}) {
      const auto levels = random_levels(size, ++seed, bound);
      for_all_options(seed, {1, 2, 3, 6, 8, 32}, [&](const RetargetOptions& options) {
        expect_optimum(levels, options, hungarian_optimum(cost_matrix(levels, options)));
      });
    }
  }
}

// The next frame's mask need not be this frame's, moved.
TEST(SmallTiles, BetweenTwoMasks) {
  std::uint64_t seed = 200;
  for (const Extent size : {Extent{2, 3}, Extent{3, 3}, Extent{5, 7}, Extent{8, 8}, Extent{17, 9}}) {
    for (const std::int32_t bound : {2, 256, 65536}) {
      const auto from = random_levels(size, ++seed, bound), to = random_levels(size, ++seed, bound / 2 + 1);
      for_all_options(seed, {1, 2, 6}, [&](const RetargetOptions& options) {
        expect_optimum({from, to}, options, hungarian_optimum(cost_matrix({from, to}, options)));
      });
    }
  }
}

TEST(SmallTiles, AMovedMaskIsTheSecondOfAPair) {
  const auto mask = random_levels({12, 9}, 300, 256);
  for_all_options(301, {2, 6}, [&](const RetargetOptions& options) {
    if (!options.wrap) return;  // the border lies where the seeds land, which the step moves
    Grid<std::int32_t> moved(mask.size());
    for (int y = 0; y < mask.height(); ++y) {
      for (int x = 0; x < mask.width(); ++x) moved(x, y) = mask.torus(x + options.step.x, y + options.step.y);
    }
    RetargetOptions still = options;
    still.step = {0, 0};
    EXPECT_EQ(solve_retarget({mask, moved}, still).energy, solve_retarget(mask, options).energy);
  });
}

TEST(SmallTiles, MasksOfTwoSizesAreRefused) {
  const auto from = random_levels({8, 8}, 1, 256), to = random_levels({8, 4}, 2, 256);
  EXPECT_THROW(solve_retarget({from, to}, {}), Error);
  EXPECT_THROW(solve_motion_set({from, to}, {}, 1), Error);
  EXPECT_THROW(retarget_energy({from, to}, Grid<Offset>({8, 8}), {}), Error);
}

}  // namespace
}  // namespace bn
