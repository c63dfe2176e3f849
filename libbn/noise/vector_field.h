// The state of a vector mask while its values are exchanged: places and values, a column of slices after the
// other.

#pragma once

#include <hwy/aligned_allocator.h>

#include <array>
#include <cstdint>
#include <vector>

#include "bn/vector_mask.h"
#include "noise/voxel.h"

namespace bn::noise {

/// Components are multiplied by this, so distances, up to 2, have 14 bits as integers.
inline constexpr float kDistanceScale = 8192.0f;

/// A value: the components times kDistanceScale.
using ScaledVector = std::array<float, 4>;

class VectorField {
 public:
  VectorField(VectorValues values, VectorEnergy energy, const Grid<std::uint32_t>& places);
  static std::uint64_t bytes(VectorValues values, Shape size);

  Shape size() const { return size_; }
  int components() const { return components_; }
  /// From one column to the next: a multiple of the lanes of the vectors that pass over it.
  int stride() const { return stride_; }
  static int stride_of(int slices) { return slices <= 4 ? 4 : (slices + 15) / 16 * 16; }

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
            static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(z);
  }
  std::size_t index(Voxel v) const { return index(v.x, v.y, v.z); }

  ScaledVector value(std::size_t index) const;
  const float* component(int which) const { return components_of_[static_cast<std::size_t>(which)].get(); }
  /// The 256th of the curve that the value is in.
  std::uint8_t cell(std::size_t index) const { return cells_[index]; }
  const std::uint8_t* cells() const { return cells_.get(); }

  /// How unlike two values are, D of bn/vector_mask.h, 0..2^14: by their distance floor(8192 d), 0..2^14, or
  /// the distance itself where there is no table.
  const std::int32_t* unlikeness() const { return unlikeness_.empty() ? nullptr : unlikeness_.data(); }

  void exchange(std::size_t a, std::size_t b);
  Grid<std::uint32_t> places() const;

 private:
  Shape size_;
  int components_;
  int stride_;
  std::vector<std::int32_t> unlikeness_;
  std::array<hwy::AlignedFreeUniquePtr<float[]>, 4> components_of_;
  hwy::AlignedFreeUniquePtr<std::uint8_t[]> cells_;
  hwy::AlignedFreeUniquePtr<std::uint32_t[]> places_;
};

/// Dimensions of the curve of bn/vector_mask.h.
int curve_dimensions(VectorValues values);

/// vector_value(), scaled.
ScaledVector scaled_value(VectorValues values, std::uint32_t place);

}  // namespace bn::noise
