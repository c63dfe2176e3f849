#include "noise/vector_field.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "core/reproducible_math.h"

namespace bn::noise {

ScaledVector scaled_value(VectorValues values, std::uint32_t place) {
  ScaledVector vector = vector_value(values, place);
  for (float& component : vector) component *= kDistanceScale;
  return vector;
}

namespace {

/// 2^14 (1 - exp(-d^(dimensions / 2))), rounded, by floor(8192 d).
std::vector<std::int32_t> georgiev_fajardo(int dimensions) {
  std::vector<std::int32_t> table;
  for (int i = 0; i <= 1 << 14; ++i) {
    const double d = i / static_cast<double>(kDistanceScale);
    const double power = (dimensions % 2 == 1 ? std::sqrt(d) : 1.0) * (dimensions >= 2 ? d : 1.0) *
                         (dimensions == 4 ? d : 1.0);
    table.push_back(
        static_cast<std::int32_t>(std::floor((1 << 14) * (1.0 - reproducible_exp(-power)) + 0.5)));
  }
  return table;
}

}  // namespace

VectorField::VectorField(VectorValues values, VectorEnergy energy, const Grid<std::uint32_t>& places)
    : size_(places.shape()), components_(vector_components(values)), stride_(stride_of(size_.depth)) {
  if (energy == VectorEnergy::georgiev_fajardo) unlikeness_ = georgiev_fajardo(curve_dimensions(values));
  const std::size_t count = index(0, size_.height, 0);
  const auto allocate = [&]<class T>(hwy::AlignedFreeUniquePtr<T[]>& memory) {
    memory = hwy::AllocateAligned<T>(count);
    if (!memory) throw std::bad_alloc();
    std::fill(memory.get(), memory.get() + count, T{});
  };
  for (std::size_t k = 0; k < static_cast<std::size_t>(components_); ++k) allocate(components_of_[k]);
  allocate(cells_);
  allocate(places_);
  for (int z = 0; z < size_.depth; ++z) {
    for (int y = 0; y < size_.height; ++y) {
      for (int x = 0; x < size_.width; ++x) {
        const std::size_t at = index(x, y, z);
        const ScaledVector value = scaled_value(values, places(x, y, z));
        for (std::size_t k = 0; k < static_cast<std::size_t>(components_); ++k)
          components_of_[k][at] = value[k];
        cells_[at] = static_cast<std::uint8_t>(places(x, y, z) >> 24);
        places_[at] = places(x, y, z);
      }
    }
  }
}

std::uint64_t VectorField::bytes(VectorValues values, Shape size) {
  const std::uint64_t bytes_per_voxel = 4 * static_cast<std::uint64_t>(vector_components(values)) + 4 + 1;
  return static_cast<std::uint64_t>(size.slice().area() * stride_of(size.depth)) * bytes_per_voxel;
}

ScaledVector VectorField::value(std::size_t index) const {
  ScaledVector value = {};
  for (std::size_t k = 0; k < static_cast<std::size_t>(components_); ++k) value[k] = components_of_[k][index];
  return value;
}

void VectorField::exchange(std::size_t a, std::size_t b) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(components_); ++k) {
    std::swap(components_of_[k][a], components_of_[k][b]);
  }
  std::swap(cells_[a], cells_[b]);
  std::swap(places_[a], places_[b]);
}

Grid<std::uint32_t> VectorField::places() const {
  Grid<std::uint32_t> places(size_);
  for (int z = 0; z < size_.depth; ++z) {
    for (int y = 0; y < size_.height; ++y) {
      for (int x = 0; x < size_.width; ++x) places(x, y, z) = places_[index(x, y, z)];
    }
  }
  return places;
}

}  // namespace bn::noise
