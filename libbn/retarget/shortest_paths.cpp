#include <limits>
#include <queue>

#include "retarget/assignment.h"

namespace bn {
namespace {

constexpr std::int64_t kInfinite = std::numeric_limits<std::int64_t>::max();

}  // namespace

void complete_by_shortest_paths(const AssignmentProblem& problem, Assignment& state, const Execution& execution) {
  const int width = problem.row_level.width();
  const auto count = static_cast<std::int32_t>(problem.row_level.count());
  auto& price = state.price;
  const auto cost = [&](std::int32_t row, std::int32_t column) {
    return level_cost(problem.row_level[row], problem.column_level[column], problem.metric);
  };
  const auto cheapest = [&](std::int32_t row) {
    std::int64_t least = kInfinite;
    for_each_column(problem, row % width, row / width,
                    [&](std::int32_t column, Offset) { least = std::min(least, cost(row, column) + price[column]); });
    return least;
  };

  std::vector<std::int32_t> row_of(count, kUnassigned);
  for (std::int32_t row = 0; row < count; ++row) {
    auto& column = state.column_of[row];
    if (column == kUnassigned) continue;
    if (cost(row, column) + price[column] == cheapest(row)) {
      row_of[column] = row;
    } else {
      column = kUnassigned;
    }
  }

  std::vector<std::int64_t> distance(count, kInfinite);
  std::vector<std::int32_t> parent(count);  // of a column: the row it was reached from
  std::vector<std::int32_t> touched, settled;
  using Entry = std::pair<std::int64_t, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::int32_t root = 0; root < count; ++root) {
    if (state.column_of[root] != kUnassigned) continue;
    throw_if_stopped(execution);
    std::int32_t row = root;
    std::int64_t base = 0, row_price = cheapest(root);
    std::int32_t end = kUnassigned;
    for (;;) {
      for_each_column(problem, row % width, row / width, [&](std::int32_t column, Offset) {
        const std::int64_t reached = base + cost(row, column) + price[column] - row_price;
        if (reached >= distance[column]) return;
        if (distance[column] == kInfinite) touched.push_back(column);
        distance[column] = reached;
        parent[column] = row;
        queue.push({reached, column});
      });
      while (queue.top().first != distance[queue.top().second]) queue.pop();
      const auto [next, column] = queue.top();
      queue.pop();
      base = next;
      if (row_of[column] == kUnassigned) {
        end = column;
        break;
      }
      settled.push_back(column);
      row = row_of[column];
      row_price = cost(row, column) + price[column];
    }
    for (const std::int32_t column : settled) price[column] += base - distance[column];
    for (std::int32_t column = end;;) {
      const std::int32_t owner = parent[column];
      row_of[column] = owner;
      std::swap(column, state.column_of[owner]);
      if (owner == root) break;
    }
    for (const std::int32_t column : touched) distance[column] = kInfinite;
    touched.clear();
    settled.clear();
    queue = {};
  }
}

std::int64_t certified_lower_bound(const AssignmentProblem& problem, const std::vector<std::int64_t>& price) {
  const auto [width, height] = problem.row_level.size();
  // Sums of prices may pass 64 bits on the way; the bound itself does not.
  __extension__ __int128 bound = 0;
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x < width; ++x) {
      std::int64_t least = kInfinite;
      const std::int32_t level = problem.row_level(x, y);
      for_each_column(problem, x, y, [&](std::int32_t column, Offset) {
        least = std::min(least, level_cost(level, problem.column_level[column], problem.metric) + price[column]);
      });
      bound += least;
    }
  }
  for (const std::int64_t p : price) bound -= p;
  return static_cast<std::int64_t>(bound);
}

}  // namespace bn
