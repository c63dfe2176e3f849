// Measures of a rendered error picture.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bn/spectrum.h"
#include "bn_study/measures.h"
#include "study/error_spectrum.h"

namespace bn {
namespace study {
namespace {

/// The mean of power(kx, ky) over the frequencies low < f <= high.
template <class Power>
double band_mean(Extent size, double low, double high, const Power& power) {
  double sum = 0.0;
  std::int64_t count = 0;
  for (int ky = 0; ky < size.height; ++ky) {
    const double fy = static_cast<double>(wrap_centred(ky, size.height)) / size.height;
    for (int kx = 0; kx < size.width; ++kx) {
      const double fx = static_cast<double>(wrap_centred(kx, size.width)) / size.width;
      const double square = fx * fx + fy * fy;
      if (square <= low * low || square > high * high) continue;
      sum += power(kx, ky);
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

double hann_window(int at, int size) {
  return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (at + 0.5) / size);
}

ErrorSpectrum::ErrorSpectrum(const Grid<float>& error) : size_(error.size()) {
  std::vector<double> values;
  values.reserve(error.count());
  double squares = 0.0, mean = 0.0;
  for (int y = 0; y < error.height(); ++y) {
    for (int x = 0; x < error.width(); ++x) {
      const double weight = hann_window(x, error.width()) * hann_window(y, error.height());
      values.push_back(error(x, y) * weight);
      squares += weight * weight;
      mean += values.back();
    }
  }
  // power_spectrum() divides by N times the variance; taking that back gives |F|^2.
  mean /= static_cast<double>(values.size());
  double deviation = 0.0;
  for (const double value : values) deviation += (value - mean) * (value - mean);
  scale_ = deviation / squares;
  power_ = power_spectrum(values, {error.width(), error.height(), 1}, {.threads = 1});
}

double ErrorSpectrum::band(double low, double high) const {
  return band_mean(size_, low, high, [&](int kx, int ky) { return power_.at(kx, ky); }) * scale_;
}

RadialCurve ErrorSpectrum::radial() const {
  RadialCurve curve = radial_power(power_);
  for (double& power : curve.power) power *= scale_;
  return curve;
}

}  // namespace study

using namespace study;

double low_frequency_power(const Grid<float>& picture, double limit) {
  const std::vector<double> values(picture.begin(), picture.end());
  const PowerSpectrum power = power_spectrum(values, {picture.width(), picture.height(), 1}, {.threads = 1});
  return band_mean(picture.size(), 0.0, limit, [&](int kx, int ky) { return power.at(kx, ky); });
}

double low_frequency_error(const Grid<float>& error, double limit) {
  return ErrorSpectrum(error).band(0.0, limit);
}

double blurred_rms(const Grid<float>& error, double sigma_px) {
  Grid<float> picture = error;
  if (sigma_px > 0.0) {
    const int radius = static_cast<int>(std::ceil(4.0 * sigma_px));
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
      weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
      sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
    const auto blur = [&](const Grid<float>& from, int dx, int dy) {
      Grid<float> to(from.size());
      for (int y = 0; y < from.height(); ++y) {
        for (int x = 0; x < from.width(); ++x) {
          double value = 0.0;
          for (int i = -radius; i <= radius; ++i) {
            const int u = std::clamp(x + i * dx, 0, from.width() - 1);
            const int v = std::clamp(y + i * dy, 0, from.height() - 1);
            value += weights[static_cast<std::size_t>(i + radius)] * from(u, v);
          }
          to(x, y) = static_cast<float>(value);
        }
      }
      return to;
    };
    picture = blur(blur(picture, 1, 0), 0, 1);
  }
  double squares = 0.0;
  for (const float value : picture) squares += static_cast<double>(value) * value;
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, picture.count())));
}

}  // namespace bn
