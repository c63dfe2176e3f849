// Sets the voxels of a volume in the order of their voids, a region of columns at a time.

#pragma once

#include <cstdint>
#include <functional>

#include "noise/column_field.h"
#include "noise/row_locks.h"

namespace bn::noise {

/// The columns that a thread fills: rows first..first+count-1.
struct RowRange {
  int first;
  int count;
};

/// Sets all voxels of the rows, and what must come before them wherever it lies, always voxels that are the
/// least (energy, index) of all unset voxels in reach when they are set. Rows are filled evenly: first what
/// is below an energy of `step`, then what is below twice that, and so on. Threads that share `locks` may do
/// the same for other rows meanwhile. Writes the energy of each voxel when it was set to
/// energy_when_set[(slice * height + y) * width + x]. Calls progress(voxels set since the last call) every
/// few milliseconds at most; it may throw.
template <class Lane>
void fill_columns(ColumnField<Lane>& field, const ColumnKernel<Lane>& kernel, RowRange rows,
                  std::int32_t step, RowLocks& locks, std::uint32_t* energy_when_set,
                  const std::function<void(std::int64_t)>& progress);

}  // namespace bn::noise
