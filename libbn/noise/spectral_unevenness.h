// How uneven the spectrum of a small mask is.

#pragma once

#include <cstdint>

#include "bn/grid.h"

namespace bn::noise {

/// The sum of squared powers over all frequencies but 0: what is left of low frequencies, and peaks among the
/// high ones, which are directions and lattices. Squares up to 3/16 cycles a pixel count 4096 times and those
/// up to 1/4 128 times, for a good mask's power is about 1/60 and 1/10 there, of white noise's, 1. The same
/// bits everywhere: IEEE operations in a written order. Cost: width^2 height + width height^2 operations.
double spectral_unevenness(const Grid<std::uint32_t>& ranks);

}  // namespace bn::noise
