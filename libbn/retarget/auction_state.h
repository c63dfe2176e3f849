// What the steps of the exact solver hand on: rows, columns, prices, and which row each column is assigned
// to.

#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "retarget/padded_torus.h"

namespace bn::retarget {

/// Prices and costs of the auction are in 1/kPriceScale of a unit of cost. Finer prices leave fewer rows to
/// the exact finish but cost more bids; 1/16 is quickest. An even number of bits, so that levels can be
/// scaled for L2.
inline constexpr int kPriceScaleBits = 4;
inline constexpr int kPriceScale = 1 << kPriceScaleBits;

/// What levels are multiplied by so that costs are multiplied by kPriceScale.
constexpr int level_scale(Metric metric) {
  return metric == Metric::l2 ? 1 << (kPriceScaleBits / 2) : kPriceScale;
}

inline constexpr std::int32_t kUnassigned = -1;

/// A row with its level, to which a column is assigned. The two stand together, as the next step needs both.
struct Assignee {
  std::int32_t row;
  std::int32_t level;
};

/// Rows, columns, prices. T is int32 where prices fit, else int64: the same steps, so the same result.
template <class T>
struct AuctionState {
  /// What a column outside a tile without wrap costs; above all that is real.
  static constexpr T kBlocked = std::numeric_limits<T>::max() / 2;
  /// Prices stay at or below this, costs below kMaxCost, so that no sum of the solver overflows.
  static constexpr T kMaxPrice = kBlocked / 2;
  static constexpr T kMaxCost = kBlocked / 16;

  AuctionState(const MaskLevels& levels, const RetargetOptions& options);

  PaddedTorus layout;
  std::vector<ReachRow> window;
  bool square;  ///< metric L2

  // All by cell. Levels are multiplied by level_scale() while the auction runs.
  std::vector<std::int32_t> row_level;
  std::vector<std::int32_t> column_level;
  std::vector<T> price;
  std::vector<Assignee> assignee;       ///< per column
  std::vector<std::int32_t> column_of;  ///< per row; out of date while the auction runs
  T price_limit = kMaxPrice;            ///< lower only in tests

  /// Cost + price of a column to the row that it is assigned to.
  T assigned_cost(std::int32_t column) const {
    const auto at = static_cast<std::size_t>(column);
    const T difference = T{assignee[at].level} - column_level[at];
    return (square ? difference * difference : difference < 0 ? -difference : difference) + price[at];
  }
  Assignee as_assignee(std::int32_t row) const { return {row, row_level[static_cast<std::size_t>(row)]}; }

  /// Brings column_of up to date with `assignee`.
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

}  // namespace bn::retarget
