// The letters of contact sheets: a bitmap font of our own, so that no installed font can change a byte.

#pragma once

#include <string_view>

namespace bn::baking {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 9;  ///< seven rows above the base line, two below
inline constexpr int kGlyphAdvance = 6;

/// Whether pixel (x, y) of a character is set. Characters without a glyph show as '?'.
bool glyph_pixel(char character, int x, int y);

/// Width of `text` in pixels, without the gap after the last character.
inline int text_width(std::string_view text) {
  return text.empty() ? 0 : static_cast<int>(text.size()) * kGlyphAdvance - 1;
}

}  // namespace bn::baking
