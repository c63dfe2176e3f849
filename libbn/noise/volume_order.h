// The order in which the voids of a volume are filled, the largest first.

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "noise/volume_weights.h"

namespace bn::noise {

/// The bytes that volume_order() needs, its result included.
std::uint64_t volume_order_bytes(const TorusSides& sides);

/// Sets all voxels of an empty volume, always the one of least (energy, index), adding the kernel around
/// each. Returns the energy that each had when it was set, index (slice * height + y) * width + x. The start
/// energies are random. `meter` advances by a unit a voxel.
Grid<std::uint32_t> volume_order(const VolumeWeights& weights, std::uint64_t seed, const Execution& execution,
                                 ProgressMeter& meter);

/// The same on energies of 32 bits, whatever their range; for tests.
Grid<std::uint32_t> volume_order_32_bits(const VolumeWeights& weights, std::uint64_t seed,
                                         const Execution& execution, ProgressMeter& meter);

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
