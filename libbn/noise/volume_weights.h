// A kernel in a volume as integers: what a voxel that is set adds to the energy of another.
//
// A weight is round(scale K(dx, dy, dz, dw)), K wrapped on the torus and ended at kMaxKernelRadius along x
// and y. The scale makes the greatest weight kVolumePeak, or less where all weights together could leave 30
// bits. Rounding can at most double a weight (one half becomes one), so with scale times the sum of K at most
// 2^29 - 2^13, all weights and a start energy stay below kSetMark = 2^30, whatever the kernel.
//
// Why 2^12: energies of unset voxels in one column lie within 1.4 peaks of each other, so 16 bits hold them
// with room to spare, and a kernel cut where it rounds to zero, at 1/2^13 of its peak, makes the same quality
// as one with 20 bits (docs/spatiotemporal.md).

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bn/spatiotemporal.h"
#include "noise/gaussian_kernel.h"

namespace bn::noise {

inline constexpr std::int32_t kVolumePeak = std::int32_t{1} << 12;

/// Random start energies in a volume are 0..kVolumeStartLimit-1: 1/128 of the peak.
inline constexpr std::int32_t kVolumeStartLimit = 1 << 5;

class VolumeWeights {
 public:
  /// Arguments are checked by the caller.
  VolumeWeights(const TorusSides& sides, const VolumeKernel& kernel);
  /// The bytes that one takes at most.
  static std::uint64_t bytes(const TorusSides& sides, const VolumeKernel& kernel);

  const TorusSides& sides() const { return sides_; }
  int slices() const { return sides_.z * sides_.w; }
  /// The largest distance along x and y, around the torus, of a weight that is not zero.
  int reach_x() const { return reach_x_; }
  int reach_y() const { return reach_y_; }
  /// How far a voxel sees another of its slice along x: weights there are no less than start energies.
  int sight() const;
  /// The weights at a distance of |dx| <= reach_x(), |dy| <= reach_y(), by dw * z_side + dz, each modulo its
  /// side.
  std::span<const std::int32_t> line(int dx, int dy) const;
  /// The sum of all weights on the torus: the energy that all set voxels together give each voxel.
  std::int64_t sum() const { return sum_; }

 private:
  TorusSides sides_;
  int reach_x_ = 0;
  int reach_y_ = 0;
  std::int64_t sum_ = 0;
  std::vector<std::int32_t> weights_;  // by (|dy| * (reach_x_ + 1) + |dx|) * slices() + slice
};

}  // namespace bn::noise
