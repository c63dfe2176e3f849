// Masks so small that filling an empty torus, void after void, would end in a lattice.

#pragma once

#include <cstdint>

#include "bn/grid.h"
#include "noise/gaussian_kernel.h"

namespace bn::noise {

/// Masks of so many pixels at most are small.
inline constexpr std::int64_t kSmallArea = 19 * 19;

/// Void-and-cluster as Ulichney wrote it: from random points, a fifth of all, whose tightest cluster is moved
/// into the largest void until that changes nothing. So small a mask is good or bad by chance, so of sixteen
/// the one with the most even spectrum is returned. Time in proportion to the square of the area.
Grid<std::uint32_t> small_mask(Extent size, const PixelKernel& kernel, std::uint64_t seed);

}  // namespace bn::noise
