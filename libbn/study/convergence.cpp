#include "bn_study/convergence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/blur.h"

namespace bn {
namespace {

constexpr int kFilteredValues = 64, kPixelValues = 32;

std::vector<double> of_sum_one(std::vector<double> taps) {
  double sum = 0.0;
  for (const double tap : taps) sum += tap;
  for (double& tap : taps) tap /= sum;
  return taps;
}

double variance(const Grid<float>& picture) {
  double sum = 0.0, squares = 0.0;
  for (const float value : picture) {
    sum += value;
    squares += double{value} * value;
  }
  const auto count = static_cast<double>(picture.count());
  return std::max(0.0, squares / count - sum / count * (sum / count));
}

}  // namespace

std::vector<double> FrameFilter::gaussian_taps(double sigma_px) {
  const int reach = static_cast<int>(std::ceil(6.0 * sigma_px));
  std::vector<double> taps;
  for (int d = -reach; d <= reach; ++d) taps.push_back(std::exp(-d * d / (2.0 * sigma_px * sigma_px)));
  return of_sum_one(std::move(taps));
}

std::vector<double> FrameFilter::box_taps(int side) {
  return std::vector<double>(static_cast<std::size_t>(side), 1.0 / side);
}

std::vector<double> FrameFilter::binomial_taps(int order) {
  std::vector<double> taps{1.0};
  for (int i = 0; i < order; ++i) {
    taps.push_back(0.0);
    for (std::size_t k = taps.size(); k-- > 1;) taps[k] += taps[k - 1];
  }
  return of_sum_one(std::move(taps));
}

Grid<float> samples_of_ranks(const Grid<std::uint32_t>& ranks, int levels) {
  const auto in_slice = static_cast<std::uint64_t>(ranks.size().area());
  Grid<float> samples(ranks.shape());
  for (std::size_t i = 0; i < ranks.count(); ++i) {
    const auto level = static_cast<double>(ranks[i] * static_cast<std::uint64_t>(levels) / in_slice);
    samples[i] = static_cast<float>((level + 0.5) / levels);
  }
  return samples;
}

std::vector<double> filtered_error(const Grid<float>& samples, const FrameFilter& filter, int frames,
                                   int start, const Execution& execution) {
  const Extent size = samples.size();
  std::vector<std::vector<double>> of_value(kFilteredValues);
  parallel_for(execution, kFilteredValues, [&](std::int64_t value) {
    const auto tau = static_cast<float>((static_cast<double>(value) + 0.5) / kFilteredValues);
    Blur blur(size, filter.taps);
    Grid<float> picture(size), average(size);
    for (int frame = 0; frame < frames; ++frame) {
      throw_if_stopped(execution);
      const std::span<const float> slice = samples.slice(wrap(start + frame, samples.depth()));
      std::transform(slice.begin(), slice.end(), picture.begin(),
                     [&](float v) { return v < tau ? 1.0f : 0.0f; });
      blur.apply(picture);
      const auto share = frame == 0 ? 1.0f : static_cast<float>(filter.alpha);
      std::transform(picture.begin(), picture.end(), average.begin(), average.begin(),
                     [&](float now, float before) { return before + share * (now - before); });
      of_value[static_cast<std::size_t>(value)].push_back(variance(average));
    }
  });
  std::vector<double> error(static_cast<std::size_t>(frames));
  for (std::size_t frame = 0; frame < error.size(); ++frame) {
    for (const auto& one : of_value) error[frame] += one[frame] / kFilteredValues;
    error[frame] = std::sqrt(error[frame]);
  }
  return error;
}

std::vector<double> pixel_error(const Grid<float>& samples) {
  std::vector<double> squares(static_cast<std::size_t>(samples.depth()));
  for (int value = 0; value < kPixelValues; ++value) {
    const double tau = (value + 0.5) / kPixelValues;
    Grid<int> below(samples.size());
    for (int frame = 0; frame < samples.depth(); ++frame) {
      const std::span<const float> slice = samples.slice(frame);
      double sum = 0.0;
      for (std::size_t i = 0; i < slice.size(); ++i) {
        below[i] += slice[i] < tau;
        const double error = below[i] / (frame + 1.0) - tau;
        sum += error * error;
      }
      squares[static_cast<std::size_t>(frame)] += sum / static_cast<double>(slice.size()) / kPixelValues;
    }
  }
  for (double& square : squares) square = std::sqrt(square);
  return squares;
}

std::array<double, 5> series_power(const Grid<float>& samples) {
  std::array<double, 5> power{};
  const int depth = samples.depth();
  const auto pixels = static_cast<std::size_t>(samples.size().area());
  for (std::size_t cycles = 0; cycles < power.size(); ++cycles) {
    std::vector<double> real(pixels), imaginary(pixels);
    for (int frame = 0; frame < depth; ++frame) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(cycles) * frame / depth;
      const double c = std::cos(turn), s = std::sin(turn);
      const std::span<const float> slice = samples.slice(frame);
      for (std::size_t i = 0; i < pixels; ++i) {
        real[i] += c * (slice[i] - 0.5);
        imaginary[i] += s * (slice[i] - 0.5);
      }
    }
    for (std::size_t i = 0; i < pixels; ++i) power[cycles] += real[i] * real[i] + imaginary[i] * imaginary[i];
    power[cycles] *= 12.0 / depth / static_cast<double>(pixels);
  }
  return power;
}

}  // namespace bn
