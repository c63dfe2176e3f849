// A separable blur around the torus.

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bn/grid.h"

namespace bn {

/// One frame's picture, blurred in place.
class Blur {
 public:
  Blur(Extent size, const std::vector<double>& taps)
      : size_(size),
        taps_(taps.begin(), taps.end()),
        room_(static_cast<std::size_t>(std::max(size.width, size.height)) + taps.size()),
        rows_(size) {}

  void apply(Grid<float>& picture) {
    if (taps_.empty()) return;
    for (int y = 0; y < size_.height; ++y) {
      for (std::size_t i = 0; i < taps_.size() + static_cast<std::size_t>(size_.width); ++i)
        room_[i] = picture(static_cast<int>(i % static_cast<std::size_t>(size_.width)), y);
      for (int x = 0; x < size_.width; ++x) {
        float sum = 0.0f;
        for (std::size_t i = 0; i < taps_.size(); ++i)
          sum += taps_[i] * room_[static_cast<std::size_t>(x) + i];
        rows_(x, y) = sum;
      }
    }
    // The picture moves by half the taps, which no figure sees.
    std::fill(picture.begin(), picture.end(), 0.0f);
    for (int y = 0; y < size_.height; ++y) {
      for (std::size_t i = 0; i < taps_.size(); ++i) {
        const int from = wrap(y + static_cast<int>(i), size_.height);
        for (int x = 0; x < size_.width; ++x) picture(x, y) += taps_[i] * rows_(x, from);
      }
    }
  }

 private:
  Extent size_;
  std::vector<float> taps_, room_;
  Grid<float> rows_;
};

}  // namespace bn
