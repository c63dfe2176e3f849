// Power by radial frequency, by band and after a blur.
//
// Problem: sum the plane of frequencies into rings, the sides of the texture being unequal or odd.
// Method: in units of the frequency step 1/L, L the longer side, a frequency is at r^2 = (kx L/W)^2 +
// (ky L/H)^2; exact integers where W = H. Annulus round(r) takes it. The half plane is walked once;
// a frequency whose conjugate lies in the other half counts twice.
// Invariants: every frequency but DC is in exactly one annulus; the rows are summed one by one and then by
// halves, so threads change no bit.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bn/error.h"
#include "bn/spectrum.h"
#include "spectrum/fixed_order_sum.h"
#include "spectrum/transform.h"

namespace bn {
using namespace spectrum;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Mean power below which an annulus holds rounding errors only (they are about 1e-30).
constexpr double kEmptyPower = 1e-20;
/// Where s^2 / mean^2 drowns in the rounding of its one-pass sums.
constexpr double kLeastAnisotropy = 1e-15;

/// Squared frequencies along one axis in units of 1/L, for k = 0..count-1, taken in -L/2..L/2.
std::vector<double> squared_frequencies(int side, int longer, int count) {
  std::vector<double> squared(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double f = static_cast<double>(std::int64_t{std::min(k, side - k)} * longer) / side;
    squared[static_cast<std::size_t>(k)] = f * f;
  }
  return squared;
}

/// The half plane's geometry.
struct HalfPlane {
  const PowerSpectrum& power;
  int longer;
  std::vector<double> x_squared, y_squared;

  explicit HalfPlane(const PowerSpectrum& p)
      : power(p),
        longer(std::max(p.shape.width, p.shape.height)),
        x_squared(squared_frequencies(p.shape.width, longer, half_width(p.shape))),
        y_squared(squared_frequencies(p.shape.height, longer, p.shape.height)) {}

  /// 2 where the conjugate of column kx is not in the half plane itself.
  int weight(int kx) const { return kx == 0 || 2 * kx == power.shape.width ? 1 : 2; }

  /// Calls body(r_squared, weight, power) along row ky, DC left out.
  template <class Body>
  void walk_row(int ky, const Body& body) const {
    const double* row = power.half.data() + std::int64_t{ky} * half_width(power.shape);
    const double y2 = y_squared[static_cast<std::size_t>(ky)];
    for (int kx = ky == 0 ? 1 : 0; kx < half_width(power.shape); ++kx) {
      body(x_squared[static_cast<std::size_t>(kx)] + y2, weight(kx), row[kx]);
    }
  }
};

/// Sums of one annulus.
struct Ring {
  double power = 0.0, squared = 0.0;
  std::int64_t count = 0;
};

/// Rows walked into one set of rings before it is added to the others.
constexpr int kRowsAStrip = 64;

}  // namespace

RadialCurve radial_power(const PowerSpectrum& power) {
  check_flat(power, "radial power");
  const HalfPlane plane(power);
  const int height = power.shape.height;
  const double corner = plane.x_squared.back() + plane.y_squared[static_cast<std::size_t>(height / 2)];
  const auto rings = static_cast<std::size_t>(std::sqrt(corner) + 0.5) + 1;
  std::vector<Ring> total(rings), strip(rings);
  for (int first = 0; first < height; first += kRowsAStrip) {
    std::fill(strip.begin(), strip.end(), Ring{});
    for (int ky = first; ky < std::min(height, first + kRowsAStrip); ++ky) {
      plane.walk_row(ky, [&](double r_squared, int weight, double p) {
        Ring& ring = strip[static_cast<std::size_t>(std::sqrt(r_squared) + 0.5)];
        ring.power += weight * p;
        ring.squared += weight * p * p;
        ring.count += weight;
      });
    }
    for (std::size_t j = 0; j < rings; ++j) {
      total[j].power += strip[j].power;
      total[j].squared += strip[j].squared;
      total[j].count += strip[j].count;
    }
  }

  RadialCurve curve;
  for (std::size_t j = 1; j < rings; ++j) {
    const Ring& ring = total[j];
    const double n = static_cast<double>(ring.count);
    const double mean = ring.count > 0 ? ring.power / n : kNaN;
    double anisotropy_db = kNaN;
    if (ring.count > 2 && mean > kEmptyPower) {
      const double variance = (ring.squared - ring.power * mean) / (n - 2.0);
      anisotropy_db = 10.0 * std::log10(std::max(variance / (mean * mean), kLeastAnisotropy));
    }
    curve.frequency.push_back(static_cast<double>(j) / plane.longer);
    curve.power.push_back(mean);
    curve.anisotropy_db.push_back(anisotropy_db);
    curve.count.push_back(ring.count);
  }
  return curve;
}

BandPower band_power(const PowerSpectrum& power) {
  check_flat(power, "band power");
  const HalfPlane plane(power);
  std::array<double, kBandEdges.size()> edge_squared;
  for (std::size_t b = 0; b < kBandEdges.size(); ++b) {
    edge_squared[b] = kBandEdges[b] * plane.longer * (kBandEdges[b] * plane.longer);
  }
  BandPower bands;
  std::array<std::vector<double>, kBandEdges.size()> rows;
  for (int ky = 0; ky < power.shape.height; ++ky) {
    std::array<double, kBandEdges.size()> sum{};
    plane.walk_row(ky, [&](double r_squared, int weight, double p) {
      if (r_squared > edge_squared.back()) return;
      std::size_t b = 0;
      while (r_squared > edge_squared[b]) ++b;
      sum[b] += weight * p;
      bands.count[b] += weight;
    });
    for (std::size_t b = 0; b < sum.size(); ++b) rows[b].push_back(sum[b]);
  }
  for (std::size_t b = 0; b < kBandEdges.size(); ++b) {
    const double sum = sum_by_halves(rows[b].data(), std::ssize(rows[b]));
    bands.mean[b] = bands.count[b] > 0 ? sum / static_cast<double>(bands.count[b]) : kNaN;
  }
  return bands;
}

namespace {

/// Squared transform of the wrapped, sampled Gaussian along one axis, for k = 0..count-1.
std::vector<double> gaussian_gain(int side, int count, double sigma_px) {
  std::vector<double> kernel(static_cast<std::size_t>(side));
  // Past 39 sigma a weight is below the least double.
  const int reach = static_cast<int>(std::ceil(39.0 * sigma_px));
  for (int x = -reach; x <= reach; ++x) {
    kernel[static_cast<std::size_t>(wrap(x, side))] += std::exp(-0.5 * x * x / (sigma_px * sigma_px));
  }
  const HalfSpectrum<double> spectrum = transform<double>(kernel, {side, 1, 1}, {.threads = 1});
  std::vector<double> gain(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    gain[static_cast<std::size_t>(k)] =
        std::norm(spectrum.values[static_cast<std::size_t>(std::min(k, side - k))] / spectrum.values[0]);
  }
  return gain;
}

}  // namespace

double gauss_residual_db(const PowerSpectrum& power, double sigma_px) {
  check_flat(power, "Gaussian residual");
  if (!(sigma_px >= 0.1 && sigma_px <= 64.0)) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("sigma {} pixels", sigma_px),
                 .where = "Gaussian residual",
                 .limit = "0.1..64",
                 .remedy = ""});
  }
  const Shape& shape = power.shape;
  const int pitch = half_width(shape);
  std::vector<double> gain_x = gaussian_gain(shape.width, pitch, sigma_px);
  const std::vector<double> gain_y = gaussian_gain(shape.height, shape.height, sigma_px);
  const HalfPlane plane(power);
  for (int kx = 0; kx < pitch; ++kx) gain_x[static_cast<std::size_t>(kx)] *= plane.weight(kx);
  std::vector<double> left, white;
  for (int ky = 0; ky < shape.height; ++ky) {
    const double* row = power.half.data() + std::int64_t{ky} * pitch;
    const std::int64_t first = ky == 0 ? 1 : 0;
    const double gain = gain_y[static_cast<std::size_t>(ky)];
    left.push_back(gain * sum_chunk(first, pitch, [&](std::int64_t kx) { return row[kx] * gain_x[kx]; }));
    white.push_back(gain * sum_chunk(first, pitch, [&](std::int64_t kx) { return gain_x[kx]; }));
  }
  const double ratio =
      sum_by_halves(left.data(), std::ssize(left)) / sum_by_halves(white.data(), std::ssize(white));
  return ratio > 0.0 ? 10.0 * std::log10(ratio) : kNaN;
}

double filtered_residual_db(const PowerSpectrum& power) {
  constexpr double kSigma_px = 1.3435, kAlpha = 0.1;
  const auto [width, height, depth] = power.shape;
  const int pitch = half_width(power.shape);
  const std::vector<double> gain_x = gaussian_gain(width, pitch, kSigma_px);
  const std::vector<double> gain_y = gaussian_gain(height, height, kSigma_px);
  double left = 0.0, white = 0.0;
  const double* row = power.half.data();
  for (int kz = 0; kz < depth; ++kz) {
    const double turn = std::cos(2.0 * std::numbers::pi * kz / depth);
    const double in_time =
        kAlpha * kAlpha / (1.0 - 2.0 * (1.0 - kAlpha) * turn + (1.0 - kAlpha) * (1.0 - kAlpha));
    for (int ky = 0; ky < height; ++ky, row += pitch) {
      for (int kx = kz == 0 && ky == 0 ? 1 : 0; kx < pitch; ++kx) {
        const double weight = kx == 0 || 2 * kx == width ? 1.0 : 2.0;
        const double gain =
            weight * in_time * gain_y[static_cast<std::size_t>(ky)] * gain_x[static_cast<std::size_t>(kx)];
        left += gain * row[kx];
        white += gain;
      }
    }
  }
  return left > 0.0 ? 10.0 * std::log10(left / white) : kNaN;
}

}  // namespace bn
