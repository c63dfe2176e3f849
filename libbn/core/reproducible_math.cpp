#include "core/reproducible_math.h"

#include <cmath>

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

}  // namespace bn
