#include "noise/axis_function.h"

#include <fmt/format.h>

#include <cmath>

#include "core/refuse.h"
#include "core/reproducible_math.h"

namespace bn::noise {
namespace {

// Beyond this many standard deviations a Gaussian is below 1e-15.
constexpr double kGaussReach = 8.5;

double power(double base, int exponent) {
  double product = 1.0;
  for (int i = 0; i < exponent; ++i) product *= base;
  return product;
}

/// C(2n, n + d) / C(2n, n).
double binomial(int order, int d) {
  double ratio = 1.0;
  for (int i = 1; i <= d; ++i) ratio = ratio * (order - i + 1) / (order + i);
  return d > order ? 0.0 : ratio;
}

/// The distance from which on f is 0, or as good as.
double reach(const AxisFunction& f) {
  switch (f.form) {
    case AxisForm::gauss:
      return kGaussReach * f.width;
    case AxisForm::tent:
    case AxisForm::binomial:
      return f.width;
    default:
      return 0.0;
  }
}

}  // namespace

double unwrapped(const AxisFunction& f, int d) {
  switch (f.form) {
    case AxisForm::one:
      return 1.0;
    case AxisForm::delta:
      return d == 0 ? 1.0 : 0.0;
    case AxisForm::gauss:
      return reproducible_exp(-static_cast<double>(d) * d / (2.0 * f.width * f.width));
    case AxisForm::tent:
      return d < f.width ? 1.0 - d / f.width : 0.0;
    case AxisForm::binomial:
      return binomial(static_cast<int>(f.width), d);
    case AxisForm::exponential:
      return power(1.0 - f.width, d);
  }
  return 0.0;
}

std::vector<double> wrapped(const AxisFunction& f, int side) {
  std::vector<double> values(static_cast<std::size_t>(side));
  if (f.form == AxisForm::exponential) {
    // The images are two geometric series.
    const double ratio = 1.0 - f.width;
    std::vector<double> powers(values.size() + 1, 1.0);
    for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * ratio;
    for (std::size_t d = 0; d < values.size(); ++d) {
      const double images = d == 0 ? 1.0 + powers.back() : powers[d] + powers[values.size() - d];
      values[d] = images / (1.0 - powers.back());
    }
    return values;
  }
  const int images = static_cast<int>(std::ceil(reach(f) / side)) + (f.form == AxisForm::one ? 0 : 1);
  for (int d = 0; d < side; ++d) {
    double sum = unwrapped(f, d);
    for (int k = 1; k <= images; ++k) sum += unwrapped(f, k * side - d) + unwrapped(f, k * side + d);
    values[static_cast<std::size_t>(d)] = sum;
  }
  return values;
}

void check(const AxisFunction& f, const char* where) {
  // Written so that NaN fails.
  const auto within = [&](const char* name, double least, double most) {
    if (!(f.width >= least && f.width <= most)) {
      refuse(where, fmt::format("a {} of width {}", name, f.width), fmt::format("{}..{}", least, most));
    }
  };
  switch (f.form) {
    case AxisForm::one:
    case AxisForm::delta:
      return;
    case AxisForm::gauss:
      return within("Gaussian", 0.3, 64.0);
    case AxisForm::tent:
      return within("tent", 1.0, 64.0);
    case AxisForm::binomial:
      within("binomial", 1.0, 64.0);
      if (f.width != std::floor(f.width)) {
        refuse(where, fmt::format("a binomial of order {}", f.width), "whole numbers 1..64");
      }
      return;
    case AxisForm::exponential:
      return within("exponential of alpha", 0.0001, 1.0);
  }
  refuse(where, "an unknown form of a kernel", "the forms of AxisForm");
}

}  // namespace bn::noise
