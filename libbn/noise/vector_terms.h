// The two sums over the surroundings of voxels that exchanging values needs: the exact change of the energy,
// and a quick estimate for all places of the curve at once.
//
// Distances are integers, floor(8192 |a - b|) computed with IEEE operations in a written order, and weights
// are, so sums do not depend on their order. The functions ending in _plainly are the specification; the
// others equal them bit for bit with the vectors of the machine.

#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "noise/vector_field.h"
#include "noise/vector_kernel.h"

namespace bn::noise {

/// At most 2^14.
inline std::int32_t distance(const ScaledVector& a, const ScaledVector& b, int components) {
  float square = (a[0] - b[0]) * (a[0] - b[0]);
  for (std::size_t k = 1; k < static_cast<std::size_t>(components); ++k) {
    square = square + (a[k] - b[k]) * (a[k] - b[k]);
  }
  return static_cast<std::int32_t>(std::sqrt(square));
}

/// D of two values; `table` as VectorField::unlikeness() gives it.
inline std::int32_t unlikeness(const ScaledVector& a, const ScaledVector& b, int components,
                               const std::int32_t* table) {
  const std::int32_t d = distance(a, b, components);
  return table ? table[d] : d;
}

/// Calls body(column's line, index of its slice 0) for the columns that a voxel sees.
template <class Body>
void for_each_column(const VectorField& field, const VectorKernel& kernel, Voxel at, const Body& body) {
  const auto [width, height, depth] = field.size();
  for (const VectorKernel::Column& column : kernel.columns()) {
    int x = at.x + column.dx;
    int y = at.y + column.dy;
    x += x < 0 ? width : x >= width ? -width : 0;
    y += y < 0 ? height : y >= height ? -height : 0;
    body(kernel.line(column, at.z), field.index(x, y, 0));
  }
}

/// The sum over all n that the voxel sees of A(at - n) (D(to, v_n) - D(from, v_n)): how much more it
/// differs from its surroundings.
std::int64_t gain(const VectorField& field, const VectorKernel& kernel, Voxel at, const ScaledVector& from,
                  const ScaledVector& to);
std::int64_t gain_plainly(const VectorField& field, const VectorKernel& kernel, Voxel at,
                          const ScaledVector& from, const ScaledVector& to);

// --- estimates -------------------------------------------------------------------------------------

/// The curve is cut into so many cells; VectorField::cell() tells a value's.
inline constexpr int kCells = 256;

/// Of distances from cells, so many bits less are kept.
inline constexpr int kCellBits = 4;

/// What a voxel sees of each cell: the sum of its weights, in units of 2^shift, where all are 2^14 at most.
int cell_shift(const VectorKernel& kernel);
void add_up_cells(const VectorField& field, const VectorKernel& kernel, Voxel at, int shift,
                  std::span<float, kCells> seen);

/// Some values, by component, in whole vectors.
class ValueTable {
 public:
  explicit ValueTable(std::span<const ScaledVector> values);
  int count() const { return count_; }
  /// Columns of a table with one for each value: whole vectors, and some, as rows that are a power of two
  /// apart would all go into the same few sets of the cache.
  std::size_t stride() const { return stride_; }
  const float* component(int which) const {
    return components_.data() + static_cast<std::size_t>(which) * stride_;
  }
  ScaledVector value(std::size_t index) const;

 private:
  int count_;
  std::size_t stride_;
  std::vector<float> components_;
};

/// The middle value of each cell.
std::vector<ScaledVector> cell_middles(VectorValues values);

/// How unlike values are to the middle of each cell, D / 2^kCellBits, at most 2^10: of value j to cell k at
/// [k * stride + j].
void distances_from_cells(std::span<const ScaledVector> middles, const ValueTable& values,
                          const VectorField& field, std::span<float> distances);
void distances_from_cells_plainly(std::span<const ScaledVector> middles, const ValueTable& values,
                                  const VectorField& field, std::span<float> distances);

/// How far values are from what voxels see. `seen` has a row of kCells for each voxel; far[i * stride + j]
/// becomes the sum over k of seen[i][k] * distances[k * stride + j], for each of `count` values. All are
/// whole numbers up to 2^24, exact in any order.
void estimate(std::span<const float> seen, std::span<const float> distances, int count, std::size_t stride,
              std::span<float> far);
void estimate_plainly(std::span<const float> seen, std::span<const float> distances, int count,
                      std::size_t stride, std::span<float> far);

}  // namespace bn::noise
