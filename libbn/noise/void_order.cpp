// Which tile is filled when: a matter of speed alone, as fill_tile.h says.
//
// A sweep visits tiles that cover the torus, each small enough for the second-level cache, row by row
// and from left to right: a tile moves to the left and up while it is filled, so its neighbours there
// should have gone ahead. Tiles whose visits are out of each other's reach form a wave and are filled by
// threads at once; a wave begins when the one before has ended. In a row every second tile of the row
// below is in the same wave, and where there are many rows they are cut into chains that advance side
// by side.

#include "noise/void_order.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "noise/fill_tile.h"
#include "noise/rank_order.h"

namespace bn {
namespace {

// 56x56 blocks are 784 KiB of energies. More rounds a visit would need fewer visits, but then the tile,
// which moves by a block a round, must be larger for what follows to hold.
constexpr int kTileBlocks = 56;
constexpr int kRounds = 32;
// The visits of two tiles with a third between them are out of reach of each other: what one writes,
// as far as its kernels reach, the other does not read, as far as its kernels reach.
static_assert(kRounds - 1 + 2 * (1 + kMaxKernelRadius / kBlockSide) <= kTileBlocks);

constexpr int kRowsOfChain = 4;

using Wave = std::vector<BlockRect>;

/// The waves of one sweep.
std::vector<Wave> waves_of_sweep(const EnergyField& field) {
  const int columns = std::max(1, field.blocks_x / kTileBlocks);
  const int rows = std::max(1, field.blocks_y / kTileBlocks);
  const int chains = std::max(1, rows / kRowsOfChain);
  const auto first = [](int i, int parts, int whole) {
    return static_cast<int>(std::int64_t{whole} * i / parts);
  };
  constexpr int kNone = -1;
  std::vector<int> wave_of(static_cast<std::size_t>(columns * rows), kNone);
  const auto wave_at = [&](int x, int y) -> int& {
    return wave_of[static_cast<std::size_t>(wrap(y, rows) * columns + wrap(x, columns))];
  };
  std::vector<Wave> waves;
  for (int step = 0; step < rows; ++step) {
    for (int chain = 0; chain < chains; ++chain) {
      const int y = first(chain, chains, rows) + step;
      if (y >= first(chain + 1, chains, rows)) continue;
      for (int x = 0; x < columns; ++x) {
        int wave = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) wave = std::max(wave, wave_at(x + dx, y + dy) + 1);
        }
        wave_at(x, y) = wave;
        if (wave == static_cast<int>(waves.size())) waves.emplace_back();
        const int left = first(x, columns, field.blocks_x);
        const int top = first(y, rows, field.blocks_y);
        waves[static_cast<std::size_t>(wave)].push_back({left, top,
                                                         first(x + 1, columns, field.blocks_x) - left,
                                                         first(y + 1, rows, field.blocks_y) - top});
      }
    }
  }
  return waves;
}

}  // namespace

Grid<std::uint32_t> void_order(EnergyField&& field, const BlockKernel& kernel, std::int64_t count,
                               const Execution& execution, ProgressMeter& meter) {
  Grid<std::uint32_t> order(field.size, kUnranked);
  {
    EnergyField energies = std::move(field);  // freed before the sort takes its memory
    energies.update_minima();
    const std::vector<Wave> waves = waves_of_sweep(energies);
    std::atomic<std::int64_t> set = 0;
    while (set < count) {
      for (const Wave& wave : waves) {
        parallel_for(execution, static_cast<std::int64_t>(wave.size()), [&](std::int64_t i) {
          throw_if_stopped(execution);
          const std::int64_t now =
              fill_tile(energies, kernel, wave[static_cast<std::size_t>(i)], kRounds, order.data());
          set += now;
          meter.advance(static_cast<std::uint64_t>(now));
        });
      }
    }
  }
  replace_by_ranks(order, execution);
  return order;
}

}  // namespace bn
