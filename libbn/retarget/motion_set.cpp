// The motion variants are problems of their own, solved side by side, one on each thread: the result cannot
// depend on how many there are.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "core/progress.h"
#include "retarget/problem.h"

namespace bn {
using namespace retarget;

std::vector<RetargetTile> solve_motion_set(const MaskLevels& levels, const RetargetOptions& options,
                                           int range, const Execution& execution) {
  constexpr int kMaxRange = 8;
  if (range < 0 || range > kMaxRange) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("motion range {}", range),
                 .where = "range",
                 .limit = fmt::format("0..{}", kMaxRange),
                 .remedy = ""});
  }
  RetargetOptions extreme = options;
  extreme.motion = {range, range};
  check_options(extreme);
  check_levels(levels, options.metric);

  const int side = 2 * range + 1;
  const std::int64_t count = std::int64_t{side} * side;
  const auto at_once = static_cast<std::uint64_t>(std::min<std::int64_t>(thread_count(execution), count));
  check_memory(execution,
               at_once * exact_memory_bytes(levels.size(), options) +
                   static_cast<std::uint64_t>(count) * levels.from.count() * sizeof(Offset),
               "motion set");
  std::vector<RetargetTile> tiles(static_cast<std::size_t>(count));
  ProgressMeter progress(execution, static_cast<std::uint64_t>(count));
  parallel_for(execution, count, [&](std::int64_t i) {
    RetargetOptions variant = options;
    variant.motion = {static_cast<int>(i % side) - range, static_cast<int>(i / side) - range};
    Execution single = execution;
    single.threads = 1;
    single.progress = {};
    tiles[static_cast<std::size_t>(i)] = solve_retarget(levels, variant, single);
    progress.advance(1);
  });
  progress.finish();
  return tiles;
}

}  // namespace bn
