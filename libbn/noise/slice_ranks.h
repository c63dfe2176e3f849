// From the energies that voxels had when they were set to their ranks within each slice.

#pragma once

#include <cstdint>

#include "bn/execution.h"
#include "bn/grid.h"

namespace bn::noise {

/// Replaces every energy, which is below kSetMark, by its place in the order of (energy, index) within its
/// slice.
void replace_by_ranks_in_slices(Grid<std::uint32_t>& energies, const Execution& execution);

}  // namespace bn::noise
