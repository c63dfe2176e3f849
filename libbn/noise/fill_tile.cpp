// Filling the largest voids, many at a time, in the very order that one at a time would give.
//
// Problem. Void-and-cluster sets, N times, the unset pixel of least (energy, index) and adds a kernel
// around it. One at a time that is a search over the whole torus for each pixel, and no two searches
// are in the same place.
//
// Method. Energies only grow while pixels are set. So a pixel that is the least among all unset pixels
// within the radius of the kernel keeps its energy until it is set: whoever could raise it would have
// to come first, and cannot. It may be set at once, whatever is going on elsewhere. And as each step of
// the sequential order sets the least of what is left, while what is left only grows, that order is the
// order of (energy when set, index): sorting by it afterwards gives the ranks (rank_order.h).
//
// Here the test is made for whole blocks of 8x8 pixels: a block may set its least pixel if its minimum
// is below those of all blocks in reach. That is stricter than necessary and a few vector instructions
// for sixteen blocks. A round finds all such blocks of a tile, then sets their pixels; no two are in
// reach of each other. About one block in thirty is found in a round.
//
// Invariants. (1) Minima of blocks outside the tile may be out of date by any number of rounds: they
// are lower bounds, so waiting for them is safe. (2) The least pixel of the whole torus never waits, so
// visiting all tiles again and again ends. (3) Which blocks are found depends on the visits; which
// energy a pixel has when it is set does not.
//
// Source: the order is that of Ulichney 1993; the local rule is the one of conservative parallel event
// simulation (Chandy & Misra 1979).

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/fill_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

#include <algorithm>
#include <vector>

#include "noise/fill_tile.h"

HWY_BEFORE_NAMESPACE();
namespace bn {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::int32_t, 16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
static_assert(kBlockPixels % kLanes == 0);

/// Adds 64 weights to a block; returns the least sum of each lane.
HWY_INLINE hn::Vec<Tag> add_weights(const std::int32_t* HWY_RESTRICT weights,
                                    std::int32_t* HWY_RESTRICT energy) {
  const Tag d;
  auto least = hn::Add(hn::Load(d, energy), hn::LoadU(d, weights));
  hn::Store(least, d, energy);
  for (int i = kLanes; i < kBlockPixels; i += kLanes) {
    const auto sum = hn::Add(hn::Load(d, energy + i), hn::LoadU(d, weights + i));
    hn::Store(sum, d, energy + i);
    least = hn::Min(least, sum);
  }
  return least;
}

#if HWY_TARGET != HWY_SCALAR
/// Folds a vector until its four lanes are left and stores them.
template <class D>
HWY_INLINE void store_minima_of_quarters(D d, hn::Vec<D> v, std::int32_t* to) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    hn::StoreU(v, d, to);
  } else {
    const hn::Half<D> half;
    store_minima_of_quarters(half, hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v)), to);
  }
}

/// Stores the minimum of each of four vectors: a transposition that takes minima on its way.
HWY_INLINE void store_four_minima(hn::Vec<Tag> v0, hn::Vec<Tag> v1, hn::Vec<Tag> v2, hn::Vec<Tag> v3,
                                  std::int32_t* to) {
  const Tag d;
  const hn::Repartition<std::int64_t, Tag> pairs;
  const auto v01 =
      hn::BitCast(pairs, hn::Min(hn::InterleaveLower(d, v0, v1), hn::InterleaveUpper(d, v0, v1)));
  const auto v23 =
      hn::BitCast(pairs, hn::Min(hn::InterleaveLower(d, v2, v3), hn::InterleaveUpper(d, v2, v3)));
  const auto low = hn::BitCast(d, hn::InterleaveLower(pairs, v01, v23));
  const auto high = hn::BitCast(d, hn::InterleaveUpper(pairs, v01, v23));
  store_minima_of_quarters(d, hn::Min(low, high), to);
}
#endif

/// Adds the kernel around one image of the pixel, which may lie outside the field.
HWY_INLINE void add_image(EnergyField& field, const BlockKernel& kernel, int x, int y) {
  const int left = x - kernel.radius();
  const int top = y - kernel.radius();
  const int block_x = left >> kBlockShift;
  const int block_y = top >> kBlockShift;
  const int phase_x = left & (kBlockSide - 1);
  const int phase_y = top & (kBlockSide - 1);
  const int first_column = std::max(0, -block_x);
  const int columns = std::min(kernel.span(phase_x), field.blocks_x - block_x) - first_column;
  const int first_row = std::max(0, -block_y);
  const int rows = std::min(kernel.span(phase_y), field.blocks_y - block_y) - first_row;
  const std::ptrdiff_t weight_stride = kernel.column_stride();
  for (int row = first_row; row < first_row + rows; ++row) {
    const auto at = static_cast<std::size_t>((block_y + row) * field.blocks_x + block_x + first_column);
    EnergyBlock* blocks = field.blocks.data() + at;
    std::int32_t* minima = field.minimum.data() + at;
    const std::int32_t* weights = kernel.weights(phase_x, first_column, phase_y, row);
    int i = 0;
#if HWY_TARGET != HWY_SCALAR
    for (; i + 4 <= columns; i += 4, weights += 4 * weight_stride) {
      const auto v0 = add_weights(weights, blocks[i].energy);
      const auto v1 = add_weights(weights + weight_stride, blocks[i + 1].energy);
      const auto v2 = add_weights(weights + 2 * weight_stride, blocks[i + 2].energy);
      const auto v3 = add_weights(weights + 3 * weight_stride, blocks[i + 3].energy);
      store_four_minima(v0, v1, v2, v3, minima + i);
    }
#endif
#if HWY_TARGET != HWY_SCALAR
    if (i < columns) {
      const Tag d;
      auto v1 = hn::Set(d, INT32_MAX);
      auto v2 = v1;
      const auto v0 = add_weights(weights, blocks[i].energy);
      if (i + 1 < columns) v1 = add_weights(weights + weight_stride, blocks[i + 1].energy);
      if (i + 2 < columns) v2 = add_weights(weights + 2 * weight_stride, blocks[i + 2].energy);
      alignas(16) std::int32_t least[4];
      store_four_minima(v0, v1, v2, v2, least);
      const hn::CappedTag<std::int32_t, 4> four;
      hn::BlendedStore(hn::Load(four, least), hn::FirstN(four, static_cast<std::size_t>(columns - i)), four,
                       minima + i);
      i = columns;
    }
#endif
    for (; i < columns; ++i, weights += weight_stride) {
      minima[i] = hn::GetLane(hn::MinOfLanes(Tag(), add_weights(weights, blocks[i].energy)));
    }
  }
}

/// Adds the kernel around every image of the pixel whose kernel meets the field.
HWY_INLINE void add_images(EnergyField& field, const BlockKernel& kernel, int x, int y) {
  const int radius = kernel.radius();
  const auto [width, height] = field.size;
  if (x >= radius && y >= radius && x + radius < width && y + radius < height) {
    add_image(field, kernel, x, y);
    return;
  }
  const int first_x = x - (x + radius) / width * width;
  const int first_y = y - (y + radius) / height * height;
  for (int image_y = first_y; image_y - radius < height; image_y += height) {
    for (int image_x = first_x; image_x - radius < width; image_x += width) {
      add_image(field, kernel, image_x, image_y);
    }
  }
}

/// The first position in the block that holds `value`.
HWY_INLINE int find_in_block(const std::int32_t* energy, std::int32_t value) {
  const Tag d;
  const auto wanted = hn::Set(d, value);
  for (int i = 0;; i += kLanes) {
    const auto found = hn::FindFirstTrue(d, hn::Eq(hn::Load(d, energy + i), wanted));
    if (found >= 0) return i + static_cast<int>(found);
  }
}

class TileFiller {
 public:
  TileFiller(EnergyField& field, const BlockKernel& kernel, const BlockRect& tile,
             std::uint32_t* energy_when_set)
      : field_(field),
        kernel_(kernel),
        tile_(tile),
        energy_when_set_(energy_when_set),
        columns_(tile.columns),
        rows_(tile.rows),
        stride_(columns_ + 2 * field.reach_x + kLanes),
        around_(static_cast<std::size_t>(stride_ * (rows_ + 2 * field.reach_y) + kLanes)),
        least_(around_.size()),
        least_of_others_(around_.size()),
        pixels_(static_cast<std::size_t>(columns_ * rows_)),
        leading_(static_cast<std::size_t>(columns_ * rows_ + kLanes)),
        tied_(leading_.size()) {}

  std::int64_t run(int rounds) {
    std::int64_t count = 0;
    for (int round = 0; round < rounds; ++round) {
      const std::size_t leading = find_leading_blocks();
      if (leading == 0) break;
      // Recording comes first: those writes go all over the tile and wait for memory together.
      for (std::size_t i = 0; i < leading; ++i) pixels_[i] = mark_least_pixel(leading_[i]);
      for (std::size_t i = 0; i < leading; ++i) add_images(field_, kernel_, pixels_[i].x, pixels_[i].y);
      count += static_cast<std::int64_t>(leading);
    }
    return count;
  }

 private:
  struct Pixel {
    int x;
    int y;
    int in_block;
  };

  /// Copies the minima of the tile and of all blocks in its reach, unrolling the torus.
  void copy_minima() {
    const int left = wrap(tile_.left - field_.reach_x, field_.blocks_x);
    const int width = columns_ + 2 * field_.reach_x;
    int y = wrap(tile_.top - field_.reach_y, field_.blocks_y);
    std::int32_t* to = around_.data();
    for (int row = 0; row < rows_ + 2 * field_.reach_y; ++row, to += stride_) {
      const std::int32_t* from = field_.minimum.data() + std::int64_t{y} * field_.blocks_x;
      for (int x = left, done = 0; done < width; x = 0) {
        const int run = std::min(width - done, field_.blocks_x - x);
        std::copy_n(from + x, run, to + done);
        done += run;
      }
      if (++y == field_.blocks_y) y = 0;
    }
  }

  /// Lists in leading_ the blocks of the tile whose least pixel comes before those of all others in
  /// reach; returns their number.
  std::size_t find_leading_blocks() {
    copy_minima();
    const Tag d;
    const int reach_x = field_.reach_x;
    const int reach_y = field_.reach_y;

    // The least of each row of a window, with and without the block in its middle.
    for (int row = 0; row < rows_ + 2 * reach_y; ++row) {
      for (int x = 0; x < columns_; x += kLanes) {
        const std::int32_t* at = around_.data() + row * stride_ + x;
        auto others = hn::Min(hn::LoadU(d, at), hn::LoadU(d, at + 2 * reach_x));
        for (int dx = 1; dx < reach_x; ++dx) {
          others = hn::Min(others, hn::Min(hn::LoadU(d, at + dx), hn::LoadU(d, at + 2 * reach_x - dx)));
        }
        hn::StoreU(others, d, least_of_others_.data() + row * stride_ + x);
        hn::StoreU(hn::Min(others, hn::LoadU(d, at + reach_x)), d, least_.data() + row * stride_ + x);
      }
    }

    std::size_t leading = 0;
    std::size_t tied = 0;
    const auto set_mark = hn::Set(d, kSetMark);
    for (int row = 0; row < rows_; ++row) {
      for (int x = 0; x < columns_; x += kLanes) {
        const std::int32_t* at = least_.data() + row * stride_ + x;
        auto others = hn::LoadU(d, least_of_others_.data() + (row + reach_y) * stride_ + x);
        for (int dy = 0; dy < reach_y; ++dy) {
          others = hn::Min(others, hn::Min(hn::LoadU(d, at + dy * stride_),
                                           hn::LoadU(d, at + (2 * reach_y - dy) * stride_)));
        }
        const auto own = hn::LoadU(d, around_.data() + (row + reach_y) * stride_ + reach_x + x);
        const auto open =
            hn::And(hn::Lt(own, set_mark), hn::FirstN(d, static_cast<std::size_t>(columns_ - x)));
        const auto blocks = hn::Iota(d, row * columns_ + x);
        leading +=
            hn::CompressStore(blocks, hn::And(hn::Lt(own, others), open), d, leading_.data() + leading);
        tied += hn::CompressStore(blocks, hn::And(hn::Eq(own, others), open), d, tied_.data() + tied);
      }
    }
    // From positions in the tile to blocks of the field.
    for (std::size_t i = 0; i < leading; ++i) leading_[i] = block_at(leading_[i]);
    for (std::size_t i = 0; i < tied; ++i) {
      const int block = block_at(tied_[i]);
      if (leads_equals(block)) leading_[leading++] = block;
    }
    return leading;
  }

  /// Whether a block holds the lowest index of the minimum that it shares with others in reach, or, on
  /// a torus so small that it is in reach of itself, with itself.
  bool leads_equals(int block) const {
    const Pixel own = least_pixel(block);
    const int block_x = block % field_.blocks_x;
    const int block_y = block / field_.blocks_x;
    for (int dy = -field_.reach_y; dy <= field_.reach_y; ++dy) {
      const int y = wrap(block_y + dy, field_.blocks_y);
      for (int dx = -field_.reach_x; dx <= field_.reach_x; ++dx) {
        const int other = y * field_.blocks_x + wrap(block_x + dx, field_.blocks_x);
        if (minimum(other) != minimum(block)) continue;
        const Pixel rival = least_pixel(other);
        if (rival.y < own.y || (rival.y == own.y && rival.x < own.x)) return false;
      }
    }
    return true;
  }

  /// The block of the field at a position of the tile.
  int block_at(int position) const {
    int y = tile_.top + position / columns_;
    int x = tile_.left + position % columns_;
    if (y >= field_.blocks_y) y -= field_.blocks_y;
    if (x >= field_.blocks_x) x -= field_.blocks_x;
    return y * field_.blocks_x + x;
  }

  std::int32_t minimum(int block) const { return field_.minimum[static_cast<std::size_t>(block)]; }

  /// The block's first pixel of least energy.
  Pixel least_pixel(int block) const {
    const int at = find_in_block(field_.blocks[static_cast<std::size_t>(block)].energy, minimum(block));
    const int block_y = block / field_.blocks_x;
    const int block_x = block - block_y * field_.blocks_x;
    return {block_x * kBlockSide + at % kBlockSide, block_y * kBlockSide + at / kBlockSide, at};
  }

  Pixel mark_least_pixel(int block) {
    const Pixel pixel = least_pixel(block);
    std::int32_t& energy = field_.blocks[static_cast<std::size_t>(block)].energy[pixel.in_block];
    energy_when_set_[std::int64_t{pixel.y} * field_.size.width + pixel.x] =
        static_cast<std::uint32_t>(energy);
    energy += kSetMark;
    return pixel;
  }

  EnergyField& field_;
  const BlockKernel& kernel_;
  const BlockRect tile_;
  std::uint32_t* const energy_when_set_;
  const int columns_;
  const int rows_;
  const int stride_;
  std::vector<std::int32_t> around_;           // the minima of the tile and of what is in its reach
  std::vector<std::int32_t> least_;            // of a window's row
  std::vector<std::int32_t> least_of_others_;  // of a window's row without its middle
  std::vector<Pixel> pixels_;                  // that a round sets
  std::vector<std::int32_t> leading_;
  std::vector<std::int32_t> tied_;
};

std::int64_t fill_tile_here(EnergyField& field, const BlockKernel& kernel, const BlockRect& tile, int rounds,
                            std::uint32_t* energy_when_set) {
  return TileFiller(field, kernel, tile, energy_when_set).run(rounds);
}

void add_kernel_here(EnergyField& field, const BlockKernel& kernel, int x, int y) {
  add_images(field, kernel, x, y);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn {
namespace {
HWY_EXPORT(fill_tile_here);
HWY_EXPORT(add_kernel_here);
}  // namespace

void add_kernel(EnergyField& field, const BlockKernel& kernel, int x, int y) {
  HWY_DYNAMIC_DISPATCH(add_kernel_here)(field, kernel, x, y);
}

std::int64_t fill_tile(EnergyField& field, const BlockKernel& kernel, const BlockRect& tile, int rounds,
                       std::uint32_t* energy_when_set) {
  return HWY_DYNAMIC_DISPATCH(fill_tile_here)(field, kernel, tile, rounds, energy_when_set);
}

}  // namespace bn
#endif  // HWY_ONCE
