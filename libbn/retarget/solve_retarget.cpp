#include "core/progress.h"
#include "retarget/assignment.h"

namespace bn {
namespace {

/// The moves an assignment stands for.
Grid<Offset> moves_of(const AssignmentProblem& problem, const std::vector<std::int32_t>& column_of, Offset motion) {
  Grid<Offset> move(problem.row_level.size());
  for (int y = 0; y < move.height(); ++y) {
    for (int x = 0; x < move.width(); ++x) {
      const std::int32_t mine = column_of[static_cast<std::size_t>(y) * move.width() + x];
      const int to_x = mine % move.width(), to_y = mine / move.width();
      const Offset k = problem.wrap ? Offset{wrap_centred(to_x - x, move.width()), wrap_centred(to_y - y, move.height())}
                                    : Offset{to_x - x, to_y - y};
      move(x, y) = {k.x + motion.x, k.y + motion.y};
    }
  }
  return move;
}

}  // namespace

RetargetTile solve_retarget(const Grid<std::int32_t>& levels, const RetargetOptions& options,
                            const Execution& execution) {
  check_options(options);
  check_levels(levels, options.metric);
  thread_count(execution);
  check_memory(execution, levels.count() * 64, "retarget");
  throw_if_stopped(execution);

  const AssignmentProblem problem(levels, options);
  Assignment state{std::vector<std::int32_t>(levels.count(), kUnassigned), std::vector<std::int64_t>(levels.count(), 0)};
  complete_by_shortest_paths(problem, state, execution);

  RetargetTile tile;
  tile.move = moves_of(problem, state.column_of, options.motion);
  check_permutation(tile.move, options);
  tile.start_energy = retarget_energy(levels, Grid<Offset>(levels.size(), options.motion), options);
  tile.energy = retarget_energy(levels, tile.move, options);
  tile.lower_bound = certified_lower_bound(problem, state.price);
  ProgressMeter(execution, 1).finish();
  return tile;
}

}  // namespace bn
