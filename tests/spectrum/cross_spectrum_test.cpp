// Protects: independent textures are told from one texture moved, repeated or inverted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bn/error.h"
#include "bn/judgement.h"
#include "bn/noise.h"
#include "direct_dft.h"

namespace bn {
namespace {

std::vector<double> mask(int side, std::uint64_t seed) {
  const auto rank = void_and_cluster({.size = {side, side}, .seed = seed});
  return {rank.begin(), rank.end()};
}

/// The second at p + (x, y) is what the first is at p.
std::vector<double> moved(const std::vector<double>& values, Shape shape, int x, int y, int z = 0) {
  std::vector<double> result(values.size());
  for (int w = 0; w < shape.depth; ++w) {
    for (int v = 0; v < shape.height; ++v) {
      for (int u = 0; u < shape.width; ++u) {
        const auto from = (static_cast<std::size_t>(w) * shape.height + v) * shape.width + u;
        const auto to = (static_cast<std::size_t>(wrap(w + z, shape.depth)) * shape.height +
                         static_cast<std::size_t>(wrap(v + y, shape.height))) *
                            shape.width +
                        static_cast<std::size_t>(wrap(u + x, shape.width));
        result[to] = values[from];
      }
    }
  }
  return result;
}

TEST(CrossSpectrum, EqualsItsDefinition) {
  const Shape shape{7, 6, 2};
  const auto a = midranks(test::white_values(shape.count(), 1)),
             b = midranks(test::white_values(shape.count(), 2));
  const CrossSpectrum cross = cross_spectrum(a, b, shape);
  const double n = static_cast<double>(shape.count()), middle = (n - 1) / 2, variance = (n * n - 1) / 12;
  double best = 0.0;
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 7; ++x) {
        const auto back = moved(b, shape, -x, -y, -z);
        double r = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) r += (a[i] - middle) * (back[i] - middle) / (n * variance);
        if (x == 0 && y == 0 && z == 0) {
          EXPECT_NEAR(cross.correlation, r, 1e-12);
        }
        if (wrap(cross.peak_x, 7) == x && wrap(cross.peak_y, 6) == y && wrap(cross.peak_z, 2) == z) {
          EXPECT_NEAR(cross.peak_correlation, r, 1e-12);
        }
        best = std::max(best, std::abs(r));
      }
    }
  }
  EXPECT_NEAR(std::abs(cross.peak_correlation), best, 1e-12);
}

TEST(CrossSpectrum, IndependentTexturesPass) {
  for (const int side : {16, 24, 64, 100}) {
    const Shape shape{side, side};
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      for (const auto& [a, b] :
           {std::pair(mask(side, seed), mask(side, seed + 100)),
            std::pair(test::white_values(shape.count(), seed), test::white_values(shape.count(), seed + 50)),
            std::pair(mask(side, seed), test::white_values(shape.count(), seed))}) {
        const CrossSpectrum cross = cross_spectrum(a, b, shape);
        EXPECT_TRUE(cross.independent()) << side << " " << cross.peak_correlation << " " << cross.limit;
        EXPECT_TRUE(relation_of(cross, "it").empty());
      }
    }
  }
}

TEST(CrossSpectrum, FindsWhereOneMaskWasMovedTo) {
  const Shape shape{32, 32};
  const auto a = mask(32, 1);
  for (const auto& [x, y] : {std::pair(5, 3), {-7, 12}, {0, 1}, {-16, 0}}) {
    const CrossSpectrum cross = cross_spectrum(a, moved(a, shape, x, y), shape);
    EXPECT_NEAR(cross.peak_correlation, 1.0, 1e-12);
    EXPECT_EQ(cross.peak_x, x);
    EXPECT_EQ(cross.peak_y, y);
    EXPECT_FALSE(cross.independent());
  }
  EXPECT_EQ(relation_of(cross_spectrum(a, moved(a, shape, 5, -3), shape), "channel 0"),
            "is channel 0 moved by (5, -3)");
  EXPECT_EQ(relation_of(cross_spectrum(a, a, shape), "channel 0"), "is channel 0 again");
}

TEST(CrossSpectrum, FindsAnInvertedAndAHalfMixedMask) {
  const Shape shape{32, 32};
  const auto a = mask(32, 1), b = mask(32, 2);
  std::vector<double> inverted(a), mixed(a);
  for (std::size_t i = 0; i < a.size(); ++i) inverted[i] = -a[i], mixed[i] = a[i] + b[i];
  const CrossSpectrum cross = cross_spectrum(a, inverted, shape);
  EXPECT_NEAR(cross.correlation, -1.0, 1e-12);
  EXPECT_EQ(relation_of(cross, "the first"), "is the first inverted");
  EXPECT_NE(relation_of(cross_spectrum(a, mixed, shape), "the first").find("resembles the first"),
            std::string::npos);
}

TEST(CrossSpectrum, CoherenceIsOneForEqualTexturesAndSmallForOthers) {
  const Shape shape{64, 64};
  const auto a = mask(64, 1), b = mask(64, 2);
  const CrossSpectrum same = cross_spectrum(a, a, shape), other = cross_spectrum(a, b, shape);
  for (std::size_t k = 0; k < kBandEdges.size(); ++k) {
    EXPECT_NEAR(same.coherence[k], 1.0, 1e-12);
    EXPECT_LT(other.coherence[k], 0.4);  // 24 independent frequencies in the lowest band
  }
}

TEST(CrossSpectrum, SaysWhatCannotBeTold) {
  const auto a = mask(64, 1);
  const std::vector<double> constant(a.size(), 3.0);
  const CrossSpectrum flat = cross_spectrum(a, constant, {64, 64});
  EXPECT_TRUE(std::isnan(flat.peak_correlation));
  EXPECT_TRUE(relation_of(flat, "x").empty());
  const std::vector<double> tiny{0, 3, 2, 1}, one{5};
  EXPECT_FALSE(cross_spectrum(tiny, tiny, {2, 2}).can_tell());
  EXPECT_TRUE(std::isnan(cross_spectrum(one, one, {1, 1}).correlation));
  EXPECT_THROW(cross_spectrum(a, tiny, {64, 64}), Error);
  std::vector<double> bad = a;
  bad[7] = std::nan("");
  EXPECT_THROW(cross_spectrum(a, bad, {64, 64}), Error);
}

TEST(CrossSpectrum, ThreadsChangeNoBit) {
  const Shape shape{48, 40, 3};
  const auto a = test::white_values(shape.count(), 1), b = test::white_values(shape.count(), 2);
  const CrossSpectrum one = cross_spectrum(a, b, shape, {.threads = 1}),
                      five = cross_spectrum(a, b, shape, {.threads = 5});
  EXPECT_EQ(one.peak_correlation, five.peak_correlation);
  EXPECT_EQ(one.limit, five.limit);
  EXPECT_EQ(one.coherence, five.coherence);
}

}  // namespace
}  // namespace bn
