// Void-and-cluster in volumes written down as plainly as it can be: the specification that the fast path must
// equal.

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "bn/random.h"
#include "bn/spatiotemporal.h"
#include "noise/volume_weights.h"

namespace bn {

/// The weights of a kernel between any two voxels of a torus.
class PlainWeights {
 public:
  explicit PlainWeights(const noise::VolumeWeights& weights) : weights_(weights) {}

  /// Of the voxel at slice * height * width + y * width + x, as seen from one that lies at another index.
  std::int64_t between(std::int64_t a, std::int64_t b) const {
    const auto [width, height, z, w] = weights_.sides();
    const int dx = wrap_centred(b % width - a % width, width);
    const int dy = wrap_centred(b / width % height - a / width % height, height);
    if (std::abs(dx) > weights_.reach_x() || std::abs(dy) > weights_.reach_y()) return 0;
    const std::int64_t slice_a = a / width / height;
    const std::int64_t slice_b = b / width / height;
    const int dz = wrap(slice_b % z - slice_a % z, z);
    const int dw = wrap(slice_b / z - slice_a / z, w);
    return weights_.line(dx, dy)[static_cast<std::size_t>(dw * z + dz)];
  }

 private:
  const noise::VolumeWeights& weights_;
};

inline std::int64_t plain_start_energy(std::uint64_t seed, std::uint64_t index) {
  return static_cast<std::int64_t>(random_bits(seed, 2, index / 8) >> (8 * (index % 8)) & 0x1F);
}

/// The energy of each voxel when it was set, one after another.
inline std::vector<std::int64_t> reference_volume_order(const noise::VolumeWeights& weights,
                                                        std::uint64_t seed) {
  const auto [width, height, z, w] = weights.sides();
  const PlainWeights plain(weights);
  const std::int64_t count = std::int64_t{width} * height * z * w;
  std::vector<std::int64_t> energy, when_set(static_cast<std::size_t>(count), -1);
  for (std::int64_t i = 0; i < count; ++i)
    energy.push_back(plain_start_energy(seed, static_cast<std::uint64_t>(i)));
  for (std::int64_t set = 0; set < count; ++set) {
    std::int64_t best = -1;
    for (std::int64_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (when_set[at] < 0 && (best < 0 || energy[at] < energy[static_cast<std::size_t>(best)])) best = i;
    }
    when_set[static_cast<std::size_t>(best)] = energy[static_cast<std::size_t>(best)];
    for (std::int64_t i = 0; i < count; ++i) energy[static_cast<std::size_t>(i)] += plain.between(best, i);
  }
  return when_set;
}

/// For volumes of several slices.
inline Grid<std::uint32_t> reference_volume_mask(const VolumeMaskOptions& options) {
  const noise::VolumeWeights weights(options.size, options.kernel);
  const std::vector<std::int64_t> when_set = reference_volume_order(weights, options.seed);
  // Of voxels set at equal energies, random bits decide, as many as are left of 30, but 16 at most.
  const int bits = std::min(16, 30 - static_cast<int>(std::bit_width(static_cast<std::uint64_t>(
                                         weights.sum() + noise::kVolumeStartLimit))));
  const auto key = [&](std::uint64_t i) {
    const std::uint64_t random = random_bits(options.seed, 3, i / 4) >> (16 * (i % 4)) & ((1u << bits) - 1);
    return std::pair(when_set[i], random);
  };
  std::vector<std::uint32_t> order(when_set.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

  const auto [width, height, z, w] = options.size;
  Grid<std::uint32_t> ranks({width, height, z * w});
  const std::size_t in_slice = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint32_t> next(options.ranks == RankScope::slice ? static_cast<std::size_t>(z * w) : 1);
  for (const std::uint32_t voxel : order) {
    ranks[voxel] = next[options.ranks == RankScope::slice ? voxel / in_slice : 0]++;
  }
  return ranks;
}

}  // namespace bn
