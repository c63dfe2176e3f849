#include "noise/volume_weights.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "noise/axis_function.h"

namespace bn::noise {
namespace {

constexpr double kMostSum = static_cast<double>((std::int32_t{1} << 29) - (std::int32_t{1} << 13));

/// The farthest two pixels along an axis can be on the torus, within what a kernel reaches.
int farthest(int side) { return std::min(side / 2, kMaxKernelRadius); }

/// How many distances of the torus have the absolute value `d`.
int multiplicity(int d, int side) { return d == 0 || 2 * d == side ? 1 : 2; }

struct Term {
  double weight;
  std::vector<double> x, y, slices;
};

std::vector<Term> tabulate(const TorusSides& sides, const VolumeKernel& kernel) {
  std::vector<Term> terms;
  for (const KernelTerm& term : kernel) {
    terms.push_back({term.weight, wrapped(term.x, sides.x), wrapped(term.y, sides.y), {}});
    const std::vector<double> z = wrapped(term.z, sides.z);
    for (const double along_w : wrapped(term.w, sides.w)) {
      for (const double along_z : z) terms.back().slices.push_back(along_z * along_w);
    }
  }
  return terms;
}

double sum_along(const std::vector<double>& values, int side) {
  double sum = 0.0;
  for (int d = 0; d <= farthest(side); ++d)
    sum += multiplicity(d, side) * values[static_cast<std::size_t>(d)];
  return sum;
}

double scale_of(const std::vector<Term>& terms, const TorusSides& sides) {
  double peak = 0.0;
  double sum = 0.0;
  for (const Term& term : terms) {
    double slices = 0.0;
    for (const double value : term.slices) slices += value;
    peak += term.weight * term.x[0] * term.y[0] * term.slices[0];
    sum += term.weight * sum_along(term.x, sides.x) * sum_along(term.y, sides.y) * slices;
  }
  return std::min(kVolumePeak / peak, kMostSum / sum);
}

std::int32_t rounded(double value) { return static_cast<std::int32_t>(std::floor(value + 0.5)); }

}  // namespace

VolumeWeights::VolumeWeights(const TorusSides& sides, const VolumeKernel& kernel) : sides_(sides) {
  const std::vector<Term> terms = tabulate(sides, kernel);
  const double scale = scale_of(terms, sides);
  const auto weight = [&](int dx, int dy, std::size_t slice) {
    double sum = 0.0;
    for (const Term& term : terms) {
      sum += term.weight * term.x[static_cast<std::size_t>(dx)] * term.y[static_cast<std::size_t>(dy)] *
             term.slices[slice];
    }
    return rounded(scale * sum);
  };
  // Every function is greatest at distance 0.
  while (reach_x_ < farthest(sides.x) && weight(reach_x_ + 1, 0, 0) > 0) ++reach_x_;
  while (reach_y_ < farthest(sides.y) && weight(0, reach_y_ + 1, 0) > 0) ++reach_y_;
  for (int dy = 0; dy <= reach_y_; ++dy) {
    for (int dx = 0; dx <= reach_x_; ++dx) {
      const int times = multiplicity(dx, sides.x) * multiplicity(dy, sides.y);
      for (std::size_t slice = 0; slice < static_cast<std::size_t>(slices()); ++slice) {
        weights_.push_back(weight(dx, dy, slice));
        sum_ += std::int64_t{times} * weights_.back();
      }
    }
  }
}

std::uint64_t VolumeWeights::bytes(const TorusSides& sides, const VolumeKernel& kernel) {
  const auto slices = static_cast<std::uint64_t>(sides.z * sides.w);
  const auto columns = static_cast<std::uint64_t>((farthest(sides.x) + 1) * (farthest(sides.y) + 1));
  return slices * (4 * columns + 8 * kernel.size()) + 8 * static_cast<std::uint64_t>(sides.x + sides.y);
}

int VolumeWeights::sight() const {
  int sight = 0;
  while (sight < reach_x_ && line(sight + 1, 0)[0] >= kVolumeStartLimit) ++sight;
  return sight;
}

std::span<const std::int32_t> VolumeWeights::line(int dx, int dy) const {
  const auto count = static_cast<std::size_t>(slices());
  const auto at = static_cast<std::size_t>(std::abs(dy) * (reach_x_ + 1) + std::abs(dx));
  return std::span(weights_).subspan(at * count, count);
}

}  // namespace bn::noise
