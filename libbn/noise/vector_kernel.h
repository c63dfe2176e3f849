// What the voxels of a vector mask see of each other: the columns of a volume kernel that matter.
//
// The energy of a mask is the sum over pairs of voxels of -A(i - j) d(v_i, v_j): A the weights of
// volume_weights.h, d the distance of two values. Columns whose greatest weight is below 1/kLeastShare of the
// greatest of all are left out: a Gaussian then ends at 3 standard deviations, half of the columns are left,
// and 1 % of the sum is lost.

#pragma once

#include <cstdint>
#include <vector>

#include "noise/volume_weights.h"

namespace bn::noise {

inline constexpr int kLeastShare = 100;

class VectorKernel {
 public:
  /// `weights` are those of a volume of one slice axis (w = 1).
  explicit VectorKernel(const VolumeWeights& weights);
  static std::uint64_t bytes(const TorusSides& sides, const VolumeKernel& kernel);

  /// Columns at a distance from a voxel's own, each of the torus once.
  struct Column {
    int dx;
    int dy;
    std::size_t line;
  };
  const std::vector<Column>& columns() const { return columns_; }
  int slices() const { return slices_; }
  int reach_x() const { return reach_x_; }
  int reach_y() const { return reach_y_; }
  /// The weights of a column as a voxel of slice z sees it: of slice i at [i]. A voxel does not see itself.
  /// kMostLanes may be read beyond the slices.
  const std::int32_t* line(const Column& column, int z) const {
    return lines_.data() + column.line + (slices_ - z);
  }
  /// The weight between two voxels at this distance, each of any sign.
  std::int32_t weight(int dx, int dy, int dz) const;
  /// Of all weights that a voxel sees.
  std::int64_t sum() const { return sum_; }

  static constexpr int kMostLanes = 16;

 private:
  TorusSides sides_;
  int slices_;
  int reach_x_ = 0;
  int reach_y_ = 0;
  std::int64_t sum_ = 0;
  std::vector<Column> columns_;
  std::vector<std::int32_t> column_at_;  // by (dy + reach_y) * (2 reach_x + 1) + dx + reach_x; -1: none
  std::vector<std::int32_t> lines_;      // each twice over, so that any slice can be the first
};

}  // namespace bn::noise
