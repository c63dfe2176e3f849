// Power spectra: from values to |F|^2 / (N * variance), their averages and projections.
//
// Problem: the signal may be small on a large offset, or of any scale, and its mean must not leak into the
// low frequencies, which are what a blue-noise mask is judged by. Method: values are scaled by a power of two
// to at most 2 (exact), the mean is taken off twice (the second time it is the rounding error of the first),
// and what is left is scaled by a power of two to about 1. Sums are in a fixed order (fixed_order_sum.h).

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bn/error.h"
#include "bn/spectrum.h"
#include "spectrum/fixed_order_sum.h"
#include "spectrum/transform.h"

namespace bn {
namespace spectrum {
namespace {

/// 2^-exponent(magnitude), kept where both it and its products stay normal.
double scale_to_one(double magnitude) {
  if (magnitude == 0.0) return 1.0;
  return std::ldexp(1.0, -std::clamp(std::ilogb(magnitude), -1000, 1000));
}

/// value -> ((value * before - mean) - correction) * after, which has mean 0 and `variance`.
struct Centring {
  double before = 1.0, mean = 0.0, correction = 0.0, after = 1.0;
  double variance = 0.0;  // 0: the values are all equal
  double operator()(double value) const { return ((value * before - mean) - correction) * after; }
};

Centring centre(std::span<const double> values, const Execution& execution) {
  const auto count = static_cast<std::int64_t>(values.size());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Centring c;
  if (*low == *high) return c;
  const double n = static_cast<double>(count);
  c.before = scale_to_one(std::max(std::abs(*low), std::abs(*high)));
  c.mean = fixed_order_sum(execution, count, [&](std::int64_t i) { return values[i] * c.before; }) / n;
  c.correction =
      fixed_order_sum(execution, count, [&](std::int64_t i) { return values[i] * c.before - c.mean; }) / n;
  c.after = scale_to_one(std::max(std::abs(c(*low)), std::abs(c(*high))));
  c.variance =
      fixed_order_sum(execution, count, [&](std::int64_t i) { return c(values[i]) * c(values[i]); }) / n;
  return c;
}

}  // namespace

void check_power(const PowerSpectrum& power, std::string_view where) {
  check_shape(power.shape, power.shape.count(), where);
  if (std::ssize(power.half) == half_count(power.shape)) return;
  throw Error({.code = ErrorCode::invalid_input,
               .what = "the power spectrum does not fill its shape",
               .where = std::string(where),
               .limit = "",
               .remedy = ""});
}

void check_flat(const PowerSpectrum& power, std::string_view where) {
  check_power(power, where);
  if (power.shape.depth == 1) return;
  throw Error({.code = ErrorCode::invalid_input,
               .what = "the spectrum is of a volume",
               .where = std::string(where),
               .limit = "a line or a picture",
               .remedy = "project it first"});
}

}  // namespace spectrum

using namespace spectrum;

double PowerSpectrum::at(std::int64_t kx, std::int64_t ky, std::int64_t kz) const {
  int x = wrap(kx, shape.width), y = wrap(ky, shape.height), z = wrap(kz, shape.depth);
  if (x > shape.width / 2) {
    x = shape.width - x;
    y = wrap(-y, shape.height);
    z = wrap(-z, shape.depth);
  }
  return half[(std::size_t(z) * shape.height + y) * half_width(shape) + x];
}

PowerSpectrum power_spectrum(std::span<const double> values, Shape shape, const Execution& execution) {
  const auto count = static_cast<std::int64_t>(values.size());
  check_shape(shape, count, "power spectrum");
  check_memory(
      execution,
      static_cast<std::uint64_t>(half_count(shape)) * (sizeof(std::complex<double>) + sizeof(double)),
      "power spectrum");
  check_finite(values, shape, "power spectrum", execution);
  const Centring centring = centre(values, execution);
  PowerSpectrum power{.shape = shape, .half = {}};
  power.half.resize(static_cast<std::size_t>(half_count(shape)));
  if (centring.variance == 0.0) return power;

  const std::function<void(std::int64_t, double*)> load_row = [&](std::int64_t row, double* line) {
    const double* source = values.data() + row * shape.width;
    for (int x = 0; x < shape.width; ++x) line[x] = centring(source[x]);
  };
  const HalfSpectrum<double> spectrum = transform_rows(shape, load_row, execution);
  const double scale = 1.0 / (static_cast<double>(count) * centring.variance);
  const std::int64_t pitch = half_width(shape);
  parallel_for(execution, std::int64_t{shape.height} * shape.depth, [&](std::int64_t row) {
    const std::complex<double>* source = spectrum.values.data() + row * pitch;
    double* target = power.half.data() + row * pitch;
    for (std::int64_t x = 0; x < pitch; ++x) {
      target[x] = (source[x].real() * source[x].real() + source[x].imag() * source[x].imag()) * scale;
    }
  });
  power.half[0] = 0.0;
  return power;
}

void accumulate(PowerSpectrum& average, const PowerSpectrum& next) {
  check_power(average, "average of spectra");
  check_power(next, "average of spectra");
  if (average.shape != next.shape) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "textures of different sizes cannot be averaged",
                 .where = "average of spectra",
                 .limit = "",
                 .remedy = "analyse them one by one"});
  }
  average.textures += next.textures;
  const double share = static_cast<double>(next.textures) / static_cast<double>(average.textures);
  for (std::size_t i = 0; i < average.half.size(); ++i) {
    average.half[i] += (next.half[i] - average.half[i]) * share;
  }
}

PowerSpectrum project(const PowerSpectrum& volume, Projection projection) {
  check_power(volume, "projection");
  const Shape& from = volume.shape;
  PowerSpectrum result;
  switch (projection) {
    case Projection::xy:
      result.shape = {from.width, from.height, 1};
      result.textures = volume.textures * from.depth;
      break;
    case Projection::xz:
      result.shape = {from.width, from.depth, 1};
      result.textures = volume.textures * from.height;
      break;
    case Projection::z:
      result.shape = {from.depth, 1, 1};
      result.textures = volume.textures * from.width * from.height;
      break;
  }
  result.half.resize(static_cast<std::size_t>(half_count(result.shape)));
  std::vector<double> terms;
  const auto mean = [&](bool holds_dc) {
    const std::int64_t count = std::ssize(terms) - (holds_dc ? 1 : 0);
    return count > 0 ? sum_by_halves(terms.data(), std::ssize(terms)) / static_cast<double>(count) : 0.0;
  };
  for (int row = 0; row < result.shape.height; ++row) {
    for (int k = 0; k < half_width(result.shape); ++k) {
      terms.clear();
      if (projection == Projection::xy) {
        for (int z = 0; z < from.depth; ++z) terms.push_back(volume.at(k, row, z));
      } else if (projection == Projection::xz) {
        for (int y = 0; y < from.height; ++y) terms.push_back(volume.at(k, y, row));
      } else {
        for (int y = 0; y < from.height; ++y) {
          for (int x = 0; x < from.width; ++x) terms.push_back(volume.at(x, y, k));
        }
      }
      result.half[std::size_t(row) * half_width(result.shape) + k] = mean(row == 0 && k == 0);
    }
  }
  return result;
}

std::vector<double> autocorrelation(const PowerSpectrum& power, const Execution& execution) {
  check_power(power, "autocorrelation");
  HalfSpectrum<double> spectrum{power.shape, {}};
  spectrum.values.assign(power.half.begin(), power.half.end());
  return inverse_transform(std::move(spectrum), execution);
}

Grid<double> centred_power(const PowerSpectrum& power) {
  check_flat(power, "centred power");
  Grid<double> plane({power.shape.width, power.shape.height});
  for (int y = 0; y < plane.height(); ++y) {
    for (int x = 0; x < plane.width(); ++x) {
      plane(x, y) = power.at(x - plane.width() / 2, y - plane.height() / 2);
    }
  }
  return plane;
}

}  // namespace bn
