// Void-and-cluster in volumes written down as plainly as it can be: the specification that the fast path must
// equal.

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "bn/random.h"
#include "bn/spatiotemporal.h"
#include "core/reproducible_math.h"
#include "noise/axis_function.h"
#include "noise/volume_weights.h"
#include "reference_void_and_cluster.h"

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

/// Voxels that are set one after another.
class PlainVolume {
 public:
  PlainVolume(const noise::VolumeWeights& weights, std::uint64_t seed)
      : weights_(weights), plain_(weights_), when_set(count(weights.sides()), -1) {
    for (std::size_t i = 0; i < when_set.size(); ++i) energy_.push_back(plain_start_energy(seed, i));
  }
  static std::size_t count(const TorusSides& s) {
    return static_cast<std::size_t>(std::int64_t{s.x} * s.y * s.z * s.w);
  }

  /// Sets the voxel of least energy, the lowest index of equal ones, and returns it.
  std::size_t set_largest_void() {
    std::size_t best = when_set.size();
    for (std::size_t i = 0; i < when_set.size(); ++i) {
      if (when_set[i] < 0 && (best == when_set.size() || energy_[i] < energy_[best])) best = i;
    }
    set(best);
    return best;
  }

  /// Sets a voxel that is given in slices of half the size at that of its four places which has the least
  /// energy, the first of equal ones, and returns it.
  std::size_t set_of_half(const TorusSides& half, std::size_t voxel) {
    const auto [width, height, z, w] = weights_.sides();
    const auto half_width = static_cast<std::size_t>(half.x), half_height = static_cast<std::size_t>(half.y);
    std::size_t best = when_set.size();
    for (std::size_t place = 0; place < 4; ++place) {
      const std::size_t x =
          (2 * (voxel % half_width) + place % 2) * static_cast<std::size_t>(width) / (2 * half_width);
      const std::size_t y = (2 * (voxel / half_width % half_height) + place / 2) *
                            static_cast<std::size_t>(height) / (2 * half_height);
      const std::size_t slice = voxel / half_width / half_height;
      const std::size_t i =
          (slice * static_cast<std::size_t>(height) + y) * static_cast<std::size_t>(width) + x;
      if (best == when_set.size() || energy_[i] < energy_[best]) best = i;
    }
    set(best);
    return best;
  }

 private:
  const noise::VolumeWeights weights_;
  const PlainWeights plain_;
  std::vector<std::int64_t> energy_;

  void set(std::size_t voxel) {
    when_set[voxel] = energy_[voxel];
    for (std::size_t i = 0; i < energy_.size(); ++i)
      energy_[i] += plain_.between(static_cast<std::int64_t>(voxel), static_cast<std::int64_t>(i));
  }

 public:
  std::vector<std::int64_t> when_set;  ///< energies; -1: not set
};

/// The first voxels in slices of half the size (first_voxels.h), `most` of them at most.
inline std::vector<std::size_t> reference_first_voxels(const noise::VolumeWeights& weights,
                                                       const VolumeKernel& kernel, std::uint64_t seed,
                                                       std::int64_t most = INT64_MAX,
                                                       std::uint32_t level = 1) {
  const TorusSides& s = weights.sides();
  int sight = 0;
  while (sight < weights.reach_x() && weights.line(sight + 1, 0)[0] >= 32) ++sight;
  const int apart = (5 * std::max(sight, 3) + 1) / 2;
  const std::int64_t count = std::min(most, s.x * s.y / (apart * apart) * std::int64_t{s.z} * s.w);
  if (count == 0) return {};
  VolumeKernel coarse = kernel;
  for (KernelTerm& term : coarse) {
    for (AxisFunction* f : {&term.x, &term.y}) {
      if (f->form != AxisForm::one && f->form != AxisForm::delta) *f = {AxisForm::gauss, 1.9};
    }
  }
  const TorusSides half{std::max(s.x / 2, 1), std::max(s.y / 2, 1), s.z, s.w};
  const TorusSides quarter{std::max(half.x / 2, 1), std::max(half.y / 2, 1), s.z, s.w};
  const noise::VolumeWeights half_weights(half, coarse);
  PlainVolume volume(half_weights, random_bits(seed, 64 + level, 0));
  std::vector<std::size_t> voxels;
  for (const std::size_t voxel : reference_first_voxels(half_weights, kernel, seed, count, level + 1))
    voxels.push_back(volume.set_of_half(quarter, voxel));
  while (std::ssize(voxels) < count) voxels.push_back(volume.set_largest_void());
  return voxels;
}

/// Fills the last holes of all slices in another order (last_voxels.h). `ranks` are those of slices.
inline void reference_last_voxels(Grid<std::uint32_t>& ranks, const noise::VolumeWeights& weights,
                                  const VolumeKernel& kernel) {
  const auto [width, height, z, w] = weights.sides();
  // What is seen in time, but by the same pixel only: in the own slice 256, in others three times as much.
  std::vector<double> time(static_cast<std::size_t>(z * w));
  for (const KernelTerm& term : kernel) {
    if (term.x.form == AxisForm::delta && term.y.form == AxisForm::delta) continue;
    for (std::size_t i = 0; i < time.size(); ++i) {
      time[i] += term.weight * noise::wrapped(term.z, z)[i % static_cast<std::size_t>(z)] *
                 noise::wrapped(term.w, w)[i / static_cast<std::size_t>(z)];
    }
  }
  if (time[0] == 0.0) return;
  std::vector<int> seen;
  for (const double value : time) seen.push_back(static_cast<int>(768.0 * value / time[0] + 0.5));
  seen[0] /= 3;
  int most = 0, all = 0;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    most = std::max(most, seen[i]);
    all += seen[i];
  }

  int sight = 0;
  while (sight < weights.reach_x() && weights.line(sight + 1, 0)[0] >= 32) ++sight;
  const int apart = std::max(sight, 8);
  const auto area = static_cast<std::size_t>(width * height);
  std::vector<std::uint32_t> next(
      seen.size(), static_cast<std::uint32_t>(width * height - width * height / (apart * apart)));
  std::vector<std::size_t> holes;
  for (std::size_t i = 0; i < ranks.count(); ++i) {
    if (ranks[i] >= next[0]) holes.push_back(i);
  }
  const auto gauss = [](double pixels_a_point, std::int64_t squared) {
    const double t = 2.0 * static_cast<double>(squared) / pixels_a_point;
    return t < 4.5 ? static_cast<int>(256.0 * reproducible_exp(-t)) : 0;
  };
  while (!holes.empty()) {
    const double own = static_cast<double>(ranks.count()) / static_cast<double>(holes.size());
    const double others = most > 0 ? own * most / (all + most) : 1.0;
    const std::size_t half = holes.size() / 2;
    while (holes.size() > half) {
      std::pair<int, std::size_t> tightest{-1, 0};
      for (std::size_t i = 0; i < holes.size(); ++i) {
        int energy = 0;
        for (const std::size_t other : holes) {
          const int slice = static_cast<int>(holes[i] / area), to = static_cast<int>(other / area);
          const std::int64_t squared = squared_distance({width, height}, holes[i] % area, other % area);
          const int dz = wrap(to % z - slice % z, z), dw = wrap(to / z - slice / z, w);
          energy += seen[static_cast<std::size_t>(dw * z + dz)] * gauss(to == slice ? own : others, squared);
        }
        if (energy > tightest.first) tightest = {energy, i};
      }
      const std::size_t hole = holes[tightest.second];
      ranks[hole] = next[hole / area]++;
      holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(tightest.second));
    }
  }
}

/// For volumes of several slices.
inline Grid<std::uint32_t> reference_volume_mask(const VolumeMaskOptions& options) {
  const noise::VolumeWeights weights(options.size, options.kernel);
  PlainVolume volume(weights, options.seed);
  std::vector<std::uint32_t> order;
  const TorusSides half{std::max(options.size.x / 2, 1), std::max(options.size.y / 2, 1), options.size.z,
                        options.size.w};
  for (const std::size_t voxel : reference_first_voxels(weights, options.kernel, options.seed))
    order.push_back(static_cast<std::uint32_t>(volume.set_of_half(half, voxel)));
  std::vector<bool> is_first(volume.when_set.size());
  for (const std::uint32_t voxel : order) is_first[voxel] = true;
  const std::size_t first = order.size();
  for (std::size_t i = first; i < volume.when_set.size(); ++i) volume.set_largest_void();
  // Of voxels set at equal energies, random bits decide, as many as are left of 30, but 16 at most.
  const int bits = std::min(
      16, 30 - static_cast<int>(std::bit_width(
                   static_cast<std::uint64_t>(weights.sum() + noise::kVolumeStartLimit) + first + 1)));
  const auto key = [&](std::uint64_t i) {
    const std::uint64_t random = random_bits(options.seed, 3, i / 4) >> (16 * (i % 4)) & ((1u << bits) - 1);
    return std::pair(volume.when_set[i], random);
  };
  for (std::uint32_t i = 0; i < is_first.size(); ++i) {
    if (!is_first[i]) order.push_back(i);
  }
  std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

  const auto [width, height, z, w] = options.size;
  Grid<std::uint32_t> ranks({width, height, z * w});
  const std::size_t in_slice = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint32_t> next(options.ranks == RankScope::slice ? static_cast<std::size_t>(z * w) : 1);
  for (const std::uint32_t voxel : order) {
    ranks[voxel] = next[options.ranks == RankScope::slice ? voxel / in_slice : 0]++;
  }
  if (options.ranks == RankScope::slice) reference_last_voxels(ranks, weights, options.kernel);
  return ranks;
}

}  // namespace bn
