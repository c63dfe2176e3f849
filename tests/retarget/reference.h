// Plain references for the retarget room's tests: every permutation of a tiny torus, and the Hungarian
// method on the full cost matrix. Both work from the header's definition alone.

#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "bn/random.h"
#include "bn/retarget.h"

namespace bn {

inline constexpr std::int64_t kForbidden = std::numeric_limits<std::int64_t>::max() / 4096;

inline Grid<std::int32_t> random_levels(Extent size, std::uint64_t seed, std::int32_t bound) {
  Grid<std::int32_t> levels(size);
  for (std::size_t i = 0; i < levels.count(); ++i) {
    levels[i] = static_cast<std::int32_t>(
        random_below(static_cast<std::uint32_t>(random_bits(seed, 1, i)), static_cast<std::uint32_t>(bound)));
  }
  return levels;
}

/// matrix[u][v]: the cost of u -> v, or kForbidden where no allowed offset leads there.
inline std::vector<std::vector<std::int64_t>> cost_matrix(const MaskLevels& levels,
                                                          const RetargetOptions& options) {
  const int width = levels.size().width, height = levels.size().height, r = options.radius;
  const std::size_t count = levels.from.count();
  std::vector matrix(count, std::vector<std::int64_t>(count, kForbidden));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k_y = -r; k_y <= r; ++k_y) {
        for (int k_x = -r; k_x <= r; ++k_x) {
          if (options.reach == Reach::euclidean && k_x * k_x + k_y * k_y > r * r) continue;
          const int to_x = wrap(x + options.step.x, width) + k_x,
                    to_y = wrap(y + options.step.y, height) + k_y;
          const bool inside = to_x >= 0 && to_x < width && to_y >= 0 && to_y < height;
          if (!options.wrap && !inside) continue;
          const int v_x = wrap(x + k_x + options.motion.x, width),
                    v_y = wrap(y + k_y + options.motion.y, height);
          const std::int64_t difference =
              std::int64_t{levels.from(x, y)} - levels.to.torus(v_x + options.step.x, v_y + options.step.y);
          matrix[static_cast<std::size_t>(y * width + x)][static_cast<std::size_t>(v_y * width + v_x)] =
              options.metric == Metric::l2 ? difference * difference : std::abs(difference);
        }
      }
    }
  }
  return matrix;
}

/// The least energy over all permutations, by trying them.
inline std::int64_t enumerate_optimum(const std::vector<std::vector<std::int64_t>>& matrix) {
  std::vector<std::size_t> to(matrix.size());
  std::iota(to.begin(), to.end(), 0u);
  std::int64_t best = kForbidden;
  do {
    std::int64_t energy = 0;
    for (std::size_t u = 0; u < to.size() && energy < kForbidden; ++u) energy += matrix[u][to[u]];
    best = std::min(best, energy);
  } while (std::next_permutation(to.begin(), to.end()));
  return best;
}

/// The least energy by the Hungarian method with potentials, O(n^3) (Kuhn 1955; Jonker & Volgenant 1987).
inline std::int64_t hungarian_optimum(const std::vector<std::vector<std::int64_t>>& matrix) {
  const std::size_t n = matrix.size();
  std::vector<std::int64_t> row_potential(n + 1), column_potential(n + 1);
  std::vector<std::size_t> row_of(n + 1, 0), previous(n + 1);
  for (std::size_t row = 1; row <= n; ++row) {
    std::vector<std::int64_t> slack(n + 1, std::numeric_limits<std::int64_t>::max());
    std::vector<bool> in_tree(n + 1, false);
    std::size_t column = 0;
    row_of[0] = row;
    do {
      in_tree[column] = true;
      const std::size_t from = row_of[column];
      std::int64_t step = std::numeric_limits<std::int64_t>::max();
      std::size_t next = 0;
      for (std::size_t j = 1; j <= n; ++j) {
        if (in_tree[j]) continue;
        const std::int64_t reduced = matrix[from - 1][j - 1] - row_potential[from] - column_potential[j];
        if (reduced < slack[j]) {
          slack[j] = reduced;
          previous[j] = column;
        }
        if (slack[j] < step) {
          step = slack[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= n; ++j) {
        if (in_tree[j]) {
          row_potential[row_of[j]] += step;
          column_potential[j] -= step;
        } else {
          slack[j] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    while (column != 0) {
      row_of[column] = row_of[previous[column]];
      column = previous[column];
    }
  }
  std::int64_t energy = 0;
  for (std::size_t j = 1; j <= n; ++j) energy += matrix[row_of[j] - 1][j - 1];
  return energy;
}

}  // namespace bn
