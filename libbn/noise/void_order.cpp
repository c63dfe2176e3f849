// Which tile is filled when: a matter of speed alone, as fill_tile.h says.
//
// A sweep visits tiles that cover the torus, each small enough for the second-level cache, row by row
// and from left to right: a tile moves to the left and up while it is filled, so its neighbours there
// should have gone ahead. Tiles whose visits are out of each other's reach form a wave and are filled by
// threads at once; a wave begins when the one before has ended. Each row of tiles follows two tiles
// behind the row above, and many rows are cut into chains that advance side by side; so are the tiles of
// a long row where there are few rows.

#include "noise/void_order.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "noise/fill_tile.h"
#include "noise/rank_order.h"

namespace bn {
namespace {

// 56x56 blocks are 784 KiB of energies. Fields of fewer than four tiles along an axis are cut into four
// smaller ones, so that some can be filled at once, and small ones are not cut at all.
constexpr int kTileBlocks = 56;
constexpr int kLeastTileBlocks = 32;

int tiles_along(int blocks) {
  constexpr int kFewestTiles = 4;
  if (blocks >= kFewestTiles * kTileBlocks) return blocks / kTileBlocks;
  return blocks >= kFewestTiles * kLeastTileBlocks ? kFewestTiles : 1;
}

/// Rounds of a visit. More of them set more pixels for the memory that is fetched, but every second one
/// moves the tile by a block along an axis, and the visits of two tiles with a third between them must
/// stay out of each other's reach: what one writes, as far as its kernels reach, the other does not
/// read, as far as its kernels reach.
int rounds_of_visit(const EnergyField& field) {
  constexpr int kMostRounds = 76;
  const auto most_moves = [](int blocks, int reach) {
    const int tiles = tiles_along(blocks);
    return tiles == 1 ? kMostRounds : blocks / tiles - 2 * reach;
  };
  return std::min({kMostRounds, 2 * most_moves(field.blocks_x, field.reach_x),
                   2 * most_moves(field.blocks_y, field.reach_y)});
}
// At least a round, whatever the reach.
static_assert(kLeastTileBlocks > 2 * (1 + kMaxKernelRadius / kBlockSide));

using Wave = std::vector<BlockRect>;

/// One axis cut into tiles, and the tiles into chains.
struct Axis {
  Axis(int blocks_, int tiles_, int chains_) : blocks(blocks_), tiles(tiles_), chains(chains_) {}

  int first_block(int tile) const { return static_cast<int>(std::int64_t{blocks} * tile / tiles); }
  int first_tile(int chain) const { return tiles * chain / chains; }
  int longest_chain() const { return (tiles + chains - 1) / chains; }
  /// The tile that a chain has come to, or -1 where it is at its end.
  int tile_at(int chain, int step) const {
    const int tile = first_tile(chain) + step;
    return tile < first_tile(chain + 1) ? tile : -1;
  }

  int blocks;
  int tiles;
  int chains;
};

/// The waves of one sweep: each tile comes after its neighbours on the left and above, and not in one
/// wave with any neighbour on the torus.
std::vector<Wave> waves_of_sweep(const EnergyField& field) {
  constexpr int kTilesOfChain = 4;
  const int columns = tiles_along(field.blocks_x);
  const int rows = tiles_along(field.blocks_y);
  const Axis y(field.blocks_y, rows, std::max(1, rows / kTilesOfChain));
  const Axis x(field.blocks_x, columns, rows < kTilesOfChain ? std::max(1, columns / kTilesOfChain) : 1);

  std::vector<int> wave_of(static_cast<std::size_t>(columns * rows), -1);
  const auto wave_at = [&](int column, int row) -> int& {
    return wave_of[static_cast<std::size_t>(wrap(row, rows) * columns + wrap(column, columns))];
  };
  std::vector<Wave> waves;
  const auto add = [&](int column, int row) {
    const auto any_neighbour = [&](auto&& is_true) {
      for (int y_beside = row - 1; y_beside <= row + 1; ++y_beside) {
        for (int x_beside = column - 1; x_beside <= column + 1; ++x_beside) {
          if (is_true(x_beside, y_beside)) return true;
        }
      }
      return false;
    };
    int wave = 0;
    any_neighbour([&](int x_beside, int y_beside) {
      const bool across_seam = x_beside < 0 || x_beside >= columns || y_beside < 0 || y_beside >= rows;
      if (!across_seam) wave = std::max(wave, wave_at(x_beside, y_beside) + 1);
      return false;
    });
    while (any_neighbour([&](int x_beside, int y_beside) { return wave_at(x_beside, y_beside) == wave; })) {
      ++wave;
    }
    wave_at(column, row) = wave;
    if (wave >= static_cast<int>(waves.size())) waves.resize(static_cast<std::size_t>(wave) + 1);
    const int left = x.first_block(column);
    const int top = y.first_block(row);
    waves[static_cast<std::size_t>(wave)].push_back(
        {left, top, x.first_block(column + 1) - left, y.first_block(row + 1) - top});
  };
  for (int step_y = 0; step_y < y.longest_chain(); ++step_y) {
    for (int chain_y = 0; chain_y < y.chains; ++chain_y) {
      for (int step_x = 0; step_x < x.longest_chain(); ++step_x) {
        for (int chain_x = 0; chain_x < x.chains; ++chain_x) {
          const int column = x.tile_at(chain_x, step_x);
          const int row = y.tile_at(chain_y, step_y);
          if (column >= 0 && row >= 0) add(column, row);
        }
      }
    }
  }
  return waves;
}

}  // namespace

Grid<std::uint32_t> void_order(EnergyField&& field, const BlockKernel& kernel, std::int64_t count,
                               const Execution& execution, ProgressMeter& meter) {
  field.update_minima();
  const std::vector<Wave> waves = waves_of_sweep(field);
  const int rounds = rounds_of_visit(field);
  Grid<std::uint32_t> order(field.size, kUnranked);
  std::atomic<std::int64_t> set = 0;
  while (set < count) {
    for (const Wave& wave : waves) {
      parallel_for(execution, static_cast<std::int64_t>(wave.size()), [&](std::int64_t i) {
        throw_if_stopped(execution);
        const std::int64_t now =
            fill_tile(field, kernel, wave[static_cast<std::size_t>(i)], rounds, order.data());
        set += now;
        meter.advance(static_cast<std::uint64_t>(now));
      });
    }
  }
  replace_by_ranks(order, field.memory(), execution);
  return order;
}

}  // namespace bn
