// The energy of a retarget tile from its definition, E = sum over u of cost(D(u), T(u + R(u) + d)), in
// 64-bit integers. Every figure that leaves this room comes from here, not from a solver's running sum.

#include <fmt/format.h>

#include "bn/error.h"
#include "retarget/problem.h"

namespace bn {
using namespace retarget;

std::int64_t retarget_energy(const MaskLevels& levels, const Grid<Offset>& move,
                             const RetargetOptions& options) {
  check_options(options);
  check_levels(levels, options.metric);
  if (move.size() != levels.size()) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("a tile of {}x{} for levels of {}x{}", move.width(), move.height(),
                                     levels.size().width, levels.size().height),
                 .where = "move",
                 .limit = "both of one size",
                 .remedy = ""});
  }
  std::int64_t energy = 0;
  for (int y = 0; y < move.height(); ++y) {
    for (int x = 0; x < move.width(); ++x) {
      const Offset r = move(x, y);
      const std::int32_t landing =
          levels.to.torus(std::int64_t{x} + r.x + options.step.x, std::int64_t{y} + r.y + options.step.y);
      energy += level_cost(levels.from(x, y), landing, options.metric);
    }
  }
  return energy;
}

}  // namespace bn
