#include "noise/plane_kernel.h"

#include <cmath>
#include <cstdlib>

#include "noise/axis_function.h"

namespace bn::noise {
namespace {

// As gaussian_kernel.cpp: rounding adds at most half a unit a weight.
constexpr std::int32_t kReserve = 1 << 14;

}  // namespace

PlaneKernel::PlaneKernel(const VolumeKernel& kernel) {
  constexpr int kSide = kMaxKernelRadius + 1;
  std::vector<double> sums(std::size_t{kSide} * kSide);
  for (const KernelTerm& term : kernel) {
    const double weight = term.weight * wrapped(term.z, 1)[0] * wrapped(term.w, 1)[0];
    std::vector<double> x, y;
    for (int d = 0; d < kSide; ++d) {
      x.push_back(unwrapped(term.x, d));
      y.push_back(unwrapped(term.y, d));
    }
    std::size_t at = 0;
    for (const double along_y : y) {
      for (const double along_x : x) sums[at++] += weight * along_x * along_y;
    }
  }
  const auto at = [&](int dx, int dy) {
    return sums[static_cast<std::size_t>(std::abs(dy) * kSide + std::abs(dx))];
  };
  double total = 0.0;
  for (int dy = -kMaxKernelRadius; dy <= kMaxKernelRadius; ++dy) {
    for (int dx = -kMaxKernelRadius; dx <= kMaxKernelRadius; ++dx) total += at(dx, dy);
  }
  const double scale = (kSetMark - kReserve) / total;
  const auto rounded = [&](int dx, int dy) {
    return static_cast<std::int32_t>(std::floor(scale * at(dx, dy) + 0.5));
  };

  const auto reaches = [&](int d) { return rounded(d, 0) > 0 || rounded(0, d) > 0; };
  while (radius_ < kMaxKernelRadius && reaches(radius_ + 1)) ++radius_;
  for (int dy = -radius_; dy <= radius_; ++dy) {
    for (int dx = -radius_; dx <= radius_; ++dx) {
      weights_.push_back(rounded(dx, dy));
      sum_ += weights_.back();
    }
  }
}

}  // namespace bn::noise
