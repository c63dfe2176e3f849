// The retarget problem as a sparse linear assignment problem.
//
// Rows are seeds, columns the pixels they land on, both in the coordinates of problem.h. Row q may take the
// columns q + k of its window, at cost(A(q), B(q + k)); nothing is stored per arc. Columns carry prices. By
// weak duality every perfect assignment costs at least
//     sum over rows of min over columns of (cost + price)  -  sum over columns of price,
// with equality iff each row has a column that is cheapest for it: such an assignment is optimal, and the
// prices prove it.
//
// Three steps, one file each:
//   auction.cpp         finds a nearly optimal assignment, fast, with prices in 1/16 of a unit of cost;
//   shortest_paths.cpp  rounds the prices to integers, frees the rows that are not content with their
//                       column, and assigns them again by shortest augmenting paths: exact;
//   certificate.cpp     computes the bound afresh from the definition.
// The answer is right whatever the auction leaves behind; the auction only makes it quick.

#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/progress.h"
#include "retarget/layout.h"

namespace bn::retarget {

inline constexpr std::int32_t kUnassigned = -1;

/// A row with its level: who holds a column. Both together, as the next step needs both.
struct Holder {
  std::int32_t row;
  std::int32_t level;
};

/// Rows, columns, prices. T is int32 where prices fit, else int64: the same steps, so the same result.
template <class T>
struct Market {
  /// What a column outside a tile without wrap costs; above all that is real.
  static constexpr T kBlocked = std::numeric_limits<T>::max() / 2;
  /// Prices stay at or below this, costs below kMaxCost, so that no sum of the solver overflows.
  static constexpr T kMaxPrice = kBlocked / 2;
  static constexpr T kMaxCost = kBlocked / 16;

  Market(const Grid<std::int32_t>& levels, const RetargetOptions& options);

  PaddedLayout layout;
  std::vector<ReachRow> window;
  bool square;  ///< metric L2

  // All by cell. Levels are multiplied by level_scale() while the auction runs.
  std::vector<std::int32_t> row_level;
  std::vector<std::int32_t> column_level;
  std::vector<T> price;
  std::vector<Holder> holder;           ///< per column
  std::vector<std::int32_t> column_of;  ///< per row; out of date while the auction runs
  T price_limit = kMaxPrice;            ///< lower only in tests

  /// cost + price of a column to whoever holds it.
  T paid(std::int32_t column) const {
    const auto at = static_cast<std::size_t>(column);
    const T difference = T{holder[at].level} - column_level[at];
    return (square ? difference * difference : difference < 0 ? -difference : difference) + price[at];
  }
  Holder as_holder(std::int32_t row) const { return {row, row_level[static_cast<std::size_t>(row)]}; }

  /// Brings column_of up to date with holder.
  void find_columns();

  /// To the auction's scale: levels times `level_scale(metric)`, before any price is set.
  void refine(int level_factor);
  /// Back from it, prices rounded to whole units of cost.
  void coarsen(int level_divisor);

  /// Prices of the pixels, by index.
  std::vector<std::int64_t> pixel_prices() const;
  /// The moves that a perfect assignment stands for, in the coordinates of seeds, u = q - d.
  Grid<Offset> moves(const RetargetOptions& options) const;
};

/// Prices and costs of the auction are in 1/kPriceScale of a unit of cost. Finer prices leave fewer rows to
/// the exact finish but cost more bids; 1/16 is quickest. An even number of bits, so that levels can be
/// scaled for L2.
inline constexpr int kPriceScaleBits = 4;
inline constexpr int kPriceScale = 1 << kPriceScaleBits;

/// What levels are multiplied by so that costs are multiplied by kPriceScale.
constexpr int level_scale(Metric metric) {
  return metric == Metric::l2 ? 1 << (kPriceScaleBits / 2) : kPriceScale;
}

enum class Outcome {
  done,        ///< every row has a column
  incomplete,  ///< gave up on some rows (auction only)
  overflow,    ///< a price passed the limit; the market is of no more use
};

/// One level of the auction: on return each assigned row's column is within `epsilon` (raised where a price
/// war would take too long; the value used comes back) of its cheapest.
struct AuctionLevel {
  Outcome outcome;
  std::int64_t epsilon;
};
/// Reports the tile's area as finished work.
template <class T>
AuctionLevel run_auction(Market<T>& market, std::int64_t epsilon, const Execution& execution,
                         ProgressMeter& progress);

/// Frees every row whose column is not its cheapest, then completes the assignment, optimally.
template <class T>
Outcome complete_by_shortest_paths(Market<T>& market, const Execution& execution);

/// The bound that prices (by pixel index, in units of cost / 2^scale_bits) prove for every permutation
/// within reach, rounded up to a whole energy. From the definition alone, in exact integers.
std::int64_t certified_lower_bound(const Grid<std::int32_t>& levels, const RetargetOptions& options,
                                   const std::vector<std::int64_t>& price, int scale_bits);

/// Which integers carry prices; both give the same result.
enum class PriceWidth { automatic, bits32, bits64 };

/// solve_retarget() with the width chosen, for tests; throws over_limit where bits32 do not suffice.
RetargetTile solve_with_width(const Grid<std::int32_t>& levels, const RetargetOptions& options,
                              const Execution& execution, PriceWidth width);

}  // namespace bn::retarget
