// A retarget tile in the way of the published annealers: random swaps of two seeds' destinations within
// reach.
//
// Greedy: a swap is taken unless it raises the energy. That is the end of any cooling schedule, and stopped
// at an energy it gives a tile with the published figure, to compare proven tiles with. bn/retarget_anneal.h
// has the annealer to use; this one is short.

#include <fmt/format.h>

#include <cstdlib>

#include "bn/error.h"
#include "bn/random.h"
#include "bn/retarget.h"
#include "bn_study/models.h"

namespace bn {

Grid<Offset> swapped_tile(const Grid<std::int32_t>& levels, Offset step, int radius, std::int64_t energy,
                          std::uint64_t seed) {
  constexpr std::uint32_t kSwapStream = 0x52540006u;
  constexpr std::uint64_t kMostProposals = 100'000'000;
  const Extent size = levels.size();
  Grid<Offset> move(size);
  std::int64_t now = retarget_energy(levels, move, {.step = step, .radius = radius});
  const auto cost = [&](int x, int y, Offset by) {
    return std::abs(levels(x, y) - levels.torus(x + by.x + step.x, y + by.y + step.y));
  };
  const auto reachable = [&](Offset by) { return std::abs(by.x) <= radius && std::abs(by.y) <= radius; };
  const auto side = static_cast<std::uint32_t>(4 * radius + 1);  // two seeds may meet half way
  for (std::uint64_t k = 0; now > energy; ++k) {
    if (k == kMostProposals) {
      throw Error({.code = ErrorCode::over_limit,
                   .what = fmt::format("energy {} after {} swaps", now, k),
                   .where = "swapped_tile",
                   .limit = fmt::format("{}", energy),
                   .remedy = "ask for a higher energy"});
    }
    const auto bits =
        philox({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k >> 32), kSwapStream, 0},
               {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
    const int x = static_cast<int>(random_below(bits[0], static_cast<std::uint32_t>(size.width)));
    const int y = static_cast<int>(random_below(bits[1], static_cast<std::uint32_t>(size.height)));
    const int dx = static_cast<int>(random_below(bits[2], side)) - 2 * radius;
    const int dy = static_cast<int>(random_below(bits[3], side)) - 2 * radius;
    const int u = wrap(x + dx, size.width), v = wrap(y + dy, size.height);
    // p takes q's destination and q takes p's.
    const Offset of_p{dx + move(u, v).x, dy + move(u, v).y};
    const Offset of_q{move(x, y).x - dx, move(x, y).y - dy};
    if (!reachable(of_p) || !reachable(of_q)) continue;
    const int change = cost(x, y, of_p) + cost(u, v, of_q) - cost(x, y, move(x, y)) - cost(u, v, move(u, v));
    if (change > 0) continue;
    move(x, y) = of_p;
    move(u, v) = of_q;
    now += change;
  }
  return move;
}

}  // namespace bn
