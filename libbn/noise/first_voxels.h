// The sparsest patterns of a volume's slices: the first few voxels of each.
//
// As in two dimensions (first_points.h), points that are farther apart in their slice than the kernel sees
// would be spread at random. So they are those of a volume whose slices are half as wide and half as high,
// its own first ones from a quarter, and so on; time is as it is. Each goes to that of its four places which
// has the least energy from those before it (set_voxels). docs/spatiotemporal.md has the figures.

#pragma once

#include <cstdint>
#include <vector>

#include "bn/execution.h"
#include "bn/spatiotemporal.h"
#include "noise/fill_columns.h"
#include "noise/volume_weights.h"

namespace bn::noise {

TorusSides half_sides(const TorusSides& sides);

/// The first voxels in the order of their ranks, in slices of half the size: in each slice about as many as
/// are two and a half times the kernel's sight apart. None where not even one would be. `weights` are those
/// of the kernel.
std::vector<Voxel> first_voxels(const VolumeWeights& weights, const VolumeKernel& kernel, std::uint64_t seed,
                                const Execution& execution);

}  // namespace bn::noise
