// Protects: the measure of convergence, by closed forms for white noise, and what docs/spatiotemporal.md says
// of the presets.
#include "bn_study/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "bn/noise.h"
#include "bn/random.h"
#include "bn/spatiotemporal.h"

namespace bn {
namespace {

Grid<float> white_noise(Shape shape) {
  Grid<float> samples(shape);
  for (std::size_t i = 0; i < samples.count(); ++i)
    samples[i] = static_cast<float>(static_cast<double>(random_bits(1, 7, i) >> 11) * 0x1p-53);
  return samples;
}

TEST(Convergence, WhiteNoiseHasItsClosedForm) {
  const FrameFilter filter;
  const std::vector<double> error = filtered_error(white_noise({128, 128, 64}), filter, 64);
  const double first = std::sqrt(1.0 / 6.0) / (2.0 * 1.3435 * std::sqrt(std::numbers::pi));
  EXPECT_NEAR(error[0] / first, 1.0, 0.02);
  EXPECT_NEAR(error[63] / (first * std::sqrt(0.1 / 1.9)), 1.0, 0.03);
  const std::vector<double> pixel = pixel_error(white_noise({64, 64, 16}));
  for (std::size_t n = 1; n <= 16; n *= 4)  // the mean variance of tau (1 - tau) is 1/6
    EXPECT_NEAR(pixel[n - 1] * std::sqrt(static_cast<double>(n) * 6.0), 1.0, 0.02);
  for (const double power : series_power(white_noise({64, 64, 16}))) EXPECT_NEAR(power, 1.0, 0.06);
}

TEST(Convergence, TapsAreThoseOfTheirFilters) {
  EXPECT_EQ(FrameFilter::binomial_taps(2), (std::vector<double>{0.25, 0.5, 0.25}));
  EXPECT_EQ(FrameFilter::box_taps(4), std::vector<double>(4, 0.25));
  // Without a blur and with alpha 1 the pictures themselves are left: the variance of tau (1 - tau).
  const std::vector<double> error = filtered_error(white_noise({64, 64, 3}), {.taps = {}, .alpha = 1.0}, 3);
  for (const double e : error) EXPECT_NEAR(e, std::sqrt(1.0 / 6.0), 0.004);
}

struct Wanted {
  SpatiotemporalPreset preset;
  const char* name;
  std::array<double, 4> error;  // at frames 1, 16, 32, 64
  double power_at_0, pixel_error_64;
};

class Presets : public testing::TestWithParam<Wanted> {};
INSTANTIATE_TEST_SUITE_P(
    All, Presets,
    testing::Values(Wanted{SpatiotemporalPreset::both, "both", {.0240, .0055, .0030, .0028}, .014, .0172},
                    Wanted{
                        SpatiotemporalPreset::filtered, "filtered", {.0213, .0049, .0027, .0025}, 1.0, 1.0},
                    Wanted{SpatiotemporalPreset::stbn, "stbn", {.0250, .0067, .0046, .0045}, .013, .0173}),
    [](const auto& test) { return test.param.name; });

TEST_P(Presets, ReachTheirFigures) {
  const Grid<float> samples = samples_of_ranks(spatiotemporal_mask({.preset = GetParam().preset}));
  const std::vector<double> error = filtered_error(samples, {}, 64);
  std::cout << "E at 1, 16, 32, 64 frames:";
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t frame = i == 0 ? 1 : std::size_t{8} << i;
    std::cout << " " << error[frame - 1];
    EXPECT_LE(error[frame - 1], GetParam().error[i]) << "frame " << frame;
  }
  const double power = series_power(samples)[0], pixel = pixel_error(samples)[63];
  std::cout << "; power in time at 0: " << power << "; a pixel's error at 64 frames: " << pixel << "\n";
  EXPECT_LE(power, GetParam().power_at_0);
  EXPECT_LE(pixel, GetParam().pixel_error_64);
  // From any frame on: a third of the way around.
  const std::vector<double> later = filtered_error(samples, {}, 32, 21);
  std::cout << "from frame 21 on, against frame 0: " << later[0] / error[0] << " at first, "
            << later[31] / error[31] << " after 32 frames\n";
  EXPECT_NEAR(later[0] / error[0], 1.0, 0.02);
  EXPECT_NEAR(later[31] / error[31], 1.0, 0.02);
}

TEST(Masks2D, AreMadeForTheirBlur) {
  using F = FrameFilter;
  struct Case {
    const char* name;
    SpatialFilter filter;
    double width;
    std::vector<double> taps;
    double most;
  };
  const std::vector<Case> cases{
      {"box 3", SpatialFilter::box, 3, F::box_taps(3), .0545},
      {"box 5", SpatialFilter::box, 5, F::box_taps(5), .0230},
      {"gauss 0.7", SpatialFilter::gauss, 0.7, F::gaussian_taps(0.7), .0850},
      {"gauss 1.0", SpatialFilter::gauss, 1.0, F::gaussian_taps(1.0), .0364},
      {"binomial 2", SpatialFilter::binomial, 2, F::binomial_taps(2), .0626},
      {"binomial 3", SpatialFilter::binomial, 3, F::binomial_taps(3), .0427},
      {"gauss 1.3435", SpatialFilter::gauss, 1.3435, F::gaussian_taps(1.3435), .0193},
  };
  for (const Case& c : cases) {
    double error = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Grid<std::uint32_t> ranks = spatiotemporal_mask(
          {.size = {128, 128, 1}, .spatial = c.filter, .spatial_width = c.width, .seed = seed});
      error += filtered_error(samples_of_ranks(ranks), {.taps = c.taps, .alpha = 1.0}, 1)[0] / 4.0;
    }
    std::cout << c.name << ": " << error << "\n";
    EXPECT_LE(error, c.most) << c.name;
  }
}

}  // namespace
}  // namespace bn
