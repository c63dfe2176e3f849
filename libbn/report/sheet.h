// Sheets: square pictures of one size in columns and rows, enlarged, apart by transparent gutters. A study
// writes them, and its page cuts them again, so that each picture stands beside its own words.

#pragma once

#include <optional>

#include "bn/texture.h"

namespace bn::report {

inline constexpr int kSheetScale = 2;  ///< sheet pixels a pixel
inline constexpr int kSheetGap = 4;    ///< of the gutters, in sheet pixels; around the sheet too

/// A picture of a sheet at its own size; nothing where the sheet is not so divided.
std::optional<Image> sheet_picture(const Image& sheet, Extent columns_and_rows, Offset at);

}  // namespace bn::report
