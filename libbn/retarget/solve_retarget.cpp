// solve_retarget: checks, then auction, exact finish and certificate (assignment.h), in 32-bit prices where
// they fit and in 64-bit ones otherwise.

#include <fmt/format.h>

#include <optional>

#include "bn/error.h"
#include "retarget/assignment.h"

namespace bn {
namespace retarget {
namespace {

/// Where the auction starts: a quarter of the usual distance between a level and the nearest one in its
/// window, as a cost. Coarser only wastes bids; too fine is put right by the auction itself.
std::int64_t first_epsilon(const MaskLevels& levels, const RetargetOptions& options) {
  const auto [low, high] = level_range(levels);
  std::int64_t columns = 0;
  for (const ReachRow& row : reach_rows(levels.size(), options)) columns += row.x_high - row.x_low + 1;
  const std::int64_t spacing = std::int64_t{high - low} * level_scale(options.metric) / (6 * columns);
  return std::max<std::int64_t>(1, options.metric == Metric::l2 ? spacing * spacing : spacing);
}

/// Cells are counted in 32 bits; a tile of that many would need 128 GiB.
void check_cells(Extent size, const RetargetOptions& options) {
  constexpr std::uint64_t kMostCells = (std::uint64_t{1} << 31) - 256;
  if (exact_memory_bytes(size, options) / 64 <= kMostCells) return;
  throw Error({.code = ErrorCode::over_limit,
               .what = fmt::format("a tile of {}x{} pixels", size.width, size.height),
               .where = "retarget",
               .limit = "2^31 pixels with their border",
               .remedy = "use a smaller tile"});
}

/// Whether energy - bound <= gap * bound.
bool close_enough(std::int64_t energy, std::int64_t bound, double gap) {
  return static_cast<double>(energy - bound) <= gap * static_cast<double>(bound);
}

RetargetTile measured_tile(const MaskLevels& levels, const RetargetOptions& options, Grid<Offset> move,
                           std::int64_t lower_bound) {
  RetargetTile tile;
  check_permutation(move, options);
  tile.start_energy = retarget_energy(levels, Grid<Offset>(levels.size(), options.motion), options);
  tile.energy = retarget_energy(levels, move, options);
  tile.lower_bound = lower_bound;
  tile.move = std::move(move);
  return tile;
}

/// Empty where prices outgrow T.
template <class T>
std::optional<RetargetTile> solve_with(const MaskLevels& levels, const RetargetOptions& options,
                                       const Execution& execution, ProgressMeter& progress) {
  AuctionState<T> state(levels, options);
  state.refine(level_scale(options.metric));
  for (std::int64_t epsilon = first_epsilon(levels, options);;) {
    const AuctionLevel level = run_auction(state, epsilon, execution, progress);
    if (level.outcome == Outcome::overflow) {
      if constexpr (sizeof(T) == 4) return std::nullopt;
      state = AuctionState<T>(levels, options);  // the finish needs no auction
      state.refine(level_scale(options.metric));
      break;
    }
    if (level.outcome == Outcome::incomplete) break;
    if (options.gap > 0.0) {
      const std::int64_t bound =
          certified_lower_bound(levels, options, state.pixel_prices(), kPriceScaleBits);
      Grid<Offset> move = state.moves(options);
      if (close_enough(retarget_energy(levels, move, options), bound, options.gap)) {
        return measured_tile(levels, options, std::move(move), bound);
      }
    }
    if (level.epsilon == 1) break;
    epsilon = std::max<std::int64_t>(1, level.epsilon / 4);
  }
  state.coarsen(level_scale(options.metric));
  if (complete_by_shortest_paths(state, execution) == Outcome::overflow) return std::nullopt;
  return measured_tile(levels, options, state.moves(options),
                       certified_lower_bound(levels, options, state.pixel_prices(), 0));
}

}  // namespace

RetargetTile solve_with_width(const MaskLevels& levels, const RetargetOptions& options,
                              const Execution& execution, PriceWidth width) {
  check_options(options);
  const std::int64_t largest_cost = check_levels(levels, options.metric);
  thread_count(execution);
  check_memory(execution, exact_memory_bytes(levels.size(), options), "retarget");
  check_cells(levels.size(), options);
  throw_if_stopped(execution);

  // Each level of the auction and the exact finish count as one pass over the tile.
  int passes = 2;
  for (std::int64_t epsilon = first_epsilon(levels, options); epsilon > 1; epsilon /= 4) ++passes;
  ProgressMeter progress(execution, levels.from.count() * static_cast<std::uint64_t>(passes));
  std::optional<RetargetTile> tile;
  if (width != PriceWidth::bits64 && largest_cost * kPriceScale < AuctionState<std::int32_t>::kMaxCost) {
    tile = solve_with<std::int32_t>(levels, options, execution, progress);
  }
  if (!tile && width != PriceWidth::bits32)
    tile = solve_with<std::int64_t>(levels, options, execution, progress);
  if (!tile) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = fmt::format("prices outgrow {} bits", width == PriceWidth::bits32 ? 32 : 64),
                 .where = "retarget",
                 .limit = "",
                 .remedy = "use fewer levels, or the metric l1"});
  }
  progress.finish();
  return *std::move(tile);
}

}  // namespace retarget

RetargetTile solve_retarget(const MaskLevels& levels, const RetargetOptions& options,
                            const Execution& execution) {
  return retarget::solve_with_width(levels, options, execution, retarget::PriceWidth::automatic);
}

}  // namespace bn
