#include "retarget/filtered_energy.h"

#include <cmath>

#include "bn/error.h"
#include "core/reproducible_math.h"

namespace bn::retarget {
namespace {

/// A Gaussian in integers that sum to about 2^bits, cut at 3 sigma.
std::vector<std::int64_t> integer_gaussian(double sigma_px, int bits) {
  const int radius = static_cast<int>(std::ceil(3.0 * sigma_px));
  std::vector<double> exact;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    exact.push_back(reproducible_exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += exact.back();
  }
  std::vector<std::int64_t> weights;
  for (const double value : exact) {
    weights.push_back(static_cast<std::int64_t>(value / sum * static_cast<double>(1 << bits) + 0.5));
  }
  return weights;
}

/// Correlated with itself: index i is the lag i - (n - 1).
std::vector<std::int64_t> autocorrelation_of(const std::vector<std::int64_t>& g) {
  const auto n = static_cast<int>(g.size());
  std::vector<std::int64_t> result(static_cast<std::size_t>(2 * n - 1), 0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) result[static_cast<std::size_t>(i - j + n - 1)] += g[i] * g[j];
  }
  return result;
}

}  // namespace

ResidualKernel::ResidualKernel(Extent size, double sigma_px, std::int64_t largest_residual)
    : autocorrelation(size, 0) {
  // |g * e| <= 2^(2 bits + 1) * largest (rounding can lift the sum of g a little), over all pixels, squared;
  // the response is smaller. Doubles only choose among eight cases, far from any boundary that rounding
  // moves.
  constexpr double kLimit = 0x1p62;
  int bits = 8;
  const auto bound = [&] {
    const double one = 2.0 * static_cast<double>(1 << (2 * bits)) * static_cast<double>(largest_residual);
    return one * one * static_cast<double>(size.area());
  };
  while (bits > 3 && bound() > kLimit) --bits;
  if (bound() > kLimit) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = "the energy of the filtered residual could pass 2^62",
                 .where = "levels",
                 .limit = "pixels * (128 * largest level difference)^2 <= 2^62",
                 .remedy = "use fewer levels"});
  }
  const auto axis = autocorrelation_of(integer_gaussian(sigma_px, bits));
  const int reach = static_cast<int>(axis.size()) / 2;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      autocorrelation(wrap(x, size.width), wrap(y, size.height)) += axis[x + reach] * axis[y + reach];
    }
  }
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (autocorrelation(x, y) != 0) taps.push_back({{x, y}, autocorrelation(x, y)});
    }
  }
}

ResidualField::ResidualField(const ResidualKernel& kernel, Grid<std::int64_t> residual)
    : kernel_(&kernel), residual_(residual.size(), 0), response_(residual.size(), 0) {
  for (std::size_t w = 0; w < residual.count(); ++w) {
    if (residual[w] != 0) add(w, residual[w]);
  }
}

void ResidualField::add(std::size_t at, std::int64_t amount) {
  residual_[at] += amount;
  const int width = residual_.width(), height = residual_.height();
  const int x = static_cast<int>(at) % width, y = static_cast<int>(at) / width;
  for (const auto& tap : kernel_->taps) {
    int to_x = x + tap.at.x, to_y = y + tap.at.y;
    if (to_x >= width) to_x -= width;
    if (to_y >= height) to_y -= height;
    response_(to_x, to_y) += tap.weight * amount;
  }
}

std::int64_t ResidualField::energy() const {
  std::int64_t sum = 0;
  for (std::size_t w = 0; w < residual_.count(); ++w) sum += residual_[w] * response_[w];
  return sum;
}

std::int64_t ResidualField::change(std::size_t p, std::size_t q, std::int64_t amount) const {
  const int width = residual_.width();
  const auto from = static_cast<int>(p), to = static_cast<int>(q);
  const std::int64_t shared =
      kernel_->autocorrelation.torus(to % width - from % width, to / width - from / width);
  const std::int64_t alone = kernel_->autocorrelation[0];
  return 2 * amount * (response_[p] - response_[q]) + 2 * amount * amount * (alone - shared);
}

void ResidualField::apply(std::size_t p, std::size_t q, std::int64_t amount) {
  add(p, amount);
  add(q, -amount);
}

}  // namespace bn::retarget
