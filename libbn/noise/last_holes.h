// The last few holes of a mask: in which order they are filled.
//
// Holes that are farther apart than the kernel's sight do not see each other, and would be filled at random.
// Here always the one that has the others nearest is filled, seen through a Gaussian whose width follows the
// distance of the holes that are left. docs/void_and_cluster.md has the figures.

#pragma once

#include <cstdint>

#include "bn/execution.h"
#include "bn/grid.h"
#include "noise/gaussian_kernel.h"

namespace bn::noise {

/// Changes the order of the highest ranks: of as many holes as are the kernel's sight apart, 7 pixels at
/// least. None for a kernel that sees nothing.
void reorder_last_holes(Grid<std::uint32_t>& ranks, const PixelKernel& kernel, const Execution& execution);

}  // namespace bn::noise
