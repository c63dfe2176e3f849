// Adding a kernel to the columns around a voxel, with the vectors of the target it is compiled for.
//
// No include guard of the usual kind: every target compiles its own copy (see Highway's foreach_target.h).

#if defined(BN_NOISE_ADD_COLUMN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BN_NOISE_ADD_COLUMN_INL_H
#undef BN_NOISE_ADD_COLUMN_INL_H
#else
#define BN_NOISE_ADD_COLUMN_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "noise/column_field.h"

HWY_BEFORE_NAMESPACE();
namespace bn::noise {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Set voxels stay set: 16-bit sums end at their mark, 32-bit ones stay above it.
template <class D>
HWY_INLINE hn::Vec<D> add_weights(D, hn::Vec<D> energies, hn::Vec<D> weights) {
  if constexpr (sizeof(hn::TFromD<D>) == 2) {
    return hn::SaturatedAdd(energies, weights);
  } else {
    return hn::Add(energies, weights);
  }
}

inline std::uint16_t add_weight(std::uint16_t energy, std::uint32_t weight) {
  return static_cast<std::uint16_t>(std::min<std::uint32_t>(energy + weight, 65535));
}
inline std::int32_t add_weight(std::int32_t energy, std::uint32_t weight) {
  return energy + static_cast<std::int32_t>(weight);
}

/// The least lane. (Halves first: of eight 16-bit lanes some targets find the least in one instruction.)
template <class D>
HWY_INLINE hn::TFromD<D> least_lane(D d, hn::Vec<D> v) {
  if constexpr (hn::MaxLanes(D()) * sizeof(hn::TFromD<D>) <= 16) {
    return hn::GetLane(hn::MinOfLanes(d, v));
  } else {
#if HWY_TARGET != HWY_SCALAR
    const hn::Half<D> half;
    return least_lane(half, hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
#endif
  }
}

/// Columns and kernel under the vectors of one width; D's lanes divide the stride.
template <class D>
class ColumnAdder {
 public:
  using Lane = hn::TFromD<D>;

  ColumnAdder(ColumnField<Lane>& field, const ColumnKernel<Lane>& kernel) : field_(field), kernel_(kernel) {}

  /// The first slice of a column whose energy is `lane` above the base, which one's is.
  HWY_INLINE int find_slice(std::int64_t column, Lane lane) const {
    const D d;
    const auto wanted = hn::Set(d, lane);
    const Lane* from = field_.column(column);
    for (int i = 0;; i += kLanes) {
      const std::intptr_t found = hn::FindFirstTrue(d, hn::Eq(hn::Load(d, from + i), wanted));
      if (found >= 0) return i + static_cast<int>(found);
    }
  }

  /// Adds the kernel around the voxel, everywhere on the torus, and keeps the least energies of columns.
  HWY_INLINE void add(int x, int y, int slice) {
    switch (field_.stride() / kLanes) {
      case 1:
        return add_vectors<1>(x, y, slice);
      case 2:
        return add_vectors<2>(x, y, slice);
      case 4:
        return add_vectors<4>(x, y, slice);
      default:
        return add_vectors<0>(x, y, slice);
    }
  }

  /// Recomputes the least energy of a column.
  HWY_NOINLINE void update(std::int64_t column) {
    const D d;
    const Lane* energies = field_.column(column);
    auto least = hn::Load(d, energies);
    for (int i = kLanes; i < field_.stride(); i += kLanes) least = hn::Min(least, hn::Load(d, energies + i));
    const Lane lane = least_lane(d, least);
    if (lane >= Lanes<Lane>::kRebase) return rebase(column, lane);
    const auto at = static_cast<std::size_t>(column);
    field_.least[at] = field_.base[at] + lane;
  }

 private:
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

  /// add() for columns of so many vectors; 0: of any number.
  template <int kVectors>
  HWY_INLINE void add_vectors(int x, int y, int slice) {
    const auto [width, height] = field_.columns();
    const Lane* lines = kernel_.lines() + kernel_.shift(slice);
    for (const auto& segment : kernel_.segments()) {
      int row = y + segment.dy;
      row += row < 0 ? height : row >= height ? -height : 0;
      int first = x + segment.first;
      first += first < 0 ? width : first >= width ? -width : 0;
      const std::int64_t begin = std::int64_t{row} * width;
      const int until_seam = std::min(segment.count, width - first);
      const std::uint32_t* entries = kernel_.entries(segment);
      if (segment.in_slice) {
        add_in_slice(begin + first, until_seam, slice, entries);
        add_in_slice(begin, segment.count - until_seam, slice, entries + until_seam);
      } else {
        add_lines<kVectors>(begin + first, until_seam, lines, entries);
        add_lines<kVectors>(begin, segment.count - until_seam, lines, entries + until_seam);
      }
    }
  }

  template <int kVectors>
  HWY_INLINE void add_lines(std::int64_t column, int count, const Lane* lines, const std::uint32_t* entries) {
    Lane* energies = field_.column(column);
    const std::int32_t* base = field_.base.data() + column;
    std::int32_t* least = field_.least.data() + column;
    const int stride = kVectors == 0 ? field_.stride() : kVectors * kLanes;
    for (int i = 0; i < count; ++i, energies += stride) {
      const Lane lane = add_line(energies, lines + entries[i], stride);
      if (HWY_UNLIKELY(lane >= Lanes<Lane>::kRebase)) {
        rebase(column + i, lane);
      } else {
        least[i] = base[i] + lane;
      }
    }
  }

  /// Adds the weights to the energies of a column and returns the least sum.
  static HWY_INLINE Lane add_line(Lane* HWY_RESTRICT energies, const Lane* HWY_RESTRICT weights, int stride) {
    const D d;
    auto least = add_weights(d, hn::Load(d, energies), hn::LoadU(d, weights));
    hn::Store(least, d, energies);
    for (int i = kLanes; i < stride; i += kLanes) {
      const auto sum = add_weights(d, hn::Load(d, energies + i), hn::LoadU(d, weights + i));
      hn::Store(sum, d, energies + i);
      least = hn::Min(least, sum);
    }
    return least_lane(d, least);
  }

  HWY_INLINE void add_in_slice(std::int64_t column, int count, int slice, const std::uint32_t* weights) {
    Lane* energies = field_.column(column) + slice;
    const std::int32_t* base = field_.base.data() + column;
    const std::int32_t* least = field_.least.data() + column;
    const std::ptrdiff_t stride = field_.stride();
    for (int i = 0; i < count; ++i, energies += stride) {
      const Lane energy = *energies;
      *energies = add_weight(energy, weights[i]);
      if (HWY_UNLIKELY(base[i] + energy == least[i])) update(column + i);
    }
  }

  /// Raises the base of a column to its least energy, `lane` above the present one.
  HWY_NOINLINE void rebase(std::int64_t column, Lane lane) {
    const auto at = static_cast<std::size_t>(column);
    if (lane >= Lanes<Lane>::kSet) {
      field_.least[at] = kFullColumn;
      return;
    }
    const D d;
    const auto set = hn::Set(d, Lanes<Lane>::kSet);
    const auto raise = hn::Set(d, lane);
    Lane* energies = field_.column(column);
    for (int i = 0; i < field_.stride(); i += kLanes) {
      const auto before = hn::Load(d, energies + i);
      hn::Store(hn::IfThenElse(hn::Eq(before, set), before, hn::Sub(before, raise)), d, energies + i);
    }
    field_.base[at] += lane;
    field_.least[at] = field_.base[at];
  }

  ColumnField<Lane>& field_;
  const ColumnKernel<Lane>& kernel_;
};

}  // namespace HWY_NAMESPACE
}  // namespace bn::noise
HWY_AFTER_NAMESPACE();

#endif  // BN_NOISE_ADD_COLUMN_INL_H
