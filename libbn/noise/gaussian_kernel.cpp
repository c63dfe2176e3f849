#include "noise/gaussian_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/reproducible_math.h"

namespace bn::noise {
namespace {

// Rounding adds at most half a unit a weight, so the weights can exceed the sum they are scaled to by
// half their number; below this with room for the start energies.
constexpr std::int32_t kReserve = 1 << 14;
constexpr int kMaxDiameter = 2 * kMaxKernelRadius + 1;
static_assert(kMaxDiameter * kMaxDiameter / 2 + kStartEnergyLimit < kReserve);

}  // namespace

GaussianKernel::GaussianKernel(double sigma_px, int cutoff_px) {
  const int reach = cutoff_px == 0 ? kMaxKernelRadius : cutoff_px;
  // By squared distance; the sum runs over rows, then columns: a written order, as it is in doubles.
  std::vector<double> gauss(static_cast<std::size_t>(reach * reach) + 1);
  // What is below e^-60 changes no sum.
  const auto visible = static_cast<std::size_t>(120.0 * sigma_px * sigma_px) + 1;
  for (std::size_t d = 0; d < std::min(gauss.size(), visible); ++d) {
    gauss[d] = reproducible_exp(-static_cast<double>(d) / (2.0 * sigma_px * sigma_px));
  }
  double total = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const int d = x * x + y * y;
      if (d <= reach * reach) total += gauss[static_cast<std::size_t>(d)];
    }
  }
  const double scale = (kSetMark - kReserve) / total;
  const auto rounded = [&](int x, int y) {
    const int d = x * x + y * y;
    if (d > reach * reach) return 0;
    return static_cast<std::int32_t>(std::floor(scale * gauss[static_cast<std::size_t>(d)] + 0.5));
  };

  while (radius_ < reach && rounded(radius_ + 1, 0) > 0) ++radius_;
  for (int y = -radius_; y <= radius_; ++y) {
    for (int x = -radius_; x <= radius_; ++x) {
      weights_.push_back(rounded(x, y));
      sum_ += weights_.back();
    }
  }
}

int PixelKernel::sight() const {
  int d = 0;
  while (weight(d + 1, 0) >= kStartEnergyLimit && weight(0, d + 1) >= kStartEnergyLimit) ++d;
  return d;
}

std::int32_t PixelKernel::weight(int x, int y) const {
  if (std::abs(x) > radius_ || std::abs(y) > radius_) return 0;
  return weights_[static_cast<std::size_t>((y + radius_) * (2 * radius_ + 1) + x + radius_)];
}

}  // namespace bn::noise
