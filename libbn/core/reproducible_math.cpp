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

CosineSine reproducible_turn(double turns) {
  // The nearest quarter of a turn, and an angle of up to an eighth of one from there.
  const double quarter = std::floor(turns * 4.0 + 0.5);
  constexpr double kHalfPi = 1.5707963267948966;
  const double angle = (turns * 4.0 - quarter) * kHalfPi;
  const double square = angle * angle;
  // Taylor series by Horner's rule; the terms of order 18 and 19 are below 2^-58.
  double cosine = 1.0;
  double sine = 1.0;
  for (int n = 16; n >= 2; n -= 2) {
    cosine = 1.0 - cosine * square / (n * (n - 1));
    sine = 1.0 - sine * square / (n * (n + 1));
  }
  sine *= angle;
  switch (static_cast<int>(quarter) % 4) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace bn
