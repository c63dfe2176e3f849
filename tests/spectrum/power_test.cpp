// Protects: power is |F|^2 / (N variance) with the mean gone, whatever offset or scale the values carry;
// averages, projections and the autocorrelation equal their definitions.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "bn/error.h"
#include "direct_dft.h"

namespace bn {
namespace {

using test::white_values;

/// Power by its definition in long double, whole plane.
std::vector<long double> direct_power(const std::vector<double>& values, Shape shape) {
  std::vector<long double> centred(values.begin(), values.end());
  const long double n = static_cast<long double>(shape.count());
  const long double mean = std::accumulate(centred.begin(), centred.end(), 0.0L) / n;
  long double variance = 0.0L;
  for (long double& v : centred) {
    v -= mean;
    variance += v * v / n;
  }
  std::vector<long double> power;
  for (const auto& f : test::direct_dft(centred, shape)) power.push_back(std::norm(f) / (n * variance));
  power[0] = 0.0L;
  return power;
}

void expect_power(const std::vector<double>& values, Shape shape, double bound) {
  const auto wanted = direct_power(values, shape);
  const PowerSpectrum power = power_spectrum(values, shape);
  for (int z = 0; z < shape.depth; ++z) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const auto i = static_cast<std::size_t>((z * shape.height + y) * shape.width + x);
        ASSERT_NEAR(power.at(x, y, z), static_cast<double>(wanted[i]), bound) << x << "," << y << "," << z;
        ASSERT_EQ(power.at(x - shape.width, y, z + shape.depth), power.at(x, y, z));
      }
    }
  }
}

TEST(Power, EqualsItsDefinition) {
  for (const Shape shape :
       {Shape{2}, Shape{3}, Shape{61}, Shape{1, 64}, Shape{64, 64}, Shape{61, 31}, Shape{8, 8, 5}}) {
    expect_power(white_values(shape.count(), 3), shape, 1e-13);
  }
}

TEST(Power, ScaleChangesNothing) {
  const Shape shape{61, 32};
  const auto plain = power_spectrum(white_values(shape.count(), 3), shape);
  // Powers of two are exact, so not a bit may change; 1e-30 and 1e30 round the values themselves.
  for (const double scale : {0x1p-1000, 0x1p-100, 0x1p100, 0x1p1000, -0x1p3}) {
    auto values = white_values(shape.count(), 3);
    for (double& v : values) v *= scale;
    EXPECT_EQ(power_spectrum(values, shape).half, plain.half) << scale;
  }
  for (const double scale : {1e-30, 1e30, 1e-300, 1e300}) {
    auto values = white_values(shape.count(), 3);
    for (double& v : values) v *= scale;
    expect_power(values, shape, 1e-13);
  }
}

TEST(Power, AnOffsetOf1e8IsGone) {
  for (const Shape shape : {Shape{64, 64}, Shape{61, 31}, Shape{8, 8, 5}}) {
    auto values = white_values(shape.count(), 5);
    for (double& v : values) v += 1e8;
    // The sum is rounded to 2^-26 when it is stored; against the definition on the stored values the bound
    // is that of any other texture.
    expect_power(values, shape, 1e-13);
  }
}

TEST(Power, ConstantHasNone) {
  for (const double value : {0.0, 0.1, -1e30, 1e-310}) {
    for (const double p : power_spectrum(std::vector<double>(61 * 64, value), {61, 64}).half)
      ASSERT_EQ(p, 0.0);
  }
}

TEST(Power, MeanIsOne) {
  for (const Shape shape : {Shape{64, 64}, Shape{63, 61}, Shape{9, 8, 7}}) {
    const PowerSpectrum power = power_spectrum(white_values(shape.count(), 3), shape);
    long double sum = 0.0L;
    for (int z = 0; z < shape.depth; ++z) {
      for (int y = 0; y < shape.height; ++y) {
        for (int x = 0; x < shape.width; ++x) sum += power.at(x, y, z);
      }
    }
    EXPECT_NEAR(static_cast<double>(sum / shape.count()), 1.0, 1e-13);
  }
}

TEST(Power, ThreadsChangeNoBit) {
  const Shape shape{300, 211};
  const auto values = white_values(shape.count(), 3);
  const auto one = power_spectrum(values, shape, {.threads = 1});
  EXPECT_EQ(power_spectrum(values, shape, {.threads = 3}).half, one.half);
  EXPECT_EQ(power_spectrum(values, shape, {.threads = 16}).half, one.half);
}

TEST(Average, IsTheMeanOfThePeriodograms) {
  const Shape shape{16, 12};
  PowerSpectrum average = power_spectrum(white_values(shape.count(), 1), shape);
  std::vector<double> sum = average.half;
  for (std::uint64_t seed = 2; seed <= 5; ++seed) {
    const PowerSpectrum next = power_spectrum(white_values(shape.count(), seed), shape);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += next.half[i];
    accumulate(average, next);
  }
  EXPECT_EQ(average.textures, 5);
  for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_NEAR(average.half[i], sum[i] / 5, 1e-14);
  EXPECT_THROW(accumulate(average, power_spectrum(white_values(12 * 16, 1), {12, 16})), Error);
}

TEST(Projection, EqualsTheMeanOfLowerDimensionalSpectra) {
  const Shape shape{8, 6, 5};
  const auto values = white_values(shape.count(), 9);
  const long double n = static_cast<long double>(shape.count());
  const long double mean = std::accumulate(values.begin(), values.end(), 0.0L) / n;
  std::vector<long double> v(values.begin(), values.end());
  long double variance = 0.0L;
  for (long double& value : v) {
    value -= mean;
    variance += value * value / n;
  }
  const PowerSpectrum volume = power_spectrum(values, shape);

  const PowerSpectrum xy = project(volume, Projection::xy);
  std::vector<long double> slices(48);
  for (int z = 0; z < 5; ++z) {
    const auto f =
        test::direct_dft(std::vector<long double>(v.begin() + z * 48, v.begin() + (z + 1) * 48), {8, 6});
    for (std::size_t i = 0; i < 48; ++i) slices[i] += std::norm(f[i]) / (48 * variance) / 5;
  }
  EXPECT_EQ(xy.shape, (Shape{8, 6}));
  EXPECT_EQ(xy.textures, 5);
  for (int i = 1; i < 48; ++i)
    ASSERT_NEAR(xy.at(i % 8, i / 8), static_cast<double>(slices[static_cast<std::size_t>(i)]), 1e-13);

  const PowerSpectrum xz = project(volume, Projection::xz);
  std::vector<long double> sections(40);
  for (int y = 0; y < 6; ++y) {
    std::vector<long double> section;
    for (int z = 0; z < 5; ++z) {
      for (int x = 0; x < 8; ++x) section.push_back(v[static_cast<std::size_t>((z * 6 + y) * 8 + x)]);
    }
    const auto f = test::direct_dft(section, {8, 5});
    for (std::size_t i = 0; i < 40; ++i) sections[i] += std::norm(f[i]) / (40 * variance) / 6;
  }
  EXPECT_EQ(xz.shape, (Shape{8, 5}));
  for (int i = 1; i < 40; ++i)
    ASSERT_NEAR(xz.at(i % 8, i / 8), static_cast<double>(sections[static_cast<std::size_t>(i)]), 1e-13);

  const PowerSpectrum time = project(volume, Projection::z);
  std::vector<long double> sequences(5);
  for (std::size_t p = 0; p < 48; ++p) {
    std::vector<long double> sequence;
    for (std::size_t z = 0; z < 5; ++z) sequence.push_back(v[z * 48 + p]);
    const auto f = test::direct_dft(sequence, {5});
    for (std::size_t k = 0; k < 5; ++k) sequences[k] += std::norm(f[k]) / (5 * variance);
  }
  EXPECT_EQ(time.shape, (Shape{5}));
  EXPECT_NEAR(time.at(0), static_cast<double>(sequences[0] / 47),
              1e-13);  // 47: the volume's DC is no part of it
  for (int k = 1; k < 5; ++k)
    ASSERT_NEAR(time.at(k), static_cast<double>(sequences[static_cast<std::size_t>(k)] / 48), 1e-13);
}

TEST(Autocorrelation, EqualsItsDefinition) {
  const Shape shape{9, 6};
  const auto values = white_values(shape.count(), 4);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / 54.0;
  double variance = 0.0;
  for (const double v : values) variance += (v - mean) * (v - mean) / 54.0;
  const auto r = autocorrelation(power_spectrum(values, shape));
  for (int dy = 0; dy < 6; ++dy) {
    for (int dx = 0; dx < 9; ++dx) {
      double sum = 0.0;
      for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 9; ++x) {
          sum += (values[static_cast<std::size_t>(y * 9 + x)] - mean) *
                 (values[static_cast<std::size_t>((y + dy) % 6 * 9 + (x + dx) % 9)] - mean);
        }
      }
      ASSERT_NEAR(r[static_cast<std::size_t>(dy * 9 + dx)], sum / (54.0 * variance), 1e-13);
    }
  }
}

TEST(CentredPower, HasDcInTheMiddle) {
  const PowerSpectrum power = power_spectrum(white_values(7 * 6, 4), {7, 6});
  const Grid<double> plane = centred_power(power);
  EXPECT_EQ(plane(3, 3), 0.0);
  EXPECT_EQ(plane(4, 3), power.at(1, 0));
  EXPECT_EQ(plane(0, 0), power.at(-3, -3));
  EXPECT_THROW(centred_power(power_spectrum(white_values(8, 4), {2, 2, 2})), Error);
}

}  // namespace
}  // namespace bn
