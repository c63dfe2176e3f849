// Behind midranks(): whether there is anything to do.

#pragma once

#include <span>

namespace bn::spectrum {

/// Whether the values are low..low + N-1, each once: their own ranks but for an offset, as a mask's are.
bool is_permutation_of_a_range(std::span<const double> values);

}  // namespace bn::spectrum
