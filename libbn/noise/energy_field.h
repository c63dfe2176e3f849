// The energies of all pixels, stored block by block, with the least energy of each block.
//
// A block is 8x8 pixels, contiguous in memory, so that the reach of a kernel is a handful of whole
// blocks: adding it is a run of aligned vector additions whatever the width of the vectors, and the new
// minimum of a block falls out of the same pass. Blocks beyond the right or lower edge are filled up
// with pixels that count as set.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bn/grid.h"
#include "noise/gaussian_kernel.h"

namespace bn::noise {

inline constexpr int kBlockShift = 3;
inline constexpr int kBlockSide = 1 << kBlockShift;
inline constexpr int kBlockPixels = kBlockSide * kBlockSide;

/// The energies of one block, row by row.
struct alignas(64) EnergyBlock {
  std::int32_t energy[kBlockPixels];
};

struct EnergyField {
  /// A field of equal energies for pixels that see each other up to `radius` apart. `energy` must be
  /// such that the filling pixels beyond the edges, which keep it, always count as set.
  EnergyField(Extent size, int radius, std::int32_t energy);
  /// The bytes that a field takes.
  static std::uint64_t bytes(Extent size);

  std::int32_t& at(int x, int y) {
    const int block = (y >> kBlockShift) * blocks_x + (x >> kBlockShift);
    const int in_block = (y & (kBlockSide - 1)) * kBlockSide + (x & (kBlockSide - 1));
    return blocks[static_cast<std::size_t>(block)].energy[in_block];
  }
  /// The memory of all energies, for another use when they are needed no more.
  std::span<std::uint32_t> memory() {
    return {reinterpret_cast<std::uint32_t*>(blocks.data()), blocks.size() * kBlockPixels};
  }
  /// Recomputes every block's minimum, after energies were written.
  void update_minima();

  Extent size;
  int blocks_x;
  int blocks_y;
  /// Two pixels within the radius are at most so many blocks apart, around the torus too.
  int reach_x;
  int reach_y;
  std::vector<EnergyBlock> blocks;    // index block_y * blocks_x + block_x
  std::vector<std::int32_t> minimum;  // same index, and some room for whole vectors at the end
};

/// A kernel laid out for EnergyField: for each position of its left edge within a block (the phase),
/// its columns of blocks from left to right, each with the weights of all rows, eight to a row, between
/// rows of zeros. Every block that a kernel meets thus finds its 64 weights side by side.
class BlockKernel {
 public:
  /// `sign` is 1 for a kernel that is added, -1 for one that is taken away.
  BlockKernel(const PixelKernel& kernel, int sign);

  int radius() const { return radius_; }
  /// Blocks that the kernel touches along one axis.
  int span(int phase) const { return (phase + 2 * radius_) / kBlockSide + 1; }
  /// The 64 weights for the block at (column, row) of the span.
  const std::int32_t* weights(int phase_x, int column, int phase_y, int row) const {
    return weights_.data() + (phase_x * max_span_ + column) * column_stride() +
           (kBlockSide * row - phase_y + kBlockSide - 1) * kBlockSide;
  }
  /// From a block's weights to those of the block on its right.
  std::ptrdiff_t column_stride() const { return std::ptrdiff_t{rows_} * kBlockSide; }

 private:
  int radius_;
  int max_span_;
  int rows_;
  std::vector<std::int32_t> weights_;
};

}  // namespace bn::noise
