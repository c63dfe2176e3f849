// Protects: the baselines are the published patterns, each a permutation (or a tiling of one).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bn/error.h"
#include "bn/noise.h"

namespace bn {
namespace {

bool is_permutation(const Grid<std::uint32_t>& rank) {
  std::vector<bool> seen(rank.count());
  for (const std::uint32_t r : rank) {
    if (r >= rank.count() || seen[r]) return false;
    seen[r] = true;
  }
  return true;
}

TEST(Baselines, ArePermutations) {
  for (const Extent size : {Extent{1, 1}, Extent{64, 64}, Extent{33, 7}, Extent{1, 50}}) {
    EXPECT_TRUE(is_permutation(white_noise_mask(size, 3)));
    EXPECT_TRUE(is_permutation(interleaved_gradient_mask(size)));
    EXPECT_TRUE(is_permutation(r2_mask(size)));
  }
  for (const int side : {1, 2, 8, 256}) EXPECT_TRUE(is_permutation(bayer_mask(side)));
  for (const auto& slice : golden_ratio_slices(white_noise_mask({16, 8}, 1), 40))
    EXPECT_TRUE(is_permutation(slice));
}

TEST(Baselines, BayerIsThePublishedMatrix) {
  const std::vector<std::uint32_t> wanted{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  const Grid<std::uint32_t> matrix = bayer_mask(4);
  EXPECT_EQ(std::vector<std::uint32_t>(matrix.begin(), matrix.end()), wanted);
}

TEST(Baselines, WhiteNoiseDependsOnItsSeed) {
  EXPECT_EQ(white_noise_mask({64, 64}, 1), white_noise_mask({64, 64}, 1));
  EXPECT_FALSE(white_noise_mask({64, 64}, 1) == white_noise_mask({64, 64}, 2));
}

TEST(Baselines, WhiteNoiseFillsEveryPlaceAlike) {
  // Mean rank of 16 places over 4000 seeds: standard deviation sqrt(255/12/4000) = 0.073; five of them.
  std::vector<double> sum(16);
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const auto rank = white_noise_mask({4, 4}, seed);
    for (std::size_t i = 0; i < 16; ++i) sum[i] += rank[i];
  }
  for (const double s : sum) EXPECT_NEAR(s / 4000, 7.5, 0.37);
}

TEST(Baselines, GradientNoiseAndR2FollowTheirFormulas) {
  const auto gradient = interleaved_gradient_mask({40, 30});
  const auto r2 = r2_mask({40, 30});
  const auto fraction = [](long double v) { return v - std::floor(v); };
  const long double g = 1.32471795724474602596L;
  const auto gradient_value = [&](int x, int y) {
    return fraction(52.9829189L * fraction(0.06711056L * x + 0.00583715L * y));
  };
  const auto r2_value = [&](int x, int y) { return fraction(x / g + y / (g * g)); };
  // A share of the pixels lies below a value: ranks and values agree to within what the pattern's discrepancy
  // allows, and in order exactly (but for ties).
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x + 1 < 40; ++x) {
      if (std::abs(gradient_value(x, y) - gradient_value(x + 1, y)) > 1e-9L) {
        ASSERT_EQ(gradient(x, y) < gradient(x + 1, y), gradient_value(x, y) < gradient_value(x + 1, y));
      }
      ASSERT_EQ(r2(x, y) < r2(x + 1, y), r2_value(x, y) < r2_value(x + 1, y));
      ASSERT_NEAR(r2(x, y) / 1200.0, static_cast<double>(r2_value(x, y)), 0.02);
    }
  }
}

TEST(Baselines, GoldenRatioRunsThroughEachPixelEvenly) {
  const auto mask = white_noise_mask({16, 16}, 1);
  const auto slices = golden_ratio_slices(mask, 13);
  EXPECT_EQ(slices[0], mask);
  for (std::size_t t = 1; t < slices.size(); ++t) {
    const auto shift =
        static_cast<std::uint32_t>(256 * (static_cast<double>(t) / 1.618033988749895 -
                                          std::floor(static_cast<double>(t) / 1.618033988749895)));
    for (std::size_t i = 0; i < mask.count(); ++i) ASSERT_EQ(slices[t][i], (mask[i] + shift) % 256);
  }
}

TEST(Baselines, TilesRepeat) {
  const auto tile = white_noise_mask({5, 4}, 1);
  const auto picture = tiled(tile, {13, 11});
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 13; ++x) ASSERT_EQ(picture(x, y), tile(x % 5, y % 4));
  }
}

TEST(Baselines, RefuseSidesOutOfRange) {
  EXPECT_THROW(white_noise_mask({0, 4}, 1), Error);
  EXPECT_THROW(r2_mask({4, 16385}), Error);
  EXPECT_THROW(interleaved_gradient_mask({-1, 4}), Error);
  EXPECT_THROW(bayer_mask(48), Error);
  EXPECT_THROW(bayer_mask(0), Error);
  EXPECT_THROW(golden_ratio_slices(Grid<std::uint32_t>({2, 2}, 4u), 3), Error);
  EXPECT_THROW(tiled(Grid<std::uint32_t>{}, {4, 4}), Error);
}

}  // namespace
}  // namespace bn
