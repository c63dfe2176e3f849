#include "noise/first_voxels.h"

#include <algorithm>
#include <limits>

#include "bn/random.h"
#include "noise/volume_order.h"

namespace bn::noise {
namespace {

/// Of the Gaussian that a kernel has in slices of half the size, a quarter and so on.
constexpr double kCoarseSigma = 1.9;

// Of random_bits; the level is added, 1 for half the size.
constexpr std::uint32_t kSeedStream = 64;

/// How many voxels of a slice are two and a half times the kernel's sight apart, about: more, and the average
/// of frames feels that they were placed by halves.
std::int64_t count_in_slice(const VolumeWeights& weights) {
  constexpr int kLeastSight = 3;
  const std::int64_t apart = (5 * std::max(weights.sight(), kLeastSight) + 1) / 2;
  return std::int64_t{weights.sides().x} * weights.sides().y / (apart * apart);
}

/// The kernel in time, with a Gaussian in place of every function of distance in a slice.
VolumeKernel coarse_kernel(const VolumeKernel& kernel) {
  const auto has_width = [](AxisForm form) { return form != AxisForm::one && form != AxisForm::delta; };
  VolumeKernel coarse = kernel;
  for (KernelTerm& term : coarse) {
    if (has_width(term.x.form)) term.x = {AxisForm::gauss, kCoarseSigma};
    if (has_width(term.y.form)) term.y = {AxisForm::gauss, kCoarseSigma};
  }
  return coarse;
}

/// The first `most` voxels at most, in slices of half the size.
std::vector<Voxel> voxels_of_half(const VolumeWeights& weights, std::int64_t most, const VolumeKernel& kernel,
                                  std::uint64_t seed, std::uint32_t level, const Execution& execution) {
  const std::int64_t count = std::min(most, count_in_slice(weights) * weights.slices());
  if (count == 0) return {};
  const VolumeWeights half(half_sides(weights.sides()), kernel);
  std::vector<Voxel> voxels = voxels_of_half(half, count, kernel, seed, level + 1, execution);
  append_first_voxels(half, random_bits(seed, kSeedStream + level, 0), count, execution, voxels);
  return voxels;
}

}  // namespace

TorusSides half_sides(const TorusSides& sides) {
  return {std::max(sides.x / 2, 1), std::max(sides.y / 2, 1), sides.z, sides.w};
}

std::vector<Voxel> first_voxels(const VolumeWeights& weights, const VolumeKernel& kernel, std::uint64_t seed,
                                const Execution& execution) {
  return voxels_of_half(weights, std::numeric_limits<std::int64_t>::max(), coarse_kernel(kernel), seed, 1,
                        execution);
}

}  // namespace bn::noise
