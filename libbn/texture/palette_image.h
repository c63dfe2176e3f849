// Pictures that are numbers of colours, as BMP and GIF have them.

#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bn/texture.h"

namespace bn::texture {

struct PaletteImage {
  Extent size;
  std::array<std::array<std::byte, 4>, 256> palette = {};  ///< red, green, blue, alpha
  std::size_t colours = 0;                                 ///< of the palette
  std::vector<unsigned char> indices = {};                 ///< row by row from the top left
};

/// The colours of the pixels, 8 bit: one channel where all that occur are grey, else three; and alpha behind
/// them where one that occurs is not opaque. Errors: invalid_input (a number beyond the palette).
Image expand_palette(const PaletteImage& picture, const std::string& name);

}  // namespace bn::texture
