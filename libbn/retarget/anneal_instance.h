// An annealing problem, checked and brought into the coordinates that both engines work in.
//
// Position w of the landing tile holds the seed whose origin is q = w - k, k within reach (problem.h has the
// coordinates). The seed's levels are A_c(q), those of its position B_c(w). A swap of the seeds at p and p +
// s adds s to one displacement and takes it from the other.
//
// A volume's slices are stacked: row z * slice.height + y of every grid is row y of slice z. A flat tile is
// one slice, and all that concerns z is 0 there.

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bn/retarget_anneal.h"
#include "retarget/problem.h"

namespace bn::retarget {

/// Room that both engines keep for sums: no swap changes the energy by more than this, no energy exceeds it.
inline constexpr std::int64_t kMaxAnnealEnergy = std::int64_t{1} << 62;

/// A difference of positions, z counting slices.
struct Shift {
  int x = 0;
  int y = 0;
  int z = 0;
  friend bool operator==(const Shift&, const Shift&) = default;
};

/// A displacement for each position, or a move for each seed.
struct Placement {
  Grid<Offset> xy;
  Grid<std::int8_t> z;  ///< of a volume; else empty

  Placement() = default;
  Placement(Grid<Offset> flat, Grid<std::int8_t> deep = {}) : xy(std::move(flat)), z(std::move(deep)) {}
  Shift at(std::size_t i) const { return {xy[i].x, xy[i].y, z.count() == 0 ? 0 : z[i]}; }
  void set(std::size_t i, Shift k) {
    xy[i] = {k.x, k.y};
    if (z.count() != 0) z[i] = static_cast<std::int8_t>(k.z);
  }
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// Whether the displacement k is allowed by radius and reach (the border aside).
constexpr bool within_reach(Shift k, const RetargetOptions& options) {
  const std::int64_t z = k.z, r = options.radius;
  if (options.reach != Reach::euclidean) return z <= r && z >= -r && within_reach(Offset{k.x, k.y}, options);
  return std::int64_t{k.x} * k.x + std::int64_t{k.y} * k.y + z * z <= r * r;
}

struct AnnealInstance {
  Extent size;   ///< of the whole stack
  Extent slice;  ///< of one slice
  int depth = 1;
  int step_z = 0;
  RetargetOptions options;
  std::vector<Grid<std::int32_t>> seed_level;     ///< A_c, the channel's least level taken off
  std::vector<Grid<std::int32_t>> landing_level;  ///< B_c, likewise
  std::vector<std::int64_t> weight;
  double residual_sigma_px = 0.0;
  std::int64_t largest_change = 0;  ///< of the energy by one swap, where the energy is a sum over pixels
  std::vector<Shift>
      displacements;  ///< s of a swap, half of space: the first of x, y, z that is not 0 is above it

  /// Throws invalid_input or over_limit. `swap_distance_px` limits s per axis; 0 means the default.
  AnnealInstance(const AnnealProblem& problem, int swap_distance_px);

  /// The identity k = 0.
  Placement identity() const;
  /// Index of the position (x, y, z) taken modulo the slice and the depth.
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (static_cast<std::size_t>(wrap(z, depth)) * static_cast<std::size_t>(slice.height) +
            static_cast<std::size_t>(wrap(y, slice.height))) *
               static_cast<std::size_t>(slice.width) +
           static_cast<std::size_t>(wrap(x, slice.width));
  }
  Shift position(std::size_t index) const {
    const auto row = static_cast<int>(index / static_cast<std::size_t>(slice.width));
    return {static_cast<int>(index % static_cast<std::size_t>(slice.width)), row % slice.height,
            row / slice.height};
  }

  /// Moves R(u) from displacements k at positions w, and back.
  Placement moves_of(const Placement& displacement_at) const;
  Placement displacements_of(const Placement& move) const;
  /// Throws verification_failed unless `move` is a bijection within reach.
  void check_moves(const Placement& move) const;
};

}  // namespace bn::retarget
