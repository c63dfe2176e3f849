// Christoph Peters' masks (CC0), of tests/data.

#pragma once

#include <algorithm>
#include <cstring>
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

inline Mask reference_mask(const std::string& name, int channel = 0) {
  const Image image = read_image(BN_TEST_DATA "/" + name).image;
  const Levels levels = levels_of_channel(image, channel);
  return {{levels.value.begin(), levels.value.end()},
          {image.size.width, image.size.height},
          image.type == SampleType::u8 ? 256.0 : 65536.0};
}

}  // namespace bn::test
