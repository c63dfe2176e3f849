// An annealing problem, checked and brought into the coordinates that both engines work in.
//
// Position w of the landing tile holds the seed whose origin is q = w - k, k within reach (problem.h has the
// coordinates). The seed's levels are A_c(q), those of its position B_c(w). A swap of the seeds at p and p +
// s adds s to one displacement and takes it from the other.

#pragma once

#include <cstdint>
#include <vector>

#include "bn/anneal.h"
#include "retarget/problem.h"

namespace bn {

/// Room that both engines keep for sums: no swap changes the energy by more than this, no energy exceeds it.
inline constexpr std::int64_t kMaxAnnealEnergy = std::int64_t{1} << 62;

struct AnnealInstance {
  Extent size;
  RetargetOptions options;
  std::vector<Grid<std::int32_t>> seed_level;     ///< A_c, the channel's least level taken off
  std::vector<Grid<std::int32_t>> landing_level;  ///< B_c, likewise
  std::vector<std::int64_t> weight;
  double residual_sigma_px = 0.0;
  std::int64_t largest_change = 0;    ///< of the energy by one swap, where the energy is a sum over pixels
  std::vector<Offset> displacements;  ///< s of a swap, half of the plane: x > 0, or x = 0 and y > 0

  /// Throws invalid_input or over_limit. `swap_distance_px` limits s per axis; 0 means the default.
  AnnealInstance(const AnnealProblem& problem, int swap_distance_px);

  /// Moves R(u) from displacements k at positions w, and back.
  Grid<Offset> moves_of(const Grid<Offset>& displacement_at) const;
  Grid<Offset> displacements_of(const Grid<Offset>& move) const;
};

}  // namespace bn
