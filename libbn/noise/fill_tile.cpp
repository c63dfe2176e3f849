// Filling the largest voids, many at a time, in the very order that one at a time would give.
//
// Problem. Void-and-cluster sets, N times, the unset pixel of least (energy, index) and adds a kernel
// around it. One at a time that is a search over the whole torus for each pixel, and no two searches
// are in the same place.
//
// Method. Energies only grow while pixels are set. So a pixel that is the least among all unset pixels
// within the radius of the kernel keeps its energy until it is set: whoever could raise it would have
// to come first, and cannot. It leads: it may be set at once, whatever is going on elsewhere. And as
// each step of the sequential order sets the least of what is left, while what is left only grows, that
// order is the order of (energy when set, index): sorting by it afterwards gives the ranks
// (rank_order.h).
//
// A round finds the leading pixels of a tile, at most one in each block of 8x8 pixels, in three passes
// without a branch that depends on the data. First the blocks whose minimum is the least of all blocks
// that every pixel in them has in reach: candidates, one block in eleven. Then the candidates' least
// pixels. Then whether those come before all blocks that they themselves have in reach, which is a block
// or two more on some sides: half of them do, one block in twenty-two. They are out of each other's
// reach, so they can be set in any order.
//
// A tile moves while it is filled, by a block to the left or up after each round. Blocks on its right
// and lower side thus stay behind those on its left and upper side by a few rounds at most, and whoever
// fills the next tile on the right or below meets pixels that have gone ahead and need not be waited
// for. (Tiles that stand still end as islands whose shores all wait: half as many leading pixels a
// round. Sliding is what the tiling of loops over grids calls time skewing: M. Wonnacott, "Using time
// skewing to eliminate idle time due to memory bandwidth and network limitations", IPDPS 2000.)
//
// Invariants. (1) Minima outside the tile may be out of date by any number of rounds: they are lower
// bounds, so waiting for them is safe. (2) The least pixel of the whole torus never waits, so visiting
// all tiles again and again ends. (3) Which pixels lead in a round depends on the visits; which energy
// a pixel has when it is set does not.
//
// Source: the order is that of Ulichney 1993; the local rule is the one of conservative parallel event
// simulation (Chandy & Misra 1979).

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/fill_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "noise/add_kernel-inl.h"
#include "noise/fill_tile.h"

HWY_BEFORE_NAMESPACE();
namespace bn::noise {
namespace HWY_NAMESPACE {
namespace {

/// The lanes `first`, `first` + 1 ... (Iota of a variable is slow in Highway 1.0.)
HWY_INLINE hn::Vec<Tag> lanes_from(int first) {
  const Tag d;
  return hn::Add(hn::Iota(d, 0), hn::Set(d, first));
}

/// The first position in the block that holds `value`, which one does.
HWY_INLINE int find_in_block(const std::int32_t* energy, std::int32_t value) {
  const Tag d;
  const auto wanted = hn::Set(d, value);
  auto first = hn::Set(d, kBlockPixels);
  for (int i = 0; i < kBlockPixels; i += kLanes) {
    const auto found = hn::Eq(hn::Load(d, energy + i), wanted);
    first = hn::Min(first, hn::IfThenElse(found, lanes_from(i), first));
  }
  return hn::GetLane(hn::MinOfLanes(d, first));
}

class TileFiller {
 public:
  TileFiller(EnergyField& field, const BlockKernel& kernel, const BlockRect& tile,
             std::uint32_t* energy_when_set)
      : field_(field),
        kernel_(kernel),
        energy_when_set_(energy_when_set),
        common_reach_(kernel.radius() / kBlockSide),
        tile_(tile),
        stride_(tile.columns + 2 * field.reach_x + kLanes),
        around_(static_cast<std::size_t>(stride_ * (tile.rows + 2 * field.reach_y) + kLanes)),
        least_of_row_(around_.size()),
        candidates_(static_cast<std::size_t>(tile.columns * tile.rows + kLanes)),
        pixels_(candidates_.size()) {}

  std::int64_t run(int rounds) {
    std::int64_t count = 0;
    for (int round = 0; round < rounds; ++round) {
      copy_minima();
      const std::size_t leading = keep_leading(find_candidates());
      if (leading == 0) break;
      // Recording comes first: those writes go all over the tile and wait for memory together.
      for (std::size_t i = 0; i < leading; ++i) mark(pixels_[i]);
      for (std::size_t i = 0; i < leading; ++i) add_images(field_, kernel_, pixels_[i].x, pixels_[i].y);
      count += static_cast<std::int64_t>(leading);
      if (round % 2 == 0) {
        if (tile_.columns < field_.blocks_x) tile_.left = wrap(tile_.left - 1, field_.blocks_x);
      } else {
        if (tile_.rows < field_.blocks_y) tile_.top = wrap(tile_.top - 1, field_.blocks_y);
      }
    }
    return count;
  }

 private:
  struct Pixel {
    int x;
    int y;
    std::int32_t* energy;
  };

  /// Blocks before and after a pixel's own that it has in reach along one axis.
  struct Reach {
    int before;
    int after;
  };

  /// Copies the minima of the tile and of all blocks in its reach, unrolling the torus.
  void copy_minima() {
    const int left = wrap(tile_.left - field_.reach_x, field_.blocks_x);
    const int width = tile_.columns + 2 * field_.reach_x;
    int y = wrap(tile_.top - field_.reach_y, field_.blocks_y);
    std::int32_t* to = around_.data();
    for (int row = 0; row < tile_.rows + 2 * field_.reach_y; ++row, to += stride_) {
      const std::int32_t* from = field_.minimum.data() + std::int64_t{y} * field_.blocks_x;
      for (int x = left, done = 0; done < width; x = 0) {
        const int run = std::min(width - done, field_.blocks_x - x);
        std::copy_n(from + x, run, to + done);
        done += run;
      }
      if (++y == field_.blocks_y) y = 0;
    }
  }

  /// Where the minimum of the tile's block at (column, row) is in around_, and its row's in
  /// least_of_row_, which begins at the tile's first column.
  std::ptrdiff_t offset_in_around(int column, int row) const {
    return (row + field_.reach_y) * stride_ + field_.reach_x + column;
  }

  /// Lists in candidates_ the blocks of the tile with unset pixels that have no lesser minimum in the
  /// reach common to all pixels of a block, as row << 16 | column; returns their number.
  std::size_t find_candidates() {
    const Tag d;
    const int reach = common_reach_;
    for (int row = -reach; row < tile_.rows + reach; ++row) {
      const std::int32_t* from = around_.data() + offset_in_around(-reach, row);
      std::int32_t* to = least_of_row_.data() + offset_in_around(0, row);
      for (int x = 0; x < tile_.columns; x += kLanes) {
        auto least = hn::LoadU(d, from + x);
        for (int dx = 1; dx <= 2 * reach; ++dx) least = hn::Min(least, hn::LoadU(d, from + x + dx));
        hn::StoreU(least, d, to + x);
      }
    }
    std::size_t count = 0;
    const auto set_mark = hn::Set(d, kSetMark);
    for (int row = 0; row < tile_.rows; ++row) {
      const std::int32_t* rows = least_of_row_.data() + offset_in_around(0, row - reach);
      const std::int32_t* own = around_.data() + offset_in_around(0, row);
      for (int x = 0; x < tile_.columns; x += kLanes) {
        auto least = hn::Min(hn::LoadU(d, rows + x), set_mark);
        for (int dy = 1; dy <= 2 * reach; ++dy) {
          least = hn::Min(least, hn::LoadU(d, rows + dy * stride_ + x));
        }
        const auto in_tile = hn::Lt(hn::Iota(d, 0), hn::Set(d, tile_.columns - x));
        const auto open = hn::And(in_tile, hn::Lt(hn::LoadU(d, own + x), set_mark));
        const auto is_least = hn::And(open, hn::Eq(hn::LoadU(d, own + x), least));
        count += hn::CompressStore(lanes_from(row << 16 | x), is_least, d, candidates_.data() + count);
      }
    }
    return count;
  }

  /// Lists in pixels_ those of the first `count` candidates' least pixels that lead; returns their
  /// number.
  std::size_t keep_leading(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const int y = tile_.top + (candidates_[i] >> 16);
      const int x = tile_.left + (candidates_[i] & 0xffff);
      pixels_[i] = least_pixel(x - (x >= field_.blocks_x ? field_.blocks_x : 0),
                               y - (y >= field_.blocks_y ? field_.blocks_y : 0));
    }
    std::size_t leading = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Pixel pixel = pixels_[i];
      pixels_[leading] = pixel;
      leading += leads(candidates_[i] & 0xffff, candidates_[i] >> 16, pixel) ? 1u : 0u;
    }
    return leading;
  }

  /// Whether the least pixel of the tile's block at (column, row) comes before all blocks it has in
  /// reach.
  HWY_INLINE bool leads(int column, int row, const Pixel& pixel) const {
    const Reach x = reach_of(pixel.x, field_.size.width, field_.reach_x);
    const Reach y = reach_of(pixel.y, field_.size.height, field_.reach_y);
    const std::int32_t* centre = around_.data() + offset_in_around(column, row);
    const Tag d;
    const auto own = hn::Set(d, *centre);
    auto less = hn::MaskFromVec(hn::Zero(d));
    auto equal = less;
    for (int first = -field_.reach_x; first <= field_.reach_x; first += kLanes) {
      const auto dx = lanes_from(first);
      const auto in_reach =
          hn::And(hn::Gt(dx, hn::Set(d, -x.before - 1)), hn::Lt(dx, hn::Set(d, x.after + 1)));
      // Rows beyond the reach are replaced by the last within, so their number is always the same.
      auto others =
          hn::IfThenElse(hn::Eq(dx, hn::Zero(d)), hn::Set(d, INT32_MAX), hn::LoadU(d, centre + first));
      for (int dy = 1; dy <= field_.reach_y; ++dy) {
        others = hn::Min(others, hn::Min(hn::LoadU(d, centre - std::min(dy, y.before) * stride_ + first),
                                         hn::LoadU(d, centre + std::min(dy, y.after) * stride_ + first)));
      }
      less = hn::Or(less, hn::And(in_reach, hn::Lt(others, own)));
      equal = hn::Or(equal, hn::And(in_reach, hn::Eq(others, own)));
    }
    const bool none_less = hn::AllFalse(d, less);
    if (HWY_UNLIKELY(none_less & !hn::AllFalse(d, equal))) return leads_equals(centre, pixel, x, y);
    return none_less;
  }

  /// As leads(), where none is less but some may be equal: the lowest index leads. (A torus may be so
  /// small that a pixel has itself in reach.)
  HWY_NOINLINE bool leads_equals(const std::int32_t* centre, const Pixel& pixel, Reach x, Reach y) const {
    for (int dy = -y.before; dy <= y.after; ++dy) {
      for (int dx = -x.before; dx <= x.after; ++dx) {
        if (centre[dy * stride_ + dx] != *centre) continue;
        const Pixel rival = least_pixel(wrap((pixel.x >> kBlockShift) + dx, field_.blocks_x),
                                        wrap((pixel.y >> kBlockShift) + dy, field_.blocks_y));
        if (rival.y < pixel.y || (rival.y == pixel.y && rival.x < pixel.x)) return false;
      }
    }
    return true;
  }

  /// What a pixel at `x` has in reach; where blocks are cut off at a seam in reach, the most that any has.
  Reach reach_of(int x, int side, int most) const {
    const int radius = kernel_.radius();
    if (side % kBlockSide != 0 && (x < radius || x + radius >= side)) return {most, most};
    const int block = x >> kBlockShift;
    return {block - ((x - radius) >> kBlockShift), ((x + radius) >> kBlockShift) - block};
  }

  /// The block's first pixel of least energy.
  Pixel least_pixel(int block_x, int block_y) const {
    const auto block = static_cast<std::size_t>(block_y * field_.blocks_x + block_x);
    std::int32_t* energy = field_.blocks[block].energy;
    const int at = find_in_block(energy, field_.minimum[block]);
    return {block_x * kBlockSide + at % kBlockSide, block_y * kBlockSide + at / kBlockSide, energy + at};
  }

  void mark(const Pixel& pixel) {
    energy_when_set_[std::int64_t{pixel.y} * field_.size.width + pixel.x] =
        static_cast<std::uint32_t>(*pixel.energy);
    *pixel.energy += kSetMark;
  }

  EnergyField& field_;
  const BlockKernel& kernel_;
  std::uint32_t* const energy_when_set_;
  const int common_reach_;  // in blocks, of all pixels wherever they are in theirs
  BlockRect tile_;
  const int stride_;
  std::vector<std::int32_t> around_;        // the minima of the tile and of what is in its reach
  std::vector<std::int32_t> least_of_row_;  // of the blocks in common reach to the left and right
  std::vector<std::int32_t> candidates_;
  std::vector<Pixel> pixels_;
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
}  // namespace bn::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn::noise {
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

}  // namespace bn::noise
#endif  // HWY_ONCE
