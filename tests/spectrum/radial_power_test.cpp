// Protects: no frequency is lost or counted twice, bands and annuli lie where their frequencies say, white
// noise reads 1 with the background's anisotropy, and the Gaussian residual equals an actual blur.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "bn/error.h"
#include "direct_dft.h"

namespace bn {
namespace {

using test::white_values;

double frequency(int k, int side) { return static_cast<double>(std::min(k, side - k)) / side; }

TEST(RadialPower, CountsEveryFrequencyOnce) {
  for (const Shape shape : {Shape{1}, Shape{2}, Shape{64, 64}, Shape{61, 61}, Shape{61, 128}, Shape{128, 61},
                            Shape{1, 64}, Shape{64, 1}, Shape{210, 14}, Shape{16, 33}}) {
    const PowerSpectrum power = power_spectrum(white_values(shape.count(), 1), shape);
    const RadialCurve curve = radial_power(power);
    // The definition, over the whole plane.
    const int longer = std::max(shape.width, shape.height);
    std::vector<double> sum(static_cast<std::size_t>(longer) + 2);
    std::vector<std::int64_t> count(sum.size());
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        if (x == 0 && y == 0) continue;
        const auto j = static_cast<std::size_t>(
            std::lround(std::hypot(frequency(x, shape.width), frequency(y, shape.height)) * longer));
        sum[j] += power.at(x, y);
        ++count[j];
      }
    }
    EXPECT_EQ(std::accumulate(curve.count.begin(), curve.count.end(), std::int64_t{0}), shape.count() - 1);
    for (std::size_t j = 1; j <= curve.power.size(); ++j) {
      ASSERT_EQ(curve.frequency[j - 1], static_cast<double>(j) / longer);
      ASSERT_EQ(curve.count[j - 1], count[j]);
      if (count[j] > 0) {
        ASSERT_NEAR(curve.power[j - 1], sum[j] / static_cast<double>(count[j]), 1e-12);
      }
    }
    EXPECT_LE(curve.frequency.empty() ? 0.0 : curve.frequency.back(), std::sqrt(0.5) + 0.5 / longer);
  }
}

TEST(RadialPower, AnisotropyEqualsItsDefinition) {
  const PowerSpectrum power = power_spectrum(white_values(31 * 31, 1), {31, 31});
  const RadialCurve curve = radial_power(power);
  for (std::size_t j = 1; j <= curve.power.size(); ++j) {
    // An odd side has no frequency that is its own conjugate: one half of the plane is independent.
    std::vector<double> independent;
    for (int y = -15; y <= 15; ++y) {
      for (int x = -15; x <= 15; ++x) {
        if (y < 0 || (y == 0 && x <= 0)) continue;
        if (std::lround(std::hypot(x, y)) == static_cast<long>(j)) independent.push_back(power.at(x, y));
      }
    }
    if (independent.size() < 2) continue;
    const double n = static_cast<double>(independent.size());
    const double mean = std::accumulate(independent.begin(), independent.end(), 0.0) / n;
    double variance = 0.0;
    for (const double p : independent) variance += (p - mean) * (p - mean) / (n - 1.0);
    ASSERT_NEAR(curve.anisotropy_db[j - 1], 10.0 * std::log10(variance / (mean * mean)), 1e-9) << j;
  }
}

TEST(RadialPower, WhiteNoiseOver64Seeds) {
  const Shape shape{256, 256};
  PowerSpectrum average = power_spectrum(white_values(shape.count(), 1), shape);
  for (std::uint64_t seed = 2; seed <= 64; ++seed)
    accumulate(average, power_spectrum(white_values(shape.count(), seed), shape));
  const FiguresOfMerit figures = figures_of_merit(average, 0.0);
  for (const double band : figures.bands.mean) EXPECT_NEAR(band, 1.0, 0.02);
  EXPECT_NEAR(figures.anisotropy_db_mean, -10.0 * std::log10(64.0), 0.3);
  for (const double residual : figures.gauss_residual_db) EXPECT_NEAR(residual, 0.0, 0.1);
  EXPECT_TRUE(check(figures, Check::white).empty());
}

TEST(BandPower, EqualsItsDefinition) {
  for (const Shape shape : {Shape{64, 64}, Shape{61, 33}, Shape{100, 48}, Shape{8, 8}, Shape{1, 64}}) {
    const PowerSpectrum power = power_spectrum(white_values(shape.count(), 1), shape);
    const BandPower bands = band_power(power);
    std::array<double, 5> sum{};
    std::array<std::int64_t, 5> count{};
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const double f = std::hypot(frequency(x, shape.width), frequency(y, shape.height));
        if (f == 0.0 || f > 0.5) continue;
        std::size_t b = 0;
        while (f > kBandEdges[b]) ++b;
        sum[b] += power.at(x, y);
        ++count[b];
      }
    }
    EXPECT_EQ(bands.count, count);
    for (std::size_t b = 0; b < 5; ++b) {
      if (count[b] == 0) {
        EXPECT_TRUE(std::isnan(bands.mean[b]));
      } else {
        EXPECT_NEAR(bands.mean[b], sum[b] / static_cast<double>(count[b]), 1e-12);
      }
    }
  }
}

TEST(GaussResidual, EqualsABlur) {
  const Shape shape{24, 15};
  const auto values = white_values(shape.count(), 2);
  const double sigma = 1.5;
  std::vector<double> weight(values.size());
  double total = 0.0;
  for (int y = -60; y <= 60; ++y) {
    for (int x = -60; x <= 60; ++x) {
      const double w = std::exp(-0.5 * (x * x + y * y) / (sigma * sigma));
      weight[static_cast<std::size_t>(wrap(y, 15) * 24 + wrap(x, 24))] += w;
      total += w;
    }
  }
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double variance = 0.0, left = 0.0, gain = 0.0;
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x < 24; ++x) {
      double blurred = 0.0;
      for (int dy = 0; dy < 15; ++dy) {
        for (int dx = 0; dx < 24; ++dx) {
          blurred += weight[static_cast<std::size_t>(dy * 24 + dx)] / total *
                     (values[static_cast<std::size_t>((y + dy) % 15 * 24 + (x + dx) % 24)] - mean);
        }
      }
      left += blurred * blurred / n;
      const auto i = static_cast<std::size_t>(y * 24 + x);
      variance += (values[i] - mean) * (values[i] - mean) / n;
      gain += weight[i] * weight[i] / (total * total);
    }
  }
  // The sum of the squared weights is the mean of G^2 over all k; DC's share of it is 1/N.
  const double white = gain - 1.0 / n;
  EXPECT_NEAR(gauss_residual_db(power_spectrum(values, shape), sigma),
              10.0 * std::log10(left / variance / white), 1e-10);
  EXPECT_THROW(gauss_residual_db(power_spectrum(values, shape), 0.0), Error);
}

TEST(Curves, RefuseVolumes) {
  const PowerSpectrum volume = power_spectrum(white_values(64, 1), {4, 4, 4});
  EXPECT_THROW(radial_power(volume), Error);
  EXPECT_THROW(band_power(volume), Error);
  EXPECT_THROW(gauss_residual_db(volume, 1.0), Error);
}

}  // namespace
}  // namespace bn
