// The energies of all voxels of a volume, stored column by column: what lies at one pixel in all slices is
// contiguous in memory. Adding a kernel is then a run of vector additions a column, and the least energy of
// the column falls out of the same pass. Columns play the part that pixels play in two dimensions.
//
// Energies are 16 bits wide, relative to a base of the column that follows its least energy; wide enough in
// practice, not for sure. Additions saturate, and the mark of a set voxel is the value that they end at. So a
// voxel too far above its column to be represented counts as set though it never was; it is missed in the end
// (volume_order.cpp), and the work is done again in 32 bits, where all energies fit.

#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bn/grid.h"
#include "noise/gaussian_kernel.h"
#include "noise/volume_weights.h"

namespace bn::noise {

/// The least energy of a column without unset voxels.
inline constexpr std::int32_t kFullColumn = std::numeric_limits<std::int32_t>::max();

/// How energies are stored in a lane.
template <class Lane>
struct Lanes;

template <>
struct Lanes<std::uint16_t> {
  /// Lanes from here on count as set.
  static constexpr std::uint16_t kSet = 65535;
  /// When the least energy of a column is as much above its base, the base is raised.
  static constexpr std::uint16_t kRebase = 32768;
  static constexpr int kMostInVector = 32;
};

template <>
struct Lanes<std::int32_t> {
  static constexpr std::int32_t kSet = kSetMark;
  static constexpr std::int32_t kRebase = kSetMark;
  static constexpr int kMostInVector = 8;
};

template <class Lane>
class ColumnField {
 public:
  /// A volume of unset voxels whose energies are 0.
  ColumnField(Extent columns, int slices);
  static std::uint64_t bytes(Extent columns, int slices);

  Extent columns() const { return columns_; }
  int slices() const { return slices_; }
  /// Lanes from one column to the next; those beyond the slices count as set.
  int stride() const { return stride_; }
  Lane* column(std::int64_t index) { return lanes() + index * stride_; }
  const Lane* column(std::int64_t index) const { return lanes() + index * stride_; }
  /// Recomputes the least energy of a column.
  void update_least(std::int64_t index);
  /// The energy of an unset voxel of a column.
  std::int32_t energy(std::int64_t index, int slice) const {
    return base[static_cast<std::size_t>(index)] + column(index)[slice];
  }

  std::vector<std::int32_t> base;   // by column, y * width + x
  std::vector<std::int32_t> least;  // energies, or kFullColumn

 private:
  struct alignas(64) CacheLine {
    Lane lanes[64 / sizeof(Lane)];
  };
  Lane* lanes() { return memory_.front().lanes; }
  const Lane* lanes() const { return memory_.front().lanes; }

  Extent columns_;
  int slices_;
  int stride_;
  std::vector<CacheLine> memory_;
};

/// A kernel laid out for ColumnField. Its weights at one (|dx|, |dy|) are a *line*, stored twice over along
/// the outer axis of the slices, so that the weights around any slice are found side by side, and once for
/// each position along the inner axis, which volumes of three axes do not have.
template <class Lane>
class ColumnKernel {
 public:
  explicit ColumnKernel(const VolumeWeights& weights);

  /// Columns first..first+count-1 to the right of the centre, in the row `dy` below.
  struct Segment {
    int dy;
    int first;
    int count;
    bool in_slice;            // only the slice of the centre has weights
    std::size_t first_entry;  // of entries(), one a column
  };
  const std::vector<Segment>& segments() const { return segments_; }
  /// Where a column's line begins; where `in_slice`, its one weight.
  const std::uint32_t* entries(const Segment& segment) const { return entries_.data() + segment.first_entry; }
  /// What to add to the beginning of a line for the weights around `slice`.
  std::ptrdiff_t shift(int slice) const {
    const int inner = slice % inner_;
    const int outer = slice / inner_;
    return std::ptrdiff_t{inner} * variant_stride_ + std::ptrdiff_t{(outer_ - outer) % outer_} * inner_;
  }
  const Lane* lines() const { return lines_.data(); }

  /// Columns that see each other are within [first_x, last_x] x [first_y, last_y] of each other, each once.
  int first_x, last_x, first_y, last_y;

 private:
  std::uint32_t add_line(std::span<const std::int32_t> line, int stride);

  int inner_;
  int outer_;
  int variant_stride_;
  std::vector<Segment> segments_;
  std::vector<std::uint32_t> entries_;
  std::vector<Lane> lines_;
};

/// Lanes from one column of so many slices to the next.
template <class Lane>
int column_stride(int slices);

}  // namespace bn::noise
