// The retarget problem as a sparse linear assignment problem: rows are seeds, columns are the pixels they
// land on, both in the coordinates of problem.h, and row q may take the columns q + k of its window, at
// cost(A(q), B(q + k)).

#pragma once

#include <cstdint>
#include <vector>

#include "retarget/problem.h"

namespace bn {

struct AssignmentProblem {
  Grid<std::int32_t> row_level;     ///< A(q) = D(q - d)
  Grid<std::int32_t> column_level;  ///< B(w) = D(w + m)
  std::vector<ReachRow> window;
  Metric metric = Metric::l1;
  bool wrap = true;

  AssignmentProblem(const Grid<std::int32_t>& levels, const RetargetOptions& options)
      : row_level(shifted(levels, -std::int64_t{options.step.x}, -std::int64_t{options.step.y})),
        column_level(shifted(levels, options.motion.x, options.motion.y)),
        window(reach_rows(levels.size(), options)),
        metric(options.metric),
        wrap(options.wrap) {}
};

inline constexpr std::int32_t kUnassigned = -1;

/// Rows to columns with column prices: the state that solvers hand on to each other.
struct Assignment {
  std::vector<std::int32_t> column_of;  ///< per row, or kUnassigned
  std::vector<std::int64_t> price;      ///< per column
};

/// Calls visit(column, k) for each column in row u's window, by rising k.y, then k.x.
template <class Visit>
void for_each_column(const AssignmentProblem& problem, int x, int y, Visit&& visit) {
  const auto [width, height] = problem.row_level.size();
  for (const ReachRow& reach : problem.window) {
    int to_y = y + reach.y;
    if (to_y < 0 || to_y >= height) {
      if (!problem.wrap) continue;
      to_y += to_y < 0 ? height : -height;
    }
    for (int k_x = reach.x_low; k_x <= reach.x_high; ++k_x) {
      int to_x = x + k_x;
      if (to_x < 0 || to_x >= width) {
        if (!problem.wrap) continue;
        to_x += to_x < 0 ? width : -width;
      }
      visit(to_y * width + to_x, Offset{k_x, reach.y});
    }
  }
}

/// Frees every row whose column is not its cheapest at the given prices, then completes the assignment by
/// shortest augmenting paths. On return it is perfect and optimal, and its prices prove it.
void complete_by_shortest_paths(const AssignmentProblem& problem, Assignment& state, const Execution& execution);

/// The bound that prices prove, by weak duality: every perfect assignment costs at least
///     sum over rows of min over columns of (cost + price) - sum over columns of price.
/// Trusts nothing but `price`.
std::int64_t certified_lower_bound(const AssignmentProblem& problem, const std::vector<std::int64_t>& price);

}  // namespace bn
