// Small images for the tests of the command.

#pragma once

#include <cstring>

#include "bn/random.h"
#include "bn/texture.h"

namespace bn::tools {

/// A permutation of 0..n*n-1 without any pretence to blue noise, as a one-channel image.
inline Image simple_mask(int n, SampleType type = SampleType::u8) {
  Grid<std::uint32_t> rank({n, n});
  const auto count = static_cast<std::uint32_t>(rank.count());
  for (std::uint32_t i = 0; i < count; ++i) rank[i] = i;
  for (std::uint32_t i = count - 1; i > 0; --i) {
    std::swap(rank[i], rank[random_below(static_cast<std::uint32_t>(random_bits(1, 0, i)), i + 1)]);
  }
  return encode_mask(rank, type);
}

inline Image constant_image(int n) {
  Image image = simple_mask(n);
  std::fill(image.samples.begin(), image.samples.end(), std::byte{77});
  return image;
}

/// Float, with a NaN at pixel (3, 2).
inline Image nan_image(int n) {
  Image image = simple_mask(n, SampleType::f32);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(image.samples.data() + static_cast<std::size_t>(2 * n + 3) * sizeof nan, &nan, sizeof nan);
  return image;
}

}  // namespace bn::tools
