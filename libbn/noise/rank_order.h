// From the energies that pixels had when they were set to their ranks.

#pragma once

#include <cstdint>
#include <span>

#include "bn/execution.h"
#include "bn/grid.h"
#include "noise/gaussian_kernel.h"

namespace bn::noise {

/// An energy that takes part in no order.
inline constexpr std::uint32_t kUnranked = UINT32_MAX;

/// Replaces every energy, which is below kSetMark, by its place in the order of (energy, index), from 0;
/// kUnranked stays. `room` is for as many energies as are ranked; up to another 4 bytes each are needed
/// meanwhile.
void replace_by_ranks(Grid<std::uint32_t>& energies, std::span<std::uint32_t> room,
                      const Execution& execution);

}  // namespace bn::noise
