// Protects: masks are as blue as promised, their 8-bit histogram is flat, and the initial pattern is
// one that Ulichney's swaps would leave alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <iostream>
#include <numbers>
#include <vector>

#include "bn/noise.h"
#include "bn/spatiotemporal.h"
#include "bn/random.h"
#include "reference_void_and_cluster.h"

namespace bn {
namespace {

constexpr int kSide = 128;
using Bands = std::array<double, 4>;

/// Mean of |F|² / (N variance), which is 1 for white noise, over radial frequencies 0 < f <= 1/16 < f
/// <= 2/16 < f <= 3/16 < f <= 4/16 cycles/pixel. A plain separable transform.
Bands band_power(const Grid<std::uint32_t>& ranks) {
  constexpr double kCount = kSide * kSide;
  constexpr double kMean = (kCount - 1.0) / 2.0;
  constexpr double kVariance = (kCount * kCount - 1.0) / 12.0;
  std::vector<std::complex<double>> turn(kSide);
  for (int i = 0; i < kSide; ++i)
    turn[static_cast<std::size_t>(i)] = std::polar(1.0, -2.0 * std::numbers::pi * i / kSide);

  Grid<std::complex<double>> rows({kSide, kSide});
  for (int y = 0; y < kSide; ++y) {
    for (int u = 0; u < kSide; ++u) {
      for (int x = 0; x < kSide; ++x)
        rows(u, y) += (ranks(x, y) - kMean) * turn[static_cast<std::size_t>(u * x % kSide)];
    }
  }
  Bands sum{};
  Bands entries{};
  for (int v = -kSide / 4; v <= kSide / 4; ++v) {
    for (int u = -kSide / 4; u <= kSide / 4; ++u) {
      const double f = std::hypot(u, v) / kSide;
      if (f == 0.0 || f > 0.25) continue;
      std::complex<double> value = 0.0;
      for (int y = 0; y < kSide; ++y)
        value += rows(wrap(u, kSide), y) * turn[static_cast<std::size_t>(wrap(v * y, kSide))];
      const auto band = static_cast<std::size_t>(std::ceil(f * 16.0)) - 1;
      sum[band] += std::norm(value) / (kCount * kVariance);
      entries[band] += 1.0;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= entries[i];
  return sum;
}

void expect_blue(double sigma_px, double initial_density, const Bands& limits) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Bands bands = band_power(void_and_cluster(
        {.size = {kSide, kSide}, .sigma_px = sigma_px, .initial_density = initial_density, .seed = seed}));
    for (std::size_t i = 0; i < bands.size(); ++i) {
      EXPECT_LE(bands[i], limits[i]) << "band " << i << ", sigma " << sigma_px << ", density "
                                     << initial_density << ", seed " << seed;
      EXPECT_GE(bands[i], limits[i] / 10.0) << "too good to be true: is the measure broken?";
    }
  }
}

TEST(Quality, WhiteNoiseReadsOne) {
  // Ranks in random order; the means of 196 and more exponential variates are within 0.3 of 1 with p >
  // 1 - 1e-4.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) keys.push_back({random_bits(1, 99, i), i});
  std::sort(keys.begin(), keys.end());
  Grid<std::uint32_t> ranks({kSide, kSide});
  for (std::uint32_t rank = 0; rank < keys.size(); ++rank) ranks[keys[rank].second] = rank;
  for (const double power : band_power(ranks)) EXPECT_NEAR(power, 1.0, 0.3);
}

TEST(Quality, BandPowerAtSigma19) { expect_blue(1.9, 0.0, {0.00005, 0.0004, 0.004, 0.065}); }
TEST(Quality, BandPowerAtSigma15) { expect_blue(1.5, 0.0, {0.00008, 0.0006, 0.0035, 0.025}); }
TEST(Quality, BandPowerWithInitialPattern) { expect_blue(1.9, 0.1, {0.00005, 0.0004, 0.004, 0.065}); }

/// Mean power at 0 < f <= 1/32 of the pattern of the ranks first..end-1, against white noise of that density.
double low_power(const Grid<std::uint32_t>& ranks, std::uint32_t first, std::uint32_t end) {
  double sum = 0.0;
  int entries = 0;
  for (int v = -kSide / 32; v <= kSide / 32; ++v) {
    for (int u = -kSide / 32; u <= kSide / 32; ++u) {
      if ((u == 0 && v == 0) || 32 * 32 * (u * u + v * v) > kSide * kSide) continue;
      std::complex<double> value = 0.0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          if (ranks(x, y) >= first && ranks(x, y) < end)
            value += std::polar(1.0, -2.0 * std::numbers::pi * (u * x + v * y) / kSide);
        }
      }
      sum += std::norm(value);
      ++entries;
    }
  }
  const double share = (end - first) / static_cast<double>(ranks.count());
  return sum / entries / (static_cast<double>(ranks.count()) * share * (1.0 - share));
}

TEST(Quality, SparsePatternsAreSpreadEvenly) {
  constexpr std::uint32_t kCount = kSide * kSide;
  constexpr std::uint32_t kLevel = kCount / 256;
  for (const double sigma : {1.9, 1.5}) {
    double first = 0.0, second = 0.0, last_but_one = 0.0, last = 0.0;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
      const Grid<std::uint32_t> ranks =
          void_and_cluster({.size = {kSide, kSide}, .sigma_px = sigma, .seed = seed});
      first += low_power(ranks, 0, kLevel) / 8.0;
      second += low_power(ranks, 0, 2 * kLevel) / 8.0;
      last_but_one += low_power(ranks, kCount - 2 * kLevel, kCount) / 8.0;
      last += low_power(ranks, kCount - kLevel, kCount) / 8.0;
    }
    EXPECT_LE(first, sigma == 1.9 ? 0.03 : 0.06) << "sigma " << sigma;
    EXPECT_LE(second, sigma == 1.9 ? 0.045 : 0.06) << "sigma " << sigma;
    EXPECT_LE(last_but_one, 0.08) << "sigma " << sigma;
    EXPECT_LE(last, 0.10) << "sigma " << sigma;
  }
}

/// Before their sparse ends were made, the first and the last of 256 levels read .55 to .83.
TEST(Quality, SparsePatternsOfSlicesAreSpreadEvenly) {
  constexpr std::uint32_t kCount = kSide * kSide;
  constexpr std::uint32_t kLevel = kCount / 256;
  constexpr int kSlices = 16;
  for (const auto preset :
       {SpatiotemporalPreset::both, SpatiotemporalPreset::filtered, SpatiotemporalPreset::stbn}) {
    const Grid<std::uint32_t> ranks = spatiotemporal_mask({.size = {kSide, kSide, kSlices}, .preset = preset});
    double first = 0.0, second = 0.0, last_but_one = 0.0, last = 0.0;
    for (int z = 0; z < kSlices; ++z) {
      Grid<std::uint32_t> slice({kSide, kSide});
      std::copy(ranks.slice(z).begin(), ranks.slice(z).end(), slice.begin());
      first += low_power(slice, 0, kLevel) / kSlices;
      second += low_power(slice, 0, 2 * kLevel) / kSlices;
      last_but_one += low_power(slice, kCount - 2 * kLevel, kCount) / kSlices;
      last += low_power(slice, kCount - kLevel, kCount) / kSlices;
    }
    std::cout << name_of(preset) << ": " << first << " " << second << " " << last_but_one << " " << last
              << "\n";
    const bool stbn = preset == SpatiotemporalPreset::stbn;
    EXPECT_LE(first, stbn ? 0.12 : 0.24) << name_of(preset);
    EXPECT_LE(second, 0.18) << name_of(preset);
    EXPECT_LE(last_but_one, stbn ? 0.12 : 0.24) << name_of(preset);
    EXPECT_LE(last, stbn ? 0.14 : 0.24) << name_of(preset);
  }
}

TEST(Quality, EightBitHistogramIsFlat) {
  const Grid<std::uint32_t> ranks = void_and_cluster({.size = {64, 32}});
  std::array<int, 256> histogram{};
  for (const std::uint32_t rank : ranks) ++histogram.at(std::uint64_t{rank} * 256 / ranks.count());
  for (const int entries : histogram) EXPECT_EQ(entries, 64 * 32 / 256);
}

TEST(Quality, SwapsLeaveTheInitialPatternAlone) {
  for (const double density : {0.05, 0.1, 0.3}) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      PlainPattern pattern({.size = {48, 48}, .seed = seed});
      for (int i = 0; i < density * 48 * 48; ++i) pattern.set(pattern.largest_void());
      int swaps = 0;
      for (;; ++swaps) {
        const std::size_t cluster = pattern.tightest_cluster();
        pattern.unset(cluster);
        const std::size_t hole = pattern.largest_void();
        pattern.set(hole);
        if (hole == cluster) break;
      }
      EXPECT_LE(swaps, 2) << "density " << density << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace bn
