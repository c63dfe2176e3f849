// From energies to ranks.

#pragma once

#include <cstdint>

#include "bn/core.h"

namespace bn {

/// A value that takes part in no order.
inline constexpr std::uint32_t kUnranked = UINT32_MAX;

/// Replaces every value by its place in the order of (value, index), from 0; kUnranked stays. Needs 8
/// bytes for each value meanwhile.
void replace_by_ranks(Grid<std::uint32_t>& values, const Execution& execution);

}  // namespace bn
