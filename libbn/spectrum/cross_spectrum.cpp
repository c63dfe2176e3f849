// What two textures have in common.
//
// Problem: the channels of one file, or the masks of one set, are used together as if they were independent;
// one mask moved, repeated or inverted looks as good by itself as any other. Method: the correlation of the
// ranks over every displacement at once is the inverse transform of F1 conj(F2). Independent textures leave a
// correlation by chance at each displacement, of variance mean(P1 P2) / N, where P is the power against white
// noise; the largest of N such values stays below six standard deviations for every size that fits in memory.

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "bn/spectrum.h"
#include "spectrum/fixed_order_sum.h"
#include "spectrum/transform.h"

namespace bn {
using namespace spectrum;
namespace {

constexpr double kDeviations = 6.0;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Ranks with mean 0 and variance 1; empty if all are equal.
std::vector<double> standardised(std::span<const double> values, const Execution& execution) {
  std::vector<double> rank = midranks(values, execution);
  const auto count = static_cast<std::int64_t>(rank.size());
  const double middle = 0.5 * static_cast<double>(count - 1);
  const double variance =
      fixed_order_sum(execution, count,
                      [&](std::int64_t i) { return (rank[i] - middle) * (rank[i] - middle); }) /
      static_cast<double>(count);
  if (!(variance > 0.0)) return {};
  const double scale = 1.0 / std::sqrt(variance);
  for (double& r : rank) r = (r - middle) * scale;
  return rank;
}

/// Sums over the half plane in which a frequency that stands for its conjugate too counts twice.
struct BandSums {
  std::array<double, kBandEdges.size()> cross{}, first{}, second{};
};

BandSums band_sums(const HalfSpectrum<double>& a, const HalfSpectrum<double>& b) {
  const Shape& shape = a.shape;
  const int pitch = half_width(shape);
  BandSums sums;
  std::size_t i = 0;
  for (int z = 0; z < shape.depth; ++z) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < pitch; ++x, ++i) {
        if (x == 0 && y == 0) continue;
        const double f = std::hypot(static_cast<double>(x) / shape.width,
                                    static_cast<double>(wrap_centred(y, shape.height)) / shape.height);
        const auto band = std::lower_bound(kBandEdges.begin(), kBandEdges.end(), f - 1e-12);
        if (band == kBandEdges.end()) continue;
        const auto k = static_cast<std::size_t>(band - kBandEdges.begin());
        const double weight = x == 0 || 2 * x == shape.width ? 1.0 : 2.0;
        sums.cross[k] += weight * (a.values[i] * std::conj(b.values[i])).real();
        sums.first[k] += weight * std::norm(a.values[i]);
        sums.second[k] += weight * std::norm(b.values[i]);
      }
    }
  }
  return sums;
}

/// Puts the displacement at which the correlation is largest into `result`.
void find_peak(const std::vector<double>& correlation, const Shape& shape, CrossSpectrum& result) {
  std::tuple<double, int> best{-1.0, 0};
  std::size_t i = 0;
  for (int z = 0; z < shape.depth; ++z) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x, ++i) {
        const int dx = wrap_centred(x, shape.width), dy = wrap_centred(y, shape.height),
                  dz = wrap_centred(z, shape.depth);
        // Rounding must not decide between displacements that are equally good.
        const double size = std::round(std::abs(correlation[i]) * 1e9);
        const std::tuple<double, int> here{size, -(std::abs(dx) + std::abs(dy) + std::abs(dz))};
        if (here <= best) continue;
        best = here;
        result.peak_correlation = correlation[i];
        result.peak_x = dx, result.peak_y = dy, result.peak_z = dz;
      }
    }
  }
}

}  // namespace

CrossSpectrum cross_spectrum(std::span<const double> first, std::span<const double> second, Shape shape,
                             const Execution& execution) {
  for (const auto& values : {first, second}) {
    check_shape(shape, static_cast<std::int64_t>(values.size()), "cross-spectrum");
    check_finite(values, shape, "cross-spectrum", execution);
  }
  check_memory(execution, static_cast<std::uint64_t>(half_count(shape)) * 4 * sizeof(std::complex<double>),
               "cross-spectrum");
  CrossSpectrum result;
  const std::vector<double> a = standardised(first, execution), b = standardised(second, execution);
  if (a.empty() || b.empty()) {
    result.correlation = result.peak_correlation = result.limit = kNaN;
    result.coherence.fill(kNaN);
    return result;
  }
  const auto count = static_cast<double>(shape.count());
  HalfSpectrum<double> fa = transform<double>(a, shape, execution);
  const HalfSpectrum<double> fb = transform<double>(b, shape, execution);
  const BandSums sums = band_sums(fa, fb);
  for (std::size_t k = 0; k < kBandEdges.size(); ++k) {
    const double power = sums.first[k] * sums.second[k];
    result.coherence[k] = power > 0.0 ? sums.cross[k] * sums.cross[k] / power : kNaN;
  }
  const int pitch = half_width(shape);
  const auto half = static_cast<std::int64_t>(fa.values.size());
  const double products = fixed_order_sum(execution, half, [&](std::int64_t i) {
    const auto x = static_cast<int>(i % pitch);
    const double weight = x == 0 || 2 * x == shape.width ? 1.0 : 2.0;
    return weight * std::norm(fa.values[static_cast<std::size_t>(i)]) *
           std::norm(fb.values[static_cast<std::size_t>(i)]);
  });
  // |F|^2 = N P for values of variance 1.
  result.limit = kDeviations * std::sqrt(products / (count * count * count)) / std::sqrt(count);
  for (std::size_t i = 0; i < fa.values.size(); ++i) fa.values[i] = std::conj(fa.values[i]) * fb.values[i];
  std::vector<double> correlation = inverse_transform(std::move(fa), execution);
  for (double& r : correlation) r /= count;
  result.correlation = correlation[0];
  find_peak(correlation, shape, result);
  return result;
}

}  // namespace bn
