// Protects: the measures of error pictures read white noise and waves as they should, and follow the picture.
#include <gtest/gtest.h>

#include <cmath>

#include "bn_study/measures.h"
#include "study/error_spectrum.h"
#include "study/validation.h"

namespace bn {
using namespace study;
namespace {

Grid<float> white_noise(Extent size) {
  Grid<float> noise(size);
  for (std::size_t i = 0; i < noise.count(); ++i) noise[i] = sample(static_cast<std::uint32_t>(i), 7) - 0.5f;
  return noise;
}

TEST(Measures, WhiteNoiseReadsOneAndItsVariance) {
  const Grid<float> noise = white_noise({256, 256});
  EXPECT_NEAR(low_frequency_power(noise, 0.1), 1.0, 0.1);  // 2058 frequencies: sigma 0.03
  EXPECT_NEAR(low_frequency_error(noise, 0.1), 1.0 / 12.0, 0.1 / 12.0);
  EXPECT_NEAR(blurred_rms(noise, 0.0), std::sqrt(1.0 / 12.0), 0.003);
  // A Gaussian blur leaves 1 / (4 pi sigma^2) of the power of white noise.
  EXPECT_NEAR(blurred_rms(noise, 2.0), std::sqrt(1.0 / 12.0 / (16.0 * 3.14159265)), 0.003);
}

TEST(Measures, AWaveAboveTheBandIsNotSeen) {
  Grid<float> wave({96, 80});
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 96; ++x) wave(x, y) = static_cast<float>(std::sin(2.0 * 3.14159265358979 * 0.25 * x));
  }
  EXPECT_LT(low_frequency_error(wave, 0.1), 1e-6);
  EXPECT_GT(low_frequency_error(wave, 0.3), 1e-3);
}

TEST(Measures, BandsOfWhiteNoiseReadItsVariance) {
  const ErrorSpectrum spectrum(white_noise({256, 256}));
  double low = 0.0;
  for (const double high : kBandEdges) {
    EXPECT_NEAR(spectrum.band(low, high), 1.0 / 12.0, 0.15 / 12.0) << low << ".." << high;
    low = high;
  }
  const RadialCurve radial = spectrum.radial();
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < radial.power.size(); ++i) {
    if (std::isnan(radial.power[i])) continue;
    sum += radial.power[i] * static_cast<double>(radial.count[i]);
    count += static_cast<double>(radial.count[i]);
  }
  EXPECT_NEAR(sum / count, 1.0 / 12.0, 0.05 / 12.0);
}

TEST(Measures, WhatMovesWithThePictureIsNoChange) {
  const Extent screen{40, 30};
  const Grid<float> last = white_noise(screen);
  Grid<float> error(screen, 5.0f);
  Grid<PixelMotion> motion(screen, {3 * 256 + 100, -2 * 256 - 100});  // nearly 3.4 right, 2.4 up
  for (int y = 0; y < 28; ++y) {
    for (int x = 3; x < 40; ++x) error(x, y) = last(x - 3, y + 2);
  }
  motion(20, 20) = {kNoMotion, kNoMotion};
  error(20, 20) = 7.0f;
  double known = 0.0;
  const Grid<float> change = change_along_motion(error, last, motion, known);
  for (const float value : change) EXPECT_EQ(value, 0.0f);
  EXPECT_NEAR(known, (37.0 * 28.0 - 1.0) / (40.0 * 30.0), 1e-12);
  error(20, 10) += 0.25f;
  EXPECT_NEAR(change_along_motion(error, last, motion, known)(20, 10), 0.25f, 1e-6f);
}

TEST(Measures, RegionsFollowThePan) {
  Scene scene = load_scene("slow-pan");
  const Extent screen{200, 100};
  const Region region{"r", 0.2, 0.2, 0.2, 0.2};
  EXPECT_EQ(region_at(scene, region, screen, 0)->left, 40);
  EXPECT_EQ(region_at(scene, region, screen, 16)->left, 20);
  EXPECT_EQ(region_at(scene, region, screen, 16)->width, 40);
  EXPECT_EQ(region_at(scene, region, screen, 48)->width, 20);
  EXPECT_FALSE(region_at(scene, region, screen, 56));
  EXPECT_EQ(region_at(scene, {.name = "picture"}, screen, 56)->width, 200);
}

}  // namespace
}  // namespace bn
