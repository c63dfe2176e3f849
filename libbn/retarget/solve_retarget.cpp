#include "core/progress.h"
#include "retarget/assignment.h"

namespace bn {
namespace {

/// The moves an assignment stands for, back in the coordinates of seeds, u = q - d.
Grid<Offset> moves_of(const AssignmentProblem& problem, const std::vector<std::int32_t>& column_of,
                      const RetargetOptions& options) {
  Grid<Offset> move(problem.row_level.size());
  for (int y = 0; y < move.height(); ++y) {
    for (int x = 0; x < move.width(); ++x) {
      const int q_x = wrap(std::int64_t{x} + options.step.x, move.width());
      const int q_y = wrap(std::int64_t{y} + options.step.y, move.height());
      const std::int32_t mine = column_of[static_cast<std::size_t>(q_y) * move.width() + q_x];
      Offset k{mine % move.width() - q_x, mine / move.width() - q_y};
      if (problem.wrap) k = {wrap_centred(k.x, move.width()), wrap_centred(k.y, move.height())};
      move(x, y) = {k.x + options.motion.x, k.y + options.motion.y};
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
  tile.move = moves_of(problem, state.column_of, options);
  check_permutation(tile.move, options);
  tile.start_energy = retarget_energy(levels, Grid<Offset>(levels.size(), options.motion), options);
  tile.energy = retarget_energy(levels, tile.move, options);
  tile.lower_bound = certified_lower_bound(problem, state.price);
  ProgressMeter(execution, 1).finish();
  return tile;
}

}  // namespace bn
