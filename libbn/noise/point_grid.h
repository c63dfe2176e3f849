// Which of a few points on a torus lie near a place.

#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "bn/grid.h"

namespace bn::noise {

struct Pixel {
  int x;
  int y;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

/// Points in buckets; they are numbered from 0 as they come.
class PointGrid {
 public:
  /// near() finds what is up to `reach` pixels away along both axes, and perhaps more.
  PointGrid(Extent size, int reach)
      : size_(size),
        columns_(buckets_along(size.width, reach)),
        rows_(buckets_along(size.height, reach)),
        last_(static_cast<std::size_t>(columns_ * rows_), kNone) {}

  void add(Pixel p) {
    int& last = last_[static_cast<std::size_t>(row_of(p.y) * columns_ + column_of(p.x))];
    points_.push_back({p, last});
    last = static_cast<int>(points_.size()) - 1;
  }

  /// Calls body(number, squared distance around the torus) for the points near `p`.
  template <class Body>
  void near(Pixel p, const Body& body) const {
    const int middle_x = column_of(p.x);
    const int middle_y = row_of(p.y);
    const int around_x = columns_ == 1 ? 0 : 1;
    const int around_y = rows_ == 1 ? 0 : 1;
    for (int dy = -around_y; dy <= around_y; ++dy) {
      const int row = wrap_once(middle_y + dy, rows_) * columns_;
      for (int dx = -around_x; dx <= around_x; ++dx) {
        for (int i = last_[static_cast<std::size_t>(row + wrap_once(middle_x + dx, columns_))]; i != kNone;) {
          const Entry& entry = points_[static_cast<std::size_t>(i)];
          const std::int64_t x = around(entry.at.x - p.x, size_.width);
          const std::int64_t y = around(entry.at.y - p.y, size_.height);
          body(i, x * x + y * y);
          i = entry.before;
        }
      }
    }
  }

 private:
  static constexpr int kNone = -1;

  struct Entry {
    Pixel at;
    int before;  // the point that came into the bucket before
  };

  /// Fewer than three would be met twice on the way around.
  static int buckets_along(int side, int reach) {
    return side / std::max(reach, 1) < 3 ? 1 : side / std::max(reach, 1);
  }
  static int around(int distance, int side) {
    distance = std::abs(distance);
    return std::min(distance, side - distance);
  }
  static int wrap_once(int value, int period) {
    return value < 0 ? value + period : value >= period ? value - period : value;
  }
  int column_of(int x) const { return static_cast<int>(std::int64_t{x} * columns_ / size_.width); }
  int row_of(int y) const { return static_cast<int>(std::int64_t{y} * rows_ / size_.height); }

  Extent size_;
  int columns_;
  int rows_;
  std::vector<int> last_;  // the point that came last into each bucket
  std::vector<Entry> points_;
};

}  // namespace bn::noise
