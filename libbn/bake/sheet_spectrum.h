// The spectrum of a mask as a picture of the contact sheet.

#pragma once

#include <cstdint>

#include "bn/grid.h"

namespace bn::baking {

/// Power against white noise in decibels, DC in the middle: black at -50 and below, white at +12.5. At most
/// 128 x 128 frequencies: of a larger mask every m-th, where m divides its side. Empty where a side has no
/// such divisor, or the mask is constant. The same bytes on every machine, unlike those of the spectrum room.
Grid<std::uint8_t> sheet_spectrum(const Grid<std::int32_t>& levels);

/// The same of a volume's planes in x and time, the mean over rows: across cycles/pixel, down cycles/frame.
Grid<std::uint8_t> sheet_spectrum_in_time(const Grid<std::int32_t>& volume);

/// Row `y` of every slice, one below the other.
Grid<std::int32_t> row_in_time(const Grid<std::int32_t>& volume, int y);

}  // namespace bn::baking
