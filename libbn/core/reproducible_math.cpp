#include "core/reproducible_math.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bn {

double reproducible_exp(double x) {
  if (!(x >= -700.0)) return 0.0;
  if (x > 700.0) x = 700.0;

  // x = k ln2 + r with |r| <= ln2 / 2. ln2 is split so that k * kLn2High is exact (Cody & Waite 1980).
  constexpr double kLog2E = 1.4426950408889634074;
  constexpr double kLn2High = 0x1.62e42feep-1;
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  const double k = std::nearbyint(x * kLog2E);
  const double r = (x - k * kLn2High) - k * kLn2Low;

  // Taylor series by Horner's rule; at |r| <= 0.347 the term r^15/15! is below 2^-62.
  double sum = 1.0;
  for (int n = 14; n >= 1; --n) sum = 1.0 + sum * r / n;
  return std::ldexp(sum, static_cast<int>(k));
}

double reproducible_log(double x) {
  x = std::max(x, std::numeric_limits<double>::min());

  // x = 2^k m with sqrt(1/2) <= m < sqrt(2); ln m = 2 artanh(s), s = (m - 1) / (m + 1), |s| <= 0.1716.
  int k = 0;
  double m = std::frexp(x, &k);
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --k;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double square = s * s;
  // The term s^23/23 is below 2^-62.
  double sum = 0.0;
  for (int n = 21; n >= 3; n -= 2) sum = (sum + 1.0 / n) * square;
  constexpr double kLn2High = 0x1.62e42feep-1;
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  return k * kLn2High + (2.0 * (s + s * sum) + k * kLn2Low);
}

}  // namespace bn
