// Sets the voxels of a volume in the order of their voids, a region of columns at a time.

#pragma once

#include <cstdint>

#include "noise/column_field.h"

namespace bn::noise {

/// A rectangle of columns on the torus: it may run across the seams, but never onto itself.
struct ColumnRect {
  int left;
  int top;
  int width;
  int height;
};

/// One visit to a region.
struct ColumnVisit {
  ColumnRect region;
  int passes;  ///< how often starts all over the region are tried
  int moves;   ///< how far the region moves to the left and up meanwhile, along the axes it does not span
  int phase;   ///< which of the columns are starts; count it up from visit to visit
};

/// Sets voxels in the region that are the least (energy, index) of all unset voxels in reach when they are
/// set. Writes the energy of each when it was set to energy_when_set[(slice * height + y) * width + x];
/// returns how many were set. Writes and reads nothing farther than the reach of a kernel from where the
/// region has been.
template <class Lane>
std::int64_t fill_columns(ColumnField<Lane>& field, const ColumnKernel<Lane>& kernel,
                          const ColumnVisit& visit, std::uint32_t* energy_when_set);

}  // namespace bn::noise
