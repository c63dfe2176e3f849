// Measures of a rendered error picture.

#include <cmath>

#include "bn/runtime.h"
#include "bn/spectrum.h"

namespace bn {

double low_frequency_power(const Grid<float>& picture, double limit) {
  const std::vector<double> values(picture.begin(), picture.end());
  const PowerSpectrum power = power_spectrum(values, {picture.width(), picture.height(), 1}, {.threads = 1});
  double sum = 0.0;
  std::int64_t count = 0;
  for (int ky = 0; ky < picture.height(); ++ky) {
    for (int kx = 0; kx < picture.width(); ++kx) {
      const double fx = static_cast<double>(wrap_centred(kx, picture.width())) / picture.width();
      const double fy = static_cast<double>(wrap_centred(ky, picture.height())) / picture.height();
      const double radius = std::hypot(fx, fy);
      if (radius == 0.0 || radius > limit) continue;
      sum += power.at(kx, ky);
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace bn
