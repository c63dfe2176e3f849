// The last few holes of a volume's slices: in which order they are filled.
//
// As in two dimensions (last_holes.h): always the hole that has the others nearest is filled, seen through a
// Gaussian whose width follows the distance of the holes that are left in a slice, and in time through what
// the volume's kernel sees there. docs/spatiotemporal.md has the figures.

#pragma once

#include <cstdint>

#include "bn/execution.h"
#include "bn/grid.h"
#include "bn/spatiotemporal.h"
#include "noise/volume_weights.h"

namespace bn::noise {

/// Changes the order of the highest ranks of each slice, which are 0..width*height-1: of as many holes as are
/// the kernel's sight apart, 8 pixels at least.
void reorder_last_voxels(Grid<std::uint32_t>& ranks, const VolumeWeights& weights, const VolumeKernel& kernel,
                         const Execution& execution);

}  // namespace bn::noise
