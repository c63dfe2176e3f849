// bn/grid.h - floor 0: sizes, offsets and arrays on a torus.

#pragma once

#ifdef __FAST_MATH__
#error "libbn promises the same bytes everywhere; build it without -ffast-math"
#endif

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bn {

/// A position difference in pixels: x to the right, y down.
struct Offset {
  int x = 0;
  int y = 0;
  friend bool operator==(const Offset&, const Offset&) = default;
};

struct Extent;

/// Width, height and depth of a volume: `depth` slices, each below the one before; 1 for a picture.
struct Shape {
  int width = 1;
  int height = 1;
  int depth = 1;
  constexpr Extent slice() const;
  constexpr std::int64_t count() const { return std::int64_t{width} * height * depth; }
  friend constexpr bool operator==(const Shape&, const Shape&) = default;
};

/// Width and height in pixels. As a shape it is a picture.
struct Extent {
  int width = 0;
  int height = 0;
  constexpr std::int64_t area() const { return std::int64_t{width} * height; }
  constexpr operator Shape() const { return {width, height, 1}; }
  friend constexpr bool operator==(const Extent&, const Extent&) = default;
};

constexpr Extent Shape::slice() const { return {width, height}; }

/// The representative of `value` in 0..period-1. `period` > 0.
constexpr int wrap(std::int64_t value, int period) {
  const std::int64_t rest = value % period;
  return static_cast<int>(rest < 0 ? rest + period : rest);
}

/// The representative of `value` nearest to zero; of two equally near, the negative one.
/// Result in -floor(period/2) .. ceil(period/2)-1.
constexpr int wrap_centred(std::int64_t value, int period) {
  return wrap(value + period / 2, period) - period / 2;
}

/// A dense array of width x height x depth values, origin top-left, index (z * height + y) * width + x. Most
/// grids are pictures, of depth 1.
template <class T>
class Grid {
 public:
  Grid() = default;
  explicit Grid(Shape shape, T fill = T{})
      : shape_(shape), values_(static_cast<std::size_t>(shape.count()), fill) {}

  const Shape& shape() const { return shape_; }
  Extent size() const { return shape_.slice(); }  ///< of a slice
  int width() const { return shape_.width; }
  int height() const { return shape_.height; }
  int depth() const { return shape_.depth; }
  std::size_t count() const { return values_.size(); }

  T& operator[](std::size_t index) { return values_[index]; }
  const T& operator[](std::size_t index) const { return values_[index]; }
  T& operator()(int x, int y, int z = 0) { return values_[index(x, y, z)]; }
  const T& operator()(int x, int y, int z = 0) const { return values_[index(x, y, z)]; }
  /// The value at a position of slice 0 taken modulo the size.
  const T& torus(std::int64_t x, std::int64_t y) const {
    return values_[index(wrap(x, shape_.width), wrap(y, shape_.height), 0)];
  }
  /// The values of slice z, 0..depth-1.
  std::span<T> slice(int z) { return std::span(values_).subspan(index(0, 0, z), slice_count()); }
  std::span<const T> slice(int z) const { return std::span(values_).subspan(index(0, 0, z), slice_count()); }

  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  std::size_t slice_count() const { return static_cast<std::size_t>(shape_.slice().area()); }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(shape_.height) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(shape_.width) +
           static_cast<std::size_t>(x);
  }
  Shape shape_{0, 0};
  std::vector<T> values_;
};

}  // namespace bn
