#include "texture/palette_image.h"

#include <fmt/format.h>

#include "texture/error.h"

namespace bn::texture {

Image expand_palette(const PaletteImage& picture, const std::string& name) {
  bool grey = true, opaque = true;
  for (const unsigned char index : picture.indices) {
    if (index >= picture.colours)
      fail_input(name, fmt::format("colour {} of a palette of {}", index, picture.colours));
    const auto& colour = picture.palette[index];
    grey = grey && colour[0] == colour[1] && colour[1] == colour[2];
    opaque = opaque && colour[3] == std::byte{255};
  }
  Image image{.size = picture.size, .channels = (grey ? 1 : 3) + (opaque ? 0 : 1), .samples = {}};
  image.samples.reserve(picture.indices.size() * static_cast<std::size_t>(image.channels));
  for (const unsigned char index : picture.indices) {
    const auto& colour = picture.palette[index];
    image.samples.insert(image.samples.end(), colour.begin(), colour.begin() + (grey ? 1 : 3));
    if (!opaque) image.samples.push_back(colour[3]);
  }
  return image;
}

}  // namespace bn::texture
