// Protects: the index convention y * W + x and the two ways of wrapping, over every small period.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bn/grid.h"

namespace bn {
namespace {

TEST(Grid, IndexIsRowMajorFromTheTopLeft) {
  Grid<int> grid({3, 2});
  grid(2, 1) = 7;
  EXPECT_EQ(grid[5], 7);
  EXPECT_EQ(grid.torus(-1, -1), 7);
  EXPECT_EQ(grid.torus(5, 3), 7);
}

TEST(Wrap, IsCongruentAndInRange) {
  for (int period = 1; period <= 9; ++period) {
    for (int value = -40; value <= 40; ++value) {
      const int plain = wrap(value, period);
      const int centred = wrap_centred(value, period);
      EXPECT_TRUE(plain >= 0 && plain < period);
      EXPECT_EQ((value - plain) % period, 0);
      EXPECT_EQ((value - centred) % period, 0);
      EXPECT_TRUE(centred >= -(period / 2) && centred <= (period - 1) / 2) << value << " mod " << period;
      // No other representative is nearer to zero.
      EXPECT_LE(std::abs(centred), std::min(plain, period - plain));
    }
  }
}

TEST(Extent, AreaDoesNotOverflow) { EXPECT_EQ((Extent{1 << 20, 1 << 20}).area(), std::int64_t{1} << 40); }

}  // namespace
}  // namespace bn
