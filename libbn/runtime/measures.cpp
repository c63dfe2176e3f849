// Measures of a rendered error picture.
//
// Power is |F|^2 / (N * variance) with the mean removed, so that white noise reads 1 at every
// frequency. Frequencies are in cycles per pixel, radius over both axes.

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

#include "bn/runtime.h"

namespace bn {
namespace {

using Complex = std::complex<double>;

/// In-place radix-2 transform of `count` values `stride` apart.
void transform(Complex* values, int count, std::ptrdiff_t stride) {
  const auto at = [&](int i) -> Complex& { return values[i * stride]; };
  for (int i = 1, j = 0; i < count; ++i) {
    int bit = count >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(at(i), at(j));
  }
  std::vector<Complex> roots(static_cast<std::size_t>(std::max(1, count / 2)));
  for (std::size_t i = 0; i < roots.size(); ++i) {
    roots[i] = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(i) / count);
  }
  for (int half = 1; half < count; half *= 2) {
    const int root_step = count / (2 * half);
    for (int start = 0; start < count; start += 2 * half) {
      for (int i = 0; i < half; ++i) {
        const Complex a = at(start + i);
        const Complex b = at(start + i + half) * roots[static_cast<std::size_t>(i * root_step)];
        at(start + i) = a + b;
        at(start + i + half) = a - b;
      }
    }
  }
}

}  // namespace

double low_frequency_power(const Grid<float>& picture, double limit) {
  const int width = picture.width();
  const int height = picture.height();
  if (width < 2 || height < 2 || !std::has_single_bit(static_cast<unsigned>(width)) ||
      !std::has_single_bit(static_cast<unsigned>(height))) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("a picture of {}x{}", width, height),
                 .where = "low_frequency_power",
                 .limit = "sides that are powers of two, at least 2",
                 .remedy = "measure a crop"});
  }
  double mean = 0.0;
  for (const float value : picture) mean += value;
  mean /= static_cast<double>(picture.count());
  std::vector<Complex> field(picture.count());
  double squares = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const double value = picture[i] - mean;
    field[i] = value;
    squares += value * value;
  }
  if (squares == 0.0) return 0.0;
  for (int y = 0; y < height; ++y) transform(&field[static_cast<std::size_t>(y) * width], width, 1);
  for (int x = 0; x < width; ++x) transform(&field[static_cast<std::size_t>(x)], height, width);
  double power = 0.0;
  std::int64_t count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double fx = static_cast<double>(wrap_centred(x, width)) / width;
      const double fy = static_cast<double>(wrap_centred(y, height)) / height;
      const double radius = std::sqrt(fx * fx + fy * fy);
      if (radius == 0.0 || radius > limit) continue;
      power += std::norm(field[static_cast<std::size_t>(y) * width + x]);
      ++count;
    }
  }
  return count == 0 ? 0.0 : power / (static_cast<double>(count) * squares);
}

}  // namespace bn
