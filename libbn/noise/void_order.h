// The order in which the voids of a pattern are filled, the largest first.

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "noise/energy_field.h"

namespace bn::noise {

/// Fills all unset pixels of the field, always the one of least (energy, index), adding the kernel
/// around each. Returns for each of them its place in that order, from 0, and kUnranked for all others.
/// `count` is their number; `meter` advances by as much. Consumes the field.
Grid<std::uint32_t> void_order(EnergyField&& field, const BlockKernel& kernel, std::int64_t count,
                               const Execution& execution, ProgressMeter& meter);

}  // namespace bn::noise
