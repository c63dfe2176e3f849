// Tiles are visited row by row and from left to right: a tile moves to the left and up while it is filled,
// so its neighbours there should have gone ahead, and what the last visit has left in the cache is used by
// the next. A thread that comes for a tile gets the first one in that order that need not wait for a
// neighbour: each row of tiles follows two tiles behind the row above. Where there are too few tiles in a
// row to feed all threads so, the rows are cut into chains that advance side by side, for which the seam
// between two chains has to wait a little.
//
// There is always a tile to hand out when none is out: of those with the fewest visits the first one.

#include "noise/tile_schedule.h"

#include <algorithm>
#include <cstdint>

namespace bn::noise {
namespace {

// 56x56 blocks are 784 KiB of energies, near the second-level cache. Fields of fewer than four tiles along
// an axis are cut into four smaller ones, so that some can be filled at once, and small ones are not cut at
// all.
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

/// Chains of at least two tiles, if so many are wanted.
int chains_along(int tiles, int wanted) { return std::clamp(wanted, 1, std::max(1, tiles / 2)); }

int first_block(int blocks, int tiles, int tile) {
  return static_cast<int>(std::int64_t{blocks} * tile / tiles);
}

}  // namespace

TileSchedule::TileSchedule(const EnergyField& field, int threads)
    : columns_(tiles_along(field.blocks_x)),
      rows_(tiles_along(field.blocks_y)),
      rounds_(rounds_of_visit(field)) {
  // A chain of rows keeps a thread busy for every three tiles of a row; a single row, one.
  const int fed = rows_ == 1 ? 1 : std::max(1, columns_ / 3);
  const int wanted = (threads + fed - 1) / fed;
  chains_x_ = rows_ == 1 ? chains_along(columns_, wanted) : 1;
  chains_y_ = chains_along(rows_, wanted);
  for (int row = 0; row < rows_; ++row) {
    const int top = first_block(field.blocks_y, rows_, row);
    const int bottom = first_block(field.blocks_y, rows_, row + 1);
    for (int column = 0; column < columns_; ++column) {
      const int left = first_block(field.blocks_x, columns_, column);
      const int right = first_block(field.blocks_x, columns_, column + 1);
      tiles_.push_back({.blocks = {left, top, right - left, bottom - top}, .column = column, .row = row});
    }
  }
}

const TileSchedule::Tile& TileSchedule::at(int column, int row) const {
  return tiles_[static_cast<std::size_t>(wrap(row, rows_) * columns_ + wrap(column, columns_))];
}

/// Whether no neighbour is out, those of its chain on the left and above have gone ahead, the others of its
/// chain are not behind, and those of other chains not by more than a visit.
bool TileSchedule::may_go(const Tile& tile) const {
  for (int row = tile.row - 1; row <= tile.row + 1; ++row) {
    for (int column = tile.column - 1; column <= tile.column + 1; ++column) {
      const Tile& other = at(column, row);
      const bool in_chain = other.column == column && other.row == row &&
                            column * chains_x_ / columns_ == tile.column * chains_x_ / columns_ &&
                            row * chains_y_ / rows_ == tile.row * chains_y_ / rows_;
      const int ahead = !in_chain ? -1 : &other < &tile ? 1 : 0;
      if (other.out || other.visits < tile.visits + ahead) return false;
    }
  }
  return true;
}

TileSchedule::Tile* TileSchedule::next() {
  Tile* found = nullptr;
  for (Tile& tile : tiles_) {
    if ((!found || tile.visits < found->visits) && may_go(tile)) found = &tile;
  }
  return found;
}

const TileSchedule::Tile* TileSchedule::take() {
  std::unique_lock lock(mutex_);
  Tile* tile = nullptr;
  changed_.wait(lock, [&] { return ended_ || (tile = next()); });
  if (ended_) return nullptr;
  tile->out = true;
  return tile;
}

void TileSchedule::bring_back(const Tile* tile) {
  const std::lock_guard lock(mutex_);
  Tile& own = tiles_[static_cast<std::size_t>(tile - tiles_.data())];
  own.out = false;
  ++own.visits;
  changed_.notify_all();
}

void TileSchedule::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

}  // namespace bn::noise
