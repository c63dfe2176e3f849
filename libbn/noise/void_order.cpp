#include "noise/void_order.h"

#include <atomic>

#include "noise/fill_tile.h"
#include "noise/rank_order.h"
#include "noise/tile_schedule.h"

namespace bn::noise {

Grid<std::uint32_t> void_order(EnergyField&& field, const BlockKernel& kernel, std::int64_t count,
                               const Execution& execution, ProgressMeter& meter) {
  field.update_minima();
  Grid<std::uint32_t> order(field.size, kUnranked);
  if (count > 0) {
    const int threads = thread_count(execution);
    TileSchedule schedule(field, threads);
    std::atomic<std::int64_t> left = count;
    parallel_for(execution, threads, [&](std::int64_t) {
      try {
        while (const TileSchedule::Tile* tile = schedule.take()) {
          throw_if_stopped(execution);
          const std::int64_t now = fill_tile(field, kernel, tile->blocks, schedule.rounds(), order.data());
          schedule.bring_back(tile);
          meter.advance(static_cast<std::uint64_t>(now));
          if ((left -= now) == 0) schedule.end();
        }
      } catch (...) {
        schedule.end();  // or the others would wait
        throw;
      }
    });
  }
  replace_by_ranks(order, field.memory(), execution);
  return order;
}

}  // namespace bn::noise
