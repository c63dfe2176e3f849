// Which tile is filled when: a matter of speed alone, as fill_tile.h says.
//
// A sweep visits tiles that are small enough for the second-level cache and so far apart that threads
// may work on all of them at once: within each, pixels are set; the moat between them takes the rims of
// the kernels. What lies at the rim of a tile waits for the moat, so every sweep moves the tiles, by
// steps that spread evenly over a tile's side (the two-dimensional golden ratio: M. Roberts, "The
// unreasonable effectiveness of quasirandom sequences", 2018).

#include "noise/void_order.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include "noise/fill_tile.h"
#include "noise/rank_order.h"

namespace bn {
namespace {

// 48x48 blocks are 576 KiB of energies. Rounds beyond these find ever fewer pixels that need not wait.
constexpr int kTileBlocks = 48;
constexpr int kRounds = 32;

struct Span {
  int first;
  int count;
};

/// Spans of blocks around one axis with `moat` blocks between neighbours, moved by a share `shift` of
/// their distance; one span of all blocks where no two fit.
std::vector<Span> spans(int blocks, int moat, double shift) {
  const int count = blocks / (kTileBlocks + moat);
  if (count < 2) return {{0, blocks}};
  const int offset = static_cast<int>(shift * (blocks / count));
  std::vector<Span> result;
  for (int i = 0; i < count; ++i) {
    const int first = blocks * i / count;
    const int next = blocks * (i + 1) / count;
    result.push_back({(first + offset) % blocks, next - first - moat});
  }
  return result;
}

/// The tiles of one sweep. A tile writes as far as its reach, and its neighbour reads as far.
std::vector<BlockRect> tiles_of_sweep(const EnergyField& field, int sweep) {
  constexpr double kPlastic = 1.32471795724474602596;
  const auto share = [&](double step) { return std::fmod(sweep * step, 1.0); };
  std::vector<BlockRect> tiles;
  for (const Span y : spans(field.blocks_y, 2 * field.reach_y, share(1.0 / kPlastic))) {
    for (const Span x : spans(field.blocks_x, 2 * field.reach_x, share(1.0 / (kPlastic * kPlastic)))) {
      tiles.push_back({x.first, y.first, x.count, y.count});
    }
  }
  return tiles;
}

}  // namespace

Grid<std::uint32_t> void_order(EnergyField&& field, const BlockKernel& kernel, std::int64_t count,
                               const Execution& execution, ProgressMeter& meter) {
  Grid<std::uint32_t> order(field.size, kUnranked);
  {
    EnergyField energies = std::move(field);  // freed before the sort takes its memory
    energies.update_minima();
    std::atomic<std::int64_t> set = 0;
    for (int sweep = 0; set < count; ++sweep) {
      const std::vector<BlockRect> tiles = tiles_of_sweep(energies, sweep);
      parallel_for(execution, static_cast<std::int64_t>(tiles.size()), [&](std::int64_t i) {
        throw_if_stopped(execution);
        const std::int64_t now =
            fill_tile(energies, kernel, tiles[static_cast<std::size_t>(i)], kRounds, order.data());
        set += now;
        meter.advance(static_cast<std::uint64_t>(now));
      });
    }
  }
  replace_by_ranks(order, execution);
  return order;
}

}  // namespace bn
