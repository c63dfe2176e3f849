// The sparsest patterns of a mask: its first few points, and the last few holes.
//
// A kernel sees as far as its weights exceed the random start energies, 8 pixels at sigma 1.9. Points that
// are farther apart do not see each other, and would be spread at random; so would holes. Two things are done
// about it.
//
// *First points.* While points are too far apart for the kernel, they are those of a mask of half the size,
// whose pixels are twice as wide; its own first points come from one of a quarter of the size, and so on.
// Each point goes to that of its four pixels which is farthest from the points before it.
//
// *Last holes.* The order in which the last holes are filled is found anew: always the one that has the
// others nearest is filled, seen through a Gaussian whose width follows the distance of the holes that are
// left.

#pragma once

#include <cstdint>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "noise/energy_field.h"
#include "noise/gaussian_kernel.h"
#include "noise/point_grid.h"

namespace bn::noise {

/// The first points of a mask in the order of their ranks: as many as are too far apart for its kernel.
std::vector<Pixel> first_points(Extent size, const PixelKernel& kernel, std::uint64_t seed,
                                const Execution& execution);

/// Sets points on a field that has its start energies.
void set_points(EnergyField& field, const BlockKernel& kernel, const std::vector<Pixel>& points);

/// Changes the order of the highest ranks, those of holes that are too far apart for the mask's kernel.
void reorder_last_holes(Grid<std::uint32_t>& ranks, const PixelKernel& kernel, const Execution& execution);

}  // namespace bn::noise
