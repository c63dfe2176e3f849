// Adding a kernel to the energies around a pixel, with the vectors of the target it is compiled for.
//
// No include guard of the usual kind: every target compiles its own copy (see Highway's foreach_target.h).

#if defined(BN_NOISE_ADD_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BN_NOISE_ADD_KERNEL_INL_H
#undef BN_NOISE_ADD_KERNEL_INL_H
#else
#define BN_NOISE_ADD_KERNEL_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "noise/energy_field.h"

HWY_BEFORE_NAMESPACE();
namespace bn::noise {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::int32_t, 16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
static_assert(kBlockPixels % kLanes == 0);

/// Adds 64 weights to a block; returns the least sum of each lane.
HWY_INLINE hn::Vec<Tag> add_weights(const std::int32_t* HWY_RESTRICT weights,
                                    std::int32_t* HWY_RESTRICT energy) {
  const Tag d;
  auto least = hn::Add(hn::Load(d, energy), hn::LoadU(d, weights));
  hn::Store(least, d, energy);
  for (int i = kLanes; i < kBlockPixels; i += kLanes) {
    const auto sum = hn::Add(hn::Load(d, energy + i), hn::LoadU(d, weights + i));
    hn::Store(sum, d, energy + i);
    least = hn::Min(least, sum);
  }
  return least;
}

#if HWY_TARGET != HWY_SCALAR
/// Folds a vector until its four lanes are left and stores them.
template <class D>
HWY_INLINE void store_minima_of_quarters(D d, hn::Vec<D> v, std::int32_t* to) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    hn::StoreU(v, d, to);
  } else {
    const hn::Half<D> half;
    store_minima_of_quarters(half, hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v)), to);
  }
}

/// Stores the minimum of each of four vectors: a transposition that takes minima on its way.
HWY_INLINE void store_four_minima(hn::Vec<Tag> v0, hn::Vec<Tag> v1, hn::Vec<Tag> v2, hn::Vec<Tag> v3,
                                  std::int32_t* to) {
  const Tag d;
  const hn::Repartition<std::int64_t, Tag> pairs;
  const auto v01 =
      hn::BitCast(pairs, hn::Min(hn::InterleaveLower(d, v0, v1), hn::InterleaveUpper(d, v0, v1)));
  const auto v23 =
      hn::BitCast(pairs, hn::Min(hn::InterleaveLower(d, v2, v3), hn::InterleaveUpper(d, v2, v3)));
  const auto low = hn::BitCast(d, hn::InterleaveLower(pairs, v01, v23));
  const auto high = hn::BitCast(d, hn::InterleaveUpper(pairs, v01, v23));
  store_minima_of_quarters(d, hn::Min(low, high), to);
}
#endif

/// Adds the kernel around one image of the pixel, which may lie outside the field.
HWY_INLINE void add_image(EnergyField& field, const BlockKernel& kernel, int x, int y) {
  const int left = x - kernel.radius();
  const int top = y - kernel.radius();
  const int block_x = left >> kBlockShift;
  const int block_y = top >> kBlockShift;
  const int phase_x = left & (kBlockSide - 1);
  const int phase_y = top & (kBlockSide - 1);
  const int first_column = std::max(0, -block_x);
  const int columns = std::min(kernel.span(phase_x), field.blocks_x - block_x) - first_column;
  const int first_row = std::max(0, -block_y);
  const int rows = std::min(kernel.span(phase_y), field.blocks_y - block_y) - first_row;
  const std::ptrdiff_t weight_stride = kernel.column_stride();
  for (int row = first_row; row < first_row + rows; ++row) {
    const auto at = static_cast<std::size_t>((block_y + row) * field.blocks_x + block_x + first_column);
    EnergyBlock* blocks = field.blocks.data() + at;
    std::int32_t* minima = field.minimum.data() + at;
    const std::int32_t* weights = kernel.weights(phase_x, first_column, phase_y, row);
    int i = 0;
#if HWY_TARGET != HWY_SCALAR
    for (; i + 4 <= columns; i += 4, weights += 4 * weight_stride) {
      const auto v0 = add_weights(weights, blocks[i].energy);
      const auto v1 = add_weights(weights + weight_stride, blocks[i + 1].energy);
      const auto v2 = add_weights(weights + 2 * weight_stride, blocks[i + 2].energy);
      const auto v3 = add_weights(weights + 3 * weight_stride, blocks[i + 3].energy);
      store_four_minima(v0, v1, v2, v3, minima + i);
    }
#endif
#if HWY_TARGET != HWY_SCALAR
    if (i < columns) {
      const Tag d;
      auto v1 = hn::Set(d, INT32_MAX);
      auto v2 = v1;
      const auto v0 = add_weights(weights, blocks[i].energy);
      if (i + 1 < columns) v1 = add_weights(weights + weight_stride, blocks[i + 1].energy);
      if (i + 2 < columns) v2 = add_weights(weights + 2 * weight_stride, blocks[i + 2].energy);
      alignas(16) std::int32_t least[4];
      store_four_minima(v0, v1, v2, v2, least);
      const hn::CappedTag<std::int32_t, 4> four;
      hn::BlendedStore(hn::Load(four, least), hn::FirstN(four, static_cast<std::size_t>(columns - i)), four,
                       minima + i);
      i = columns;
    }
#endif
    for (; i < columns; ++i, weights += weight_stride) {
      minima[i] = hn::GetLane(hn::MinOfLanes(Tag(), add_weights(weights, blocks[i].energy)));
    }
  }
}

/// Adds the kernel around every image of the pixel whose kernel meets the field.
HWY_INLINE void add_images(EnergyField& field, const BlockKernel& kernel, int x, int y) {
  const int radius = kernel.radius();
  const auto [width, height] = field.size;
  if (x >= radius && y >= radius && x + radius < width && y + radius < height) {
    add_image(field, kernel, x, y);
    return;
  }
  const int first_x = x - (x + radius) / width * width;
  const int first_y = y - (y + radius) / height * height;
  for (int image_y = first_y; image_y - radius < height; image_y += height) {
    for (int image_x = first_x; image_x - radius < width; image_x += width) {
      add_image(field, kernel, image_x, image_y);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace bn::noise
HWY_AFTER_NAMESPACE();

#endif  // BN_NOISE_ADD_KERNEL_INL_H
