// Christoph Peters' CC0 masks, where the checkout has them beside it.

#pragma once

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bn/spectrum.h"
#include "bn/texture.h"

namespace bn::test {

struct Mask {
  std::vector<double> values;
  Shape shape;
  double range;  ///< 256 or 65536
};

/// Nothing where the file is absent: skip the test then.
inline std::optional<Mask> reference_mask(const std::string& name, int channel = 0) {
  const std::filesystem::path path = std::filesystem::path(BN_SOURCE_DIR) / "../shared/reference" / name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Image image = read_image(path).image;
  const Levels levels = levels_of_channel(image, channel);
  return Mask{{levels.value.begin(), levels.value.end()},
              {image.size.width, image.size.height},
              image.type == SampleType::u8 ? 256.0 : 65536.0};
}

}  // namespace bn::test
