// Sets the voxels of a volume in the order of their voids, a region of columns at a time.

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "noise/column_field.h"
#include "noise/row_locks.h"
#include "noise/voxel.h"

namespace bn::noise {

/// The columns that a thread fills: rows first..first+count-1.
struct RowRange {
  int first;
  int count;
};

/// What fill_columns() fills, how and with whom.
template <class Lane>
struct ColumnJob {
  ColumnField<Lane>& field;
  const ColumnKernel<Lane>& kernel;
  RowRange rows;
  /// Rows are filled evenly: first what is below this energy, then what is below twice that, and so on.
  std::int32_t step;
  /// Voxels of this energy and above are left unset.
  std::int32_t end = kFullColumn;
  /// Threads that share them may do the same for other rows meanwhile.
  RowLocks& locks;
  /// The energy of each voxel when it was set, index (slice * height + y) * width + x.
  std::uint32_t* energy_when_set;
  /// Called with the voxels set since the last call, every few milliseconds at most. It may throw.
  std::function<void(std::int64_t)> progress;
};

/// Sets all voxels of the rows whose energy stays below job.end, and what must come before them wherever it
/// lies, always voxels that are the least (energy, index) of all unset voxels in reach when they are set.
void fill_columns(const ColumnJob<std::uint16_t>& job);
void fill_columns(const ColumnJob<std::int32_t>& job);

/// Sets voxels that are given in slices of half the size, one after another, each at that of its four places
/// which has the least energy, the first of equal ones. Returns where.
std::vector<Voxel> set_voxels(ColumnField<std::uint16_t>& field, const ColumnKernel<std::uint16_t>& kernel,
                              std::span<const Voxel> voxels);
std::vector<Voxel> set_voxels(ColumnField<std::int32_t>& field, const ColumnKernel<std::int32_t>& kernel,
                              std::span<const Voxel> voxels);

}  // namespace bn::noise
