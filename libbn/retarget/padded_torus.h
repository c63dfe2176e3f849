// Storage in which a window never needs a wrap test: the tile with a border as wide as the window reaches.
//
// A *cell* is an index into such an array. With wrap each border cell repeats the pixel it stands for,
// its *home*; without wrap it holds a price that nobody pays. Rows and columns of the assignment problem
// are named by their home cells throughout the solver.

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "retarget/problem.h"

namespace bn::retarget {

class PaddedTorus {
 public:
  PaddedTorus(Extent size, const std::vector<ReachRow>& window, bool wrapped)
      : size_(size), wrapped_(wrapped) {
    for (const ReachRow& row : window) {
      left_ = std::max(left_, -row.x_low);
      right_ = std::max(right_, row.x_high);
      top_ = std::max(top_, -row.y);
      bottom_ = std::max(bottom_, row.y);
    }
    stride_ = std::int64_t{left_} + size.width + right_;
    reciprocal_ = ~std::uint64_t{0} / static_cast<std::uint64_t>(stride_) + 1;
  }

  Extent size() const { return size_; }
  bool wrapped() const { return wrapped_; }
  /// Elements of an array over all cells; vectors may be loaded from any cell.
  std::int64_t cells() const { return stride_ * (std::int64_t{top_} + size_.height + bottom_) + kSlack; }
  std::int32_t stride() const { return static_cast<std::int32_t>(stride_); }

  std::int32_t cell(int x, int y) const { return (y + top_) * stride() + x + left_; }
  /// Position in the tile; the border's is outside it.
  Offset position(std::int32_t cell) const {
    // Exact for 32-bit operands: D. Lemire, O. Kaser, N. Kurz, "Faster remainder by direct computation",
    // 2019.
    const int line =
        stride_ == 1
            ? cell
            : static_cast<int>((static_cast<Wide>(reciprocal_) * static_cast<std::uint32_t>(cell)) >> 64);
    return {cell - line * stride() - left_, line - top_};
  }

  /// The cell inside the tile that `cell` repeats.
  std::int32_t home(std::int32_t cell) const {
    const auto [x, y] = position(cell);
    if (x < 0) cell += size_.width;
    if (x >= size_.width) cell -= size_.width;
    if (y < 0) cell += size_.height * stride();
    if (y >= size_.height) cell -= size_.height * stride();
    return cell;
  }

  /// Writes `value` to a home cell and to all cells that repeat it.
  template <class T>
  void store(std::vector<T>& array, std::int32_t home_cell, T value) const {
    array[static_cast<std::size_t>(home_cell)] = value;
    if (!wrapped_) return;
    const auto [x, y] = position(home_cell);
    const bool inner = x >= right_ && x < size_.width - left_ && y >= bottom_ && y < size_.height - top_;
    if (!inner) store_copies(array, x, y, value);
  }

  /// Calls visit(home cell, x, y) for every pixel, in index order.
  template <class Visit>
  void for_each_pixel(Visit&& visit) const {
    for (int y = 0; y < size_.height; ++y) {
      for (int x = 0; x < size_.width; ++x) visit(cell(x, y), x, y);
    }
  }

 private:
  __extension__ using Wide = unsigned __int128;

  template <class T>
  void store_copies(std::vector<T>& array, int x, int y, T value) const {
    // Windows are no wider than the tile, so a pixel repeats at most once to each side.
    for (int copy_y = y - size_.height; copy_y < size_.height + bottom_; copy_y += size_.height) {
      if (copy_y < -top_) continue;
      for (int copy_x = x - size_.width; copy_x < size_.width + right_; copy_x += size_.width) {
        if (copy_x >= -left_) array[static_cast<std::size_t>(cell(copy_x, copy_y))] = value;
      }
    }
  }

  static constexpr std::int64_t kSlack = 64;  // lanes of the widest vector
  Extent size_;
  bool wrapped_;
  int left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
  std::int64_t stride_ = 0;
  std::uint64_t reciprocal_ = 0;  // ceil(2^64 / stride)
};

}  // namespace bn::retarget
