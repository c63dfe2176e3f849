// The sparsest patterns of a mask: its first few points.
//
// Points that are farther apart than their kernel's sight do not see each other, and would be spread at
// random. While they are, the mask's points are those of a mask of half the size, whose pixels are twice as
// wide; its own first points come from one of a quarter of the size, and so on. Each point goes to that of
// its four pixels which is farthest from the points before it. docs/void_and_cluster.md has the figures.

#pragma once

#include <cstdint>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "noise/energy_field.h"
#include "noise/gaussian_kernel.h"
#include "noise/point_grid.h"

namespace bn::noise {

/// The first points of a mask in the order of their ranks: as many as are twice the kernel's sight apart.
/// None for a kernel that sees nothing.
std::vector<Pixel> first_points(Extent size, const PixelKernel& kernel, std::uint64_t seed,
                                const Execution& execution);

/// Sets points on a field that has its start energies.
void set_points(EnergyField& field, const BlockKernel& kernel, const std::vector<Pixel>& points);

}  // namespace bn::noise
