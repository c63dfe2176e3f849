// What every solver of this room starts from: checked options, the cost of a pixel pair, and the
// window of displacements a seed may take.

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bn/retarget.h"

namespace bn::retarget {

/// Cost of a seed that sat on level a and lands on level b. Levels are 0..2^24-1, so L2 stays below 2^48.
constexpr std::int64_t level_cost(std::int32_t a, std::int32_t b, Metric metric) {
  const std::int64_t difference = std::int64_t{a} - b;
  if (metric == Metric::l2) return difference * difference;
  return difference < 0 ? -difference : difference;
}

/// Whether the displacement k = R - m is allowed by radius and reach (the border aside).
constexpr bool within_reach(Offset k, const RetargetOptions& options) {
  const std::int64_t x = k.x, y = k.y, r = options.radius;
  if (options.reach == Reach::euclidean) return x * x + y * y <= r * r;
  return x <= r && x >= -r && y <= r && y >= -r;
}

/// Throws invalid_input, naming the option and its range, unless all of them are in range.
void check_options(const RetargetOptions& options);

/// Throws invalid_input unless the grids have pixels, are of one size and each level is 0..2^24-1; over_limit
/// if an energy could exceed 2^62. Returns the largest cost that a pair of pixels can have.
std::int64_t check_levels(const MaskLevels& levels, Metric metric);

/// The least and the greatest level of both grids.
std::pair<std::int32_t, std::int32_t> level_range(const MaskLevels& levels);

/// Memory of the exact solver for one tile: 64 bytes for each pixel of the tile and of a border of `radius`
/// around it (but no wider than the tile reaches around itself).
std::uint64_t exact_memory_bytes(Extent size, const RetargetOptions& options);

/// The displacements (k.x, y) with x_low <= k.x <= x_high.
struct ReachRow {
  int y;
  int x_low;
  int x_high;
};

/// All displacements k = R - m that a seed of a torus of this size may take, by rising y. With wrap each
/// column of the torus occurs at most once, by its nearest representative (of two equally near the
/// lower one); without wrap the border cuts the window further, pixel by pixel.
std::vector<ReachRow> reach_rows(Extent size, const RetargetOptions& options);

/// The levels seen from an offset: result(q) = levels(q + offset), on the torus.
///
/// Solvers work in the coordinates of the tile that seeds land in, q = u + d, where the border of a tile
/// without wrap lies: the seed at u = q - d, of level A(q) = D(q - d), that moves by R(u) = k + m pays
/// cost(A(q), B(q + k)) with B(w) = T(w + m). So A = shifted(D, -d) and B = shifted(T, m).
Grid<std::int32_t> shifted(const Grid<std::int32_t>& levels, std::int64_t x, std::int64_t y);

}  // namespace bn::retarget
