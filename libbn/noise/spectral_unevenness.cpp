#include "noise/spectral_unevenness.h"

#include <complex>
#include <numbers>
#include <vector>

namespace bn::noise {
namespace {

using Complex = std::complex<double>;

/// e^(2 pi i k / n) for k = 0..n-1, by the series: libm's own differ in the last place.
std::vector<Complex> roots_of_unity(int n) {
  constexpr int kTerms = 32;
  std::vector<Complex> roots;
  for (int k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n;
    Complex sum = 0.0, term = 1.0;
    for (int i = 1; i <= kTerms; ++i) {
      sum += term;
      term = Complex(-term.imag() * angle / i, term.real() * angle / i);
    }
    roots.push_back(sum);
  }
  return roots;
}

}  // namespace

double spectral_unevenness(const Grid<std::uint32_t>& ranks) {
  const auto [width, height] = ranks.size();
  const auto count = static_cast<double>(ranks.count());
  const double variance = (count * count - 1.0) / 12.0;  // of 0..count-1
  const std::vector<Complex> across = roots_of_unity(width), down = roots_of_unity(height);
  const auto at = [](const std::vector<Complex>& roots, int i) {
    return roots[static_cast<std::size_t>(i) % roots.size()];
  };
  // Row by row, then each column of what that gave.
  std::vector<Complex> rows;
  for (int y = 0; y < height; ++y) {
    for (int kx = 0; kx < width; ++kx) {
      Complex sum = 0.0;
      for (int x = 0; x < width; ++x) sum += at(across, kx * x) * static_cast<double>(ranks(x, y));
      rows.push_back(sum);
    }
  }
  double unevenness = 0.0;
  for (int ky = 0; ky < height; ++ky) {
    for (int kx = ky == 0 ? 1 : 0; kx < width; ++kx) {
      Complex sum = 0.0;
      for (int y = 0; y < height; ++y)
        sum += at(down, ky * y) * rows[static_cast<std::size_t>(y * width + kx)];
      const double power = std::norm(sum) / (count * variance);
      const double fx = static_cast<double>(std::min(kx, width - kx)) / width;
      const double fy = static_cast<double>(std::min(ky, height - ky)) / height;
      const double squared = fx * fx + fy * fy;
      unevenness += (squared <= 9.0 / 256.0 ? 4096.0 : squared <= 1.0 / 16.0 ? 128.0 : 1.0) * power * power;
    }
  }
  return unevenness;
}

}  // namespace bn::noise
