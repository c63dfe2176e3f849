// Phases 1 and 3 of void-and-cluster (void_and_cluster.cpp) for any kernel in two dimensions.

#pragma once

#include <cstdint>

#include "bn/grid.h"
#include "core/progress.h"
#include "noise/gaussian_kernel.h"

namespace bn::noise {

/// The place of each pixel in the order of largest voids, from an empty torus to a full one. `meter` advances
/// by a unit a pixel.
Grid<std::uint32_t> filling_order(Extent size, const PixelKernel& kernel, std::uint64_t seed,
                                  const Execution& execution, ProgressMeter& meter);

/// The bytes that it needs, its result included.
std::uint64_t filling_order_bytes(Extent size);

}  // namespace bn::noise
