// Protects: sequences are as even as promised, shifts stay on the mask and are far apart, sampled pixels
// follow the importance map, and the shaders do the same as the library.
#include "bn/offsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "bn/error.h"
#include "bn/noise.h"
#include "bn/random.h"

namespace bn {
namespace {

// textures/shaders/bn_offsets.glsl as C++: the very text that runs on the device.
namespace shader {
using uint = unsigned int;
#include "bn_offsets.glsl"
}  // namespace shader

double fraction(std::uint32_t offset) { return offset / 4294967296.0; }

TEST(Offsets, AreMultiplesOfTheirNumbers) {
  const double g = 1.32471795724474602596;
  for (const std::uint32_t i : {0u, 1u, 2u, 100u, 65535u}) {
    const auto expect = [&](std::uint32_t offset, double number) {
      const double wanted = i * number - std::floor(i * number);
      const double distance = std::abs(fraction(offset) - wanted);
      EXPECT_LT(std::min(distance, 1.0 - distance), (i + 1) * 2.5e-10) << i << " times " << number;
    };
    expect(golden_offset(i), (std::sqrt(5.0) - 1.0) / 2.0);
    expect(sqrt2_offset(i), std::sqrt(2.0));
    expect(r2_offset(i)[0], 1.0 / g);
    expect(r2_offset(i)[1], 1.0 / (g * g));
  }
}

/// The largest gap between neighbours of the first n offsets, in units of 1 / n: 1 if they are equidistant.
double largest_gap(std::uint32_t (*offset)(std::uint32_t), std::uint32_t n) {
  std::vector<double> at;
  for (std::uint32_t i = 0; i < n; ++i) at.push_back(fraction(offset(i)));
  std::sort(at.begin(), at.end());
  double gap = at.front() + 1.0 - at.back();
  for (std::size_t i = 1; i < at.size(); ++i) gap = std::max(gap, at[i] - at[i - 1]);
  return gap * n;
}

TEST(Offsets, AreEvenAfterAnyNumberOfFrames) {
  for (std::uint32_t n = 1; n <= 300; ++n) {
    EXPECT_LE(largest_gap(golden_offset, n), 2.2)
        << n;  // the three-gap theorem: below 1 + 2 / sqrt(5) and a little
    EXPECT_LE(largest_gap(sqrt2_offset, n), 2.5) << n;
  }
}

TEST(Offsets, RotationKeepsHistogramsFlat) {
  for (const std::uint32_t frame : {0u, 1u, 7u, 1000u}) {
    std::vector<int> entries(256);
    for (int i = 0; i < 256; ++i) {
      const float value = rotated((static_cast<float>(i) + 0.5f) / 256.0f, golden_offset(frame));
      ASSERT_GE(value, 0.0f);
      ASSERT_LT(value, 1.0f);
      ++entries[static_cast<std::size_t>(value * 256.0f)];
    }
    EXPECT_EQ(std::count(entries.begin(), entries.end(), 1), 256);
  }
  EXPECT_LT(rotated(std::nextafter(1.0f, 0.0f), UINT32_MAX), 1.0f);
}

TEST(Shifts, StayOnTheMaskAndBeginAtItsOrigin) {
  for (const Extent size : {Extent{1, 1}, {64, 64}, {128, 37}, {16384, 3}}) {
    EXPECT_EQ(r2_shift(0, size), (Offset{0, 0}));
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const Offset shift = r2_shift(i * 977, size);
      ASSERT_TRUE(shift.x >= 0 && shift.x < size.width && shift.y >= 0 && shift.y < size.height);
    }
  }
}

TEST(Shifts, ChangeFromCycleToCycle) {
  const Shape shape{64, 64, 32};
  for (std::uint32_t frame = 0; frame < 32; ++frame) EXPECT_EQ(cycle_shift(frame, shape), (Offset{0, 0}));
  std::set<std::pair<int, int>> met;
  for (std::uint32_t cycle = 0; cycle < 100; ++cycle) {
    const Offset shift = cycle_shift(cycle * 32 + 5, shape);
    met.insert({shift.x, shift.y});
  }
  EXPECT_EQ(met.size(), 100u);
}

TEST(Shifts, OfSamplesAreFarApart) {
  for (const Extent size : {Extent{64, 64}, {128, 128}, {256, 64}}) {
    for (const int count : {1, 2, 3, 4, 8, 16, 61}) {
      const std::vector<Offset> shifts = sample_shifts(count, size);
      ASSERT_EQ(std::ssize(shifts), count);
      EXPECT_EQ(shifts[0], (Offset{0, 0}));
      double least = 1e9;
      for (int a = 0; a < count; ++a) {
        for (int b = 0; b < a; ++b) {
          const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
          least = std::min(least, std::hypot(wrap_centred(shifts[i].x - shifts[j].x, size.width),
                                             wrap_centred(shifts[i].y - shifts[j].y, size.height)));
        }
      }
      // Of the densest packing, whose distance is sqrt(2 / sqrt(3) area / count).
      const double densest = std::sqrt(2.0 / std::sqrt(3.0) * static_cast<double>(size.area()) / count);
      if (count > 1) {
        EXPECT_GE(least, 0.6 * densest) << count << " on " << size.width << "x" << size.height;
      }
    }
  }
  EXPECT_THROW(sample_shifts(0, {64, 64}), Error);
  EXPECT_THROW(sample_shifts(5000, {64, 64}), Error);
}

TEST(Shifts, DepthsHaveNoFactorInCommonWithThePeriod) {
  EXPECT_EQ(coprime_depth(64, 8), 63);
  EXPECT_EQ(coprime_depth(64, 9), 64);
  EXPECT_EQ(coprime_depth(30, 210), 29);
  EXPECT_EQ(coprime_depth(1, 16), 1);
  EXPECT_THROW(coprime_depth(64, 0), Error);
}

TEST(SampledPixels, FollowTheImportanceMap) {
  const Grid<std::uint32_t> ranks = void_and_cluster({.size = {64, 64}});
  Grid<float> importance(Extent{128, 64});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) importance(x, y) = x < 64 ? 0.125f : 0.5f;
  }
  const Grid<std::uint8_t> sampled = sampled_pixels(ranks, importance, 0);
  int left = 0, right = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) (x < 64 ? left : right) += sampled(x, y);
  }
  EXPECT_EQ(left, 64 * 64 / 8);
  EXPECT_EQ(right, 64 * 64 / 2);
  Grid<float> broken(Extent{4, 4});
  broken(2, 2) = NAN;
  EXPECT_THROW(sampled_pixels(ranks, broken, 0), Error);
}

TEST(SampledPixels, MeetNewPixelsFromCycleToCycle) {
  const Grid<std::uint32_t> ranks = void_and_cluster({.size = {64, 64}});  // a stack of one slice
  Grid<float> importance(Extent{64, 64});
  std::fill(importance.begin(), importance.end(), 1.0f / 16.0f);
  EXPECT_EQ(distinct_pixels(ranks, importance, 1), 256);
  // Chosen at random, 1 - (15/16)^16 = .644 of the pixels would be met in 16 frames; without shifts .0625.
  EXPECT_GT(distinct_pixels(ranks, importance, 16), 0.6 * 64 * 64);
}

TEST(Shaders, OffsetsAreTheLibrarys) {
  for (std::uint32_t n = 0; n < 10000; ++n) {
    const auto bits = static_cast<std::uint32_t>(random_bits(1, 0, n));
    ASSERT_EQ(shader::bn_golden_offset(bits), golden_offset(bits));
    ASSERT_EQ(shader::bn_sqrt2_offset(bits), sqrt2_offset(bits));
    ASSERT_EQ(shader::bn_r2_offset_x(bits), r2_offset(bits)[0]);
    ASSERT_EQ(shader::bn_r2_offset_y(bits), r2_offset(bits)[1]);
    const float value = static_cast<float>(n) / 10000.0f;
    ASSERT_EQ(shader::bn_rotated(value, bits), rotated(value, bits));
    const auto side = 1 + bits % 16384;
    ASSERT_EQ(shader::bn_pixels(bits, side), static_cast<unsigned>(pixels_of(bits, static_cast<int>(side))));
    ASSERT_EQ(shader::bn_shifted(n % side, bits, side), (n % side + shader::bn_pixels(bits, side)) % side);
    ASSERT_EQ(shader::bn_is_sampled(value, 0.5f), value < 0.5f);
  }
}

}  // namespace
}  // namespace bn
