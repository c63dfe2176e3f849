// Protects: no two tiles that are out at once are neighbours, whatever the field and the threads; every
// tile is visited again and again; one thread goes row by row.

#include "noise/tile_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace bn {
using namespace noise;
namespace {

/// Whether they touch on the torus of the field, at corners too.
bool touch(const EnergyField& field, const BlockRect& a, const BlockRect& b) {
  const auto along = [](int from_a, int size_a, int from_b, int size_b, int side) {
    return wrap(from_b - from_a, side) <= size_a || wrap(from_a - from_b, side) <= size_b;
  };
  return along(a.left, a.columns, b.left, b.columns, field.blocks_x) &&
         along(a.top, a.rows, b.top, b.rows, field.blocks_y);
}

constexpr int kRadius = 11;

TEST(TileSchedule, OneThreadGoesRowByRowAndCoversTheField) {
  const EnergyField field({2048, 1100}, kRadius, kSetMark);
  TileSchedule schedule(field, 1);
  std::vector<BlockRect> first;
  for (int sweep = 0; sweep < 3; ++sweep) {
    std::vector<int> covered(field.blocks.size());
    int at = 0;
    for (int blocks = 0; blocks < static_cast<int>(covered.size()); ++at) {
      const TileSchedule::Tile* tile = schedule.take();
      ASSERT_EQ(tile->visits, sweep);
      for (int y = 0; y < tile->blocks.rows; ++y) {
        for (int x = 0; x < tile->blocks.columns; ++x, ++blocks) {
          ++covered[static_cast<std::size_t>((tile->blocks.top + y) * field.blocks_x + tile->blocks.left +
                                             x)];
        }
      }
      EXPECT_EQ(tile->row * 4 + tile->column, at);
      schedule.bring_back(tile);
    }
    EXPECT_EQ(std::ranges::count(covered, 1), std::ssize(covered));
  }
}

TEST(TileSchedule, TilesThatAreOutDoNotTouch) {
  for (const Extent size : {Extent{64, 64}, Extent{1024, 1024}, Extent{16384, 64}, Extent{64, 4096},
                            Extent{2043, 1100}, Extent{4096, 2048}}) {
    for (const int threads : {2, 3, 7}) {
      const EnergyField field(size, kRadius, kSetMark);
      TileSchedule schedule(field, threads);
      std::mutex mutex;
      std::set<const TileSchedule::Tile*> out;
      std::set<const TileSchedule::Tile*> seen;
      int visits = 0;
      bool touched = false;
      const auto work = [&] {
        while (const TileSchedule::Tile* tile = schedule.take()) {
          {
            const std::lock_guard lock(mutex);
            for (const auto* other : out) touched |= touch(field, tile->blocks, other->blocks);
            out.insert(tile);
            seen.insert(tile);
            if (++visits == 400) schedule.end();
          }
          std::this_thread::yield();
          const std::lock_guard lock(mutex);
          out.erase(tile);
          schedule.bring_back(tile);
        }
      };
      {
        std::vector<std::jthread> workers;
        for (int i = 0; i < threads; ++i) workers.emplace_back(work);
      }
      EXPECT_FALSE(touched) << size.width << "x" << size.height << ", " << threads << " threads";
      std::int64_t blocks = 0;
      for (const auto* tile : seen) blocks += std::int64_t{tile->blocks.columns} * tile->blocks.rows;
      EXPECT_EQ(blocks, std::ssize(field.blocks)) << "some tile was never visited";
    }
  }
}

}  // namespace
}  // namespace bn
