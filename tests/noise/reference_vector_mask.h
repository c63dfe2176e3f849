// Vector masks written down as plainly as they can be: the specification that the fast path must equal. An
// exchange is judged by two energies computed from scratch.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "bn/vector_mask.h"
#include "noise/vector_swaps.h"

namespace bn {

inline std::vector<noise::Voxel> all_voxels(Shape size) {
  std::vector<noise::Voxel> voxels;
  for (int z = 0; z < size.depth; ++z) {
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) voxels.push_back({x, y, z});
    }
  }
  return voxels;
}

/// How unlike two values are.
inline std::int64_t reference_unlikeness(const VectorMaskOptions& options, const noise::ScaledVector& a,
                                         const noise::ScaledVector& b) {
  const std::int32_t d = noise::distance(a, b, vector_components(options.values));
  if (options.energy == VectorEnergy::half_spaces) return d;
  const double dimensions = options.values == VectorValues::circle ? 1
                            : options.values == VectorValues::vec3 ? 3
                            : options.values == VectorValues::vec4 ? 4
                                                                   : 2;
  return std::lround(16384.0 * (1.0 - std::exp(-std::pow(d / 8192.0, dimensions / 2.0))));
}

/// Of the places of a mask: minus the sum over pairs of weight times unlikeness.
inline std::int64_t reference_energy(const VectorMaskOptions& options, const Grid<std::uint32_t>& places,
                                     const noise::VectorKernel& kernel) {
  const std::vector<noise::Voxel> voxels = all_voxels(places.shape());
  std::vector<noise::ScaledVector> value;
  for (const std::uint32_t place : places) value.push_back(noise::scaled_value(options.values, place));
  std::int64_t energy = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    for (std::size_t j = i + 1; j < voxels.size(); ++j) {
      const auto [ax, ay, az] = voxels[i];
      const auto [bx, by, bz] = voxels[j];
      energy -= std::int64_t{kernel.weight(bx - ax, by - ay, bz - az)} *
                reference_unlikeness(options, value[i], value[j]);
    }
  }
  return energy;
}

/// The part of it that two voxels have.
inline std::int64_t reference_energy_of(const VectorMaskOptions& options, const Grid<std::uint32_t>& places,
                                        const noise::VectorKernel& kernel, noise::Voxel a, noise::Voxel b) {
  const auto value = [&](noise::Voxel v) {
    return noise::scaled_value(options.values, places(v.x, v.y, v.z));
  };
  const auto is = [](noise::Voxel v, noise::Voxel w) { return v.x == w.x && v.y == w.y && v.z == w.z; };
  const auto pair = [&](noise::Voxel v, noise::Voxel w) {
    const std::int64_t weight = kernel.weight(w.x - v.x, w.y - v.y, w.z - v.z);
    return weight == 0 ? 0 : -weight * reference_unlikeness(options, value(v), value(w));
  };
  std::int64_t energy = 0;
  for (const noise::Voxel v : all_voxels(places.shape())) {
    if (!is(v, a)) energy += pair(v, a);
    if (!is(v, a) && !is(v, b)) energy += pair(v, b);
  }
  return energy;
}

/// What a voxel sees of each 256th of the curve.
inline std::vector<std::int64_t> reference_seen(const Grid<std::uint32_t>& places,
                                                const noise::VectorKernel& kernel, noise::Voxel at) {
  int shift = 0;
  while (kernel.sum() >> shift > 1 << 14) ++shift;
  std::vector<std::int64_t> seen(256);
  const std::vector<noise::Voxel> voxels = all_voxels(places.shape());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    seen[places[i] >> 24] += kernel.weight(voxels[i].x - at.x, voxels[i].y - at.y, voxels[i].z - at.z);
  }
  for (std::int64_t& sum : seen) sum >>= shift;
  return seen;
}

/// How far the value at a place is from each 256th of the curve.
inline std::vector<std::int64_t> reference_distances(const VectorMaskOptions& options, std::uint32_t place) {
  const noise::ScaledVector value = noise::scaled_value(options.values, place);
  std::vector<std::int64_t> distances;
  for (std::uint32_t cell = 0; cell < 256; ++cell) {
    const noise::ScaledVector middle = noise::scaled_value(options.values, (cell << 24) + (1u << 23));
    distances.push_back(reference_unlikeness(options, middle, value) / 16);
  }
  return distances;
}

/// One round: voxels in order take the free partner with whom they gain most by the estimate; pairs in order
/// exchange if the energy falls.
inline void reference_round(const VectorMaskOptions& options, Grid<std::uint32_t>& places,
                            const noise::VectorKernel& kernel, const noise::SwapRounds& rounds,
                            std::int64_t round) {
  const std::vector<noise::Voxel> all = rounds.voxels(round);
  std::vector<std::pair<noise::Voxel, noise::Voxel>> pairs;
  for (int group = 0; group < rounds.groups(); ++group) {
    const std::vector<noise::Voxel> voxels(all.begin() + rounds.first(group),
                                           all.begin() + rounds.first(group + 1));
    std::vector<std::vector<std::int64_t>> seen, distances;
    for (const noise::Voxel v : voxels) {
      seen.push_back(reference_seen(places, kernel, v));
      distances.push_back(reference_distances(options, places(v.x, v.y, v.z)));
    }
    const auto far = [&](std::size_t i, std::size_t j) {
      return std::inner_product(seen[i].begin(), seen[i].end(), distances[j].begin(), std::int64_t{0});
    };
    std::vector<bool> is_free(voxels.size(), true);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      if (!is_free[i]) continue;
      std::int64_t most = 0;
      std::size_t best = i;
      for (std::size_t j = 0; j < voxels.size(); ++j) {
        if (!is_free[j]) continue;
        const std::int64_t both = far(i, j) - far(i, i) + far(j, i) - far(j, j);
        if (both > most) most = both, best = j;
      }
      is_free[i] = is_free[best] = false;
      if (best != i) pairs.emplace_back(voxels[i], voxels[best]);
    }
  }
  // By the lower index of each pair, as they were formed.
  for (const auto& [a, b] : pairs) {
    const std::int64_t before = reference_energy_of(options, places, kernel, a, b);
    std::swap(places(a.x, a.y, a.z), places(b.x, b.y, b.z));
    if (reference_energy_of(options, places, kernel, a, b) >= before) {
      std::swap(places(a.x, a.y, a.z), places(b.x, b.y, b.z));
    }
  }
}

inline Grid<std::uint32_t> reference_vector_mask(const VectorMaskOptions& options) {
  Grid<std::uint32_t> places = curve_mask(options);
  const Shape size = places.shape();
  const noise::VectorKernel kernel(
      noise::VolumeWeights({size.width, size.height, size.depth, 1}, spatiotemporal_kernel(options.mask)));
  const noise::SwapRounds rounds(kernel, size, options.mask.ranks, options.mask.seed);
  if (rounds.count() < 2) return places;
  for (std::int64_t round = 0; round * rounds.count() < options.budget * size.count(); ++round) {
    reference_round(options, places, kernel, rounds, round);
  }
  return places;
}

}  // namespace bn
