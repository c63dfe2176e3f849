// SCALAR, Highway's one-lane target, runs the plain functions.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/vector_terms.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

#include <type_traits>

#include "noise/vector_terms.h"

HWY_BEFORE_NAMESPACE();
namespace bn::noise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

std::int64_t Gain(const VectorField& field, const VectorKernel& kernel, Voxel at, const ScaledVector& from,
                  const ScaledVector& to) {
  return gain_plainly(field, kernel, at, from, to);
}

void Estimate(std::span<const float> seen, std::span<const float> distances, int count, std::size_t stride,
              std::span<float> far) {
  estimate_plainly(seen, distances, count, stride, far);
}

void FromCells(std::span<const ScaledVector> middles, const ValueTable& values, const VectorField& field,
               std::span<float> distances) {
  distances_from_cells_plainly(middles, values, field, distances);
}

#else

/// unlikeness() of values; kTable: whether there is one.
template <int kComponents, bool kTable, class D>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> unlike(const hn::Vec<D>* values, const hn::Vec<D>* to,
                                                 const std::int32_t* table) {
  auto square = hn::Mul(hn::Sub(to[0], values[0]), hn::Sub(to[0], values[0]));
  for (int k = 1; k < kComponents; ++k) {
    square = hn::Add(square, hn::Mul(hn::Sub(to[k], values[k]), hn::Sub(to[k], values[k])));
  }
  const hn::RebindToSigned<D> di;
  const auto distance = hn::ConvertTo(di, hn::Sqrt(square));
  if constexpr (kTable) return hn::GatherIndex(di, table, distance);
  return distance;
}

template <int kComponents, bool kTable, int kLanes>
HWY_INLINE std::int64_t gain_of(const VectorField& field, const VectorKernel& kernel, Voxel at,
                                const ScaledVector& from, const ScaledVector& to) {
  const hn::CappedTag<float, kLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Half<decltype(di)> half;
  const hn::RepartitionToWide<decltype(di)> wide;
  using Vector = hn::Vec<decltype(d)>;
  constexpr int kStep = static_cast<int>(hn::MaxLanes(d));
  // A product is below 2^26, so a lane holds the sum of 16.
  constexpr int kMostProducts = 16;

  Vector old_value[kComponents], new_value[kComponents];
  const float* components[kComponents];
  for (int k = 0; k < kComponents; ++k) {
    old_value[k] = hn::Set(d, from[static_cast<std::size_t>(k)]);
    new_value[k] = hn::Set(d, to[static_cast<std::size_t>(k)]);
    components[k] = field.component(k);
  }
  auto total = hn::Zero(wide);
  auto sum = hn::Zero(di);
  int products = 0;
  const auto flush = [&] {
    total = hn::Add(total, hn::Add(hn::PromoteTo(wide, hn::LowerHalf(half, sum)),
                                   hn::PromoteTo(wide, hn::UpperHalf(half, sum))));
    sum = hn::Zero(di);
    products = 0;
  };
  const int slices = kernel.slices();
  const std::int32_t* table = field.unlikeness();
  for_each_column(field, kernel, at, [&](const std::int32_t* line, std::size_t column) {
    for (int z = 0; z < slices; z += kStep) {
      Vector values[kComponents];
      for (int k = 0; k < kComponents; ++k) values[k] = hn::Load(d, components[k] + column + z);
      auto weights = hn::LoadU(di, line + z);
      if (z + kStep > slices) {
        weights = hn::IfThenElseZero(hn::FirstN(di, static_cast<std::size_t>(slices - z)), weights);
      }
      const auto farther = hn::Sub(unlike<kComponents, kTable, decltype(d)>(values, new_value, table),
                                   unlike<kComponents, kTable, decltype(d)>(values, old_value, table));
      sum = hn::Add(sum, hn::Mul(weights, farther));
      if (++products == kMostProducts) flush();
    }
  });
  flush();
  return hn::GetLane(hn::SumOfLanes(wide, total));
}

/// Calls what(components, whether there is a table) with constants.
template <class What>
HWY_INLINE auto with_constants(const VectorField& field, const What& what) {
  const auto by_table = [&](auto components) {
    return field.unlikeness() ? what(components, std::true_type()) : what(components, std::false_type());
  };
  switch (field.components()) {
    case 2:
      return by_table(std::integral_constant<int, 2>());
    case 3:
      return by_table(std::integral_constant<int, 3>());
    default:
      return by_table(std::integral_constant<int, 4>());
  }
}

std::int64_t Gain(const VectorField& field, const VectorKernel& kernel, Voxel at, const ScaledVector& from,
                  const ScaledVector& to) {
  return with_constants(field, [&](auto components, auto table) {
    return field.stride() == 4 ? gain_of<components(), table(), 4>(field, kernel, at, from, to)
                               : gain_of<components(), table(), 16>(field, kernel, at, from, to);
  });
}

/// estimate() of kRows rows, two vectors of values at a time.
template <std::size_t kRows>
HWY_INLINE void estimate_rows(const float* HWY_RESTRICT seen, const float* HWY_RESTRICT distances, int count,
                              std::size_t stride, float* HWY_RESTRICT far) {
  const hn::CappedTag<float, 16> d;
  constexpr int kStep = static_cast<int>(hn::MaxLanes(d));
  using Vector = hn::Vec<decltype(d)>;
  for (int j = 0; j < count; j += 2 * kStep) {
    Vector low[kRows], high[kRows];
    for (std::size_t row = 0; row < kRows; ++row) low[row] = high[row] = hn::Zero(d);
    for (std::size_t k = 0; k < kCells; ++k) {
      const Vector to_low = hn::LoadU(d, distances + k * stride + j);
      const Vector to_high = hn::LoadU(d, distances + k * stride + j + kStep);
      for (std::size_t row = 0; row < kRows; ++row) {
        const Vector weight = hn::Set(d, seen[row * kCells + k]);
        low[row] = hn::MulAdd(weight, to_low, low[row]);
        high[row] = hn::MulAdd(weight, to_high, high[row]);
      }
    }
    for (std::size_t row = 0; row < kRows; ++row) {
      hn::StoreU(low[row], d, far + row * stride + j);
      hn::StoreU(high[row], d, far + row * stride + j + kStep);
    }
  }
}

void Estimate(std::span<const float> seen, std::span<const float> distances, int count, std::size_t stride,
              std::span<float> far) {
  constexpr std::size_t kRows = 8;
  const std::size_t rows = seen.size() / kCells;
  std::size_t row = 0;
  for (; row + kRows <= rows; row += kRows) {
    estimate_rows<kRows>(seen.data() + row * kCells, distances.data(), count, stride,
                         far.data() + row * stride);
  }
  for (; row < rows; ++row) {
    estimate_rows<1>(seen.data() + row * kCells, distances.data(), count, stride, far.data() + row * stride);
  }
}

template <int kComponents, bool kTable>
HWY_INLINE void from_cells(std::span<const ScaledVector> middles, const ValueTable& values,
                           const std::int32_t* table, std::span<float> distances) {
  const hn::CappedTag<float, 16> d;
  using Vector = hn::Vec<decltype(d)>;
  for (int j = 0; j < values.count(); j += static_cast<int>(hn::MaxLanes(d))) {
    Vector value[kComponents];
    for (int c = 0; c < kComponents; ++c) value[c] = hn::LoadU(d, values.component(c) + j);
    for (std::size_t k = 0; k < middles.size(); ++k) {
      Vector middle[kComponents];
      for (int c = 0; c < kComponents; ++c) middle[c] = hn::Set(d, middles[k][static_cast<std::size_t>(c)]);
      const auto coarse =
          hn::ShiftRight<kCellBits>(unlike<kComponents, kTable, decltype(d)>(value, middle, table));
      hn::StoreU(hn::ConvertTo(d, coarse), d, distances.data() + k * values.stride() + j);
    }
  }
}

void FromCells(std::span<const ScaledVector> middles, const ValueTable& values, const VectorField& field,
               std::span<float> distances) {
  with_constants(field, [&](auto components, auto table) {
    from_cells<components(), table()>(middles, values, field.unlikeness(), distances);
  });
}

#endif

}  // namespace bn::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn::noise {

HWY_EXPORT(Gain);
HWY_EXPORT(Estimate);
HWY_EXPORT(FromCells);

std::int64_t gain(const VectorField& field, const VectorKernel& kernel, Voxel at, const ScaledVector& from,
                  const ScaledVector& to) {
  return HWY_DYNAMIC_DISPATCH(Gain)(field, kernel, at, from, to);
}

void estimate(std::span<const float> seen, std::span<const float> distances, int count, std::size_t stride,
              std::span<float> far) {
  HWY_DYNAMIC_DISPATCH(Estimate)(seen, distances, count, stride, far);
}

std::int64_t gain_plainly(const VectorField& field, const VectorKernel& kernel, Voxel at,
                          const ScaledVector& from, const ScaledVector& to) {
  std::int64_t sum = 0;
  for_each_column(field, kernel, at, [&](const std::int32_t* line, std::size_t column) {
    for (int z = 0; z < kernel.slices(); ++z) {
      const ScaledVector seen = field.value(column + static_cast<std::size_t>(z));
      sum += std::int64_t{line[z]} * (unlikeness(to, seen, field.components(), field.unlikeness()) -
                                      unlikeness(from, seen, field.components(), field.unlikeness()));
    }
  });
  return sum;
}

void estimate_plainly(std::span<const float> seen, std::span<const float> distances, int count,
                      std::size_t stride, std::span<float> far) {
  for (std::size_t i = 0; i < seen.size() / kCells; ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
      float sum = 0.0f;
      for (std::size_t k = 0; k < kCells; ++k) sum = sum + seen[i * kCells + k] * distances[k * stride + j];
      far[i * stride + j] = sum;
    }
  }
}

void distances_from_cells(std::span<const ScaledVector> middles, const ValueTable& values,
                          const VectorField& field, std::span<float> distances) {
  HWY_DYNAMIC_DISPATCH(FromCells)(middles, values, field, distances);
}

void distances_from_cells_plainly(std::span<const ScaledVector> middles, const ValueTable& values,
                                  const VectorField& field, std::span<float> distances) {
  for (std::size_t k = 0; k < middles.size(); ++k) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(values.count()); ++j) {
      distances[k * values.stride() + j] = static_cast<float>(
          unlikeness(middles[k], values.value(j), field.components(), field.unlikeness()) >> kCellBits);
    }
  }
}

ValueTable::ValueTable(std::span<const ScaledVector> values)
    : count_(static_cast<int>(values.size())),
      stride_((values.size() + 31) / 32 * 32 + 16),
      components_(4 * stride_) {
  for (std::size_t j = 0; j < values.size(); ++j) {
    for (std::size_t k = 0; k < 4; ++k) components_[k * stride_ + j] = values[j][k];
  }
}

ScaledVector ValueTable::value(std::size_t index) const {
  ScaledVector value;
  for (std::size_t k = 0; k < 4; ++k) value[k] = components_[k * stride_ + index];
  return value;
}

std::vector<ScaledVector> cell_middles(VectorValues values) {
  std::vector<ScaledVector> middles;
  for (std::uint32_t k = 0; k < kCells; ++k) middles.push_back(scaled_value(values, (2 * k + 1) << 23));
  return middles;
}

int cell_shift(const VectorKernel& kernel) {
  int shift = 0;
  while (kernel.sum() >> shift > 1 << 14) ++shift;
  return shift;
}

void add_up_cells(const VectorField& field, const VectorKernel& kernel, Voxel at, int shift,
                  std::span<float, kCells> seen) {
  // Four sums, so that equal cells one after the other need not wait for each other.
  constexpr int kSums = 4;
  std::uint32_t sums[kSums][kCells] = {};
  const int slices = kernel.slices();
  for_each_column(field, kernel, at, [&](const std::int32_t* line, std::size_t column) {
    const std::uint8_t* cells = field.cells() + column;
    int z = 0;
    for (; z + kSums <= slices; z += kSums) {
      for (int i = 0; i < kSums; ++i) sums[i][cells[z + i]] += static_cast<std::uint32_t>(line[z + i]);
    }
    for (; z < slices; ++z) sums[0][cells[z]] += static_cast<std::uint32_t>(line[z]);
  });
  for (std::size_t k = 0; k < kCells; ++k) {
    seen[k] = static_cast<float>((sums[0][k] + sums[1][k] + sums[2][k] + sums[3][k]) >> shift);
  }
}

}  // namespace bn::noise
#endif
