// Sets the pixels of a field in the order of their voids, a tile at a time.

#pragma once

#include <cstdint>

#include "noise/energy_field.h"

namespace bn::noise {

/// A rectangle of blocks on the torus: it may run across the seams, but never onto itself.
struct BlockRect {
  int left;
  int top;
  int columns;
  int rows;
};

/// Adds `kernel` around pixel (x, y), everywhere it reaches on the torus, and keeps the minima.
void add_kernel(EnergyField& field, const BlockKernel& kernel, int x, int y);

/// In each round, sets the pixels within `tile` that are the least (energy, index) of all unset pixels
/// in reach; then the tile moves a block, to the left and up in turn, along the axes that it does not
/// span. Ends early when there is no such pixel: the tile is full or waits for its neighbours. Writes the
/// energy of each pixel when it was set to energy_when_set[y * width + x]; returns how many were set. Writes
/// and reads no energy and no minimum farther than the reach of a kernel from where the tile has been.
std::int64_t fill_tile(EnergyField& field, const BlockKernel& kernel, const BlockRect& tile, int rounds,
                       std::uint32_t* energy_when_set);

}  // namespace bn::noise
