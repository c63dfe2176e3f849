// The order in which the voids of a volume are filled, the largest first.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "noise/fill_columns.h"
#include "noise/volume_weights.h"

namespace bn::noise {

/// The bytes that volume_order() needs, its result included.
std::uint64_t volume_order_bytes(const TorusSides& sides);

struct VolumeOrder {
  /// That each voxel had when it was set, index (slice * height + y) * width + x; 0 for the first.
  Grid<std::uint32_t> energies;
  std::vector<Voxel> first;
};

/// Sets all voxels of a volume, always the one of least (energy, index), adding the kernel around each; after
/// `first`, which are given in slices of half the size (set_voxels). The start energies are random. `meter`
/// advances by a unit a voxel.
VolumeOrder volume_order(const VolumeWeights& weights, std::span<const Voxel> first, std::uint64_t seed,
                         const Execution& execution, ProgressMeter& meter);

/// The same on energies of 32 bits, whatever their range; for tests.
VolumeOrder volume_order_32_bits(const VolumeWeights& weights, std::span<const Voxel> first,
                                 std::uint64_t seed, const Execution& execution, ProgressMeter& meter);

/// Where `voxels` are set already, given as above, appends the next ones in the order of (energy when set,
/// index) until they are `count`. One thread.
void append_first_voxels(const VolumeWeights& weights, std::uint64_t seed, std::int64_t count,
                         const Execution& execution, std::vector<Voxel>& voxels);

/// The start energies of voxels first, first + 1 ...
class VolumeStartEnergies {
 public:
  VolumeStartEnergies(std::uint64_t seed, std::uint64_t first);
  std::int32_t next();

 private:
  std::uint64_t bits() const;

  std::uint64_t seed_;
  std::uint64_t index_;
  std::uint64_t eight_;
};

}  // namespace bn::noise
