// Schedules tiles over threads. The schedule does not change the result; fill_tile.cpp says why.

#pragma once

#include <condition_variable>
#include <mutex>
#include <vector>

#include "noise/energy_field.h"
#include "noise/fill_tile.h"

namespace bn::noise {

/// Hands out visits to the tiles that cover a field, again and again. Two tiles that are out at once are
/// out of each other's reach. Thread safe.
class TileSchedule {
 public:
  TileSchedule(const EnergyField& field, int threads);

  struct Tile {
    BlockRect blocks;
    int column;
    int row;
    int visits = 0;
    bool out = false;
  };

  /// The rounds that a visit may have.
  int rounds() const { return rounds_; }
  /// The tile to visit next, once there is one; nullptr after end(). Bring it back.
  const Tile* take();
  void bring_back(const Tile* tile);
  /// Nothing is handed out any more.
  void end();

 private:
  bool may_go(const Tile& tile) const;
  const Tile& at(int column, int row) const;
  Tile* next();

  int columns_;
  int rows_;
  int chains_x_;
  int chains_y_;
  int rounds_;
  std::vector<Tile> tiles_;  // index row * columns_ + column
  bool ended_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace bn::noise
