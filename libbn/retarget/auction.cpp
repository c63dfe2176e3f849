// The auction: a nearly optimal assignment with nearly optimal prices.
//
// Rows without a column bid, one after the other. A row takes the column that is cheapest for it at present
// prices and raises its price until the row is indifferent between it and the second cheapest, plus epsilon;
// whoever held the column is outbid and bids next. Prices only rise, and each assigned row stays within
// epsilon of its cheapest column, so a complete assignment is within rows * epsilon of the optimum. Coarse
// epsilons settle the prices roughly in few bids; each finer level starts from them and frees only the rows
// that are not within the new epsilon.
//
// Following the outbid row at once keeps the work in a few cache lines; starting in index order keeps it in
// the cache. A level that makes more bids than kPatience a row is in a price war, rows outbidding each other
// by epsilon over a scarce column: epsilon is raised until it ends, which costs no correctness.
//
// D. P. Bertsekas, "The auction algorithm: a distributed relaxation method for the assignment problem",
// Annals of Operations Research 14, 1988.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "retarget/auction.cpp"
#include <hwy/foreach_target.h>

#include "retarget/window-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bn {
namespace HWY_NAMESPACE {

template <class T, bool kSquare>
AuctionLevel auction_level(Market<T>& market, T epsilon, const Execution& execution, ProgressMeter& progress) {
  constexpr std::int64_t kPatience = 48, kMostRaises = 12;
  constexpr std::int64_t kStopInterval = 8192, kProgressInterval = 4096;
  const Window<T, kSquare> window(market);
  const std::vector<std::int32_t> free_rows = free_discontent_rows(window, market, epsilon);
  const std::int64_t rows = market.layout.size().area();

  std::int64_t bids = 0, next_raise = kPatience * rows, raises = 0, next_report = 0;
  for (std::size_t i = 0; i < free_rows.size(); ++i) {
    for (std::int32_t row = free_rows[i]; row != kUnassigned;) {
      const auto best = window.cheapest(row);
      const std::int32_t column = window.column(row, best.position);
      T& price = market.price[static_cast<std::size_t>(column)];
      // A row with no second column may bid anything; its market is one pixel.
      const T raise = (best.second < Market<T>::kBlocked ? best.second - best.least : T{0}) + epsilon;
      if (price > market.price_limit - raise) return {Outcome::overflow, epsilon};
      market.layout.store(market.price, column, static_cast<T>(price + raise));
      const std::int32_t outbid = market.row_of[static_cast<std::size_t>(column)];
      market.assign(row, column);
      if (outbid != kUnassigned) market.column_of[static_cast<std::size_t>(outbid)] = kUnassigned;
      row = outbid;

      if (++bids % kStopInterval == 0) throw_if_stopped(execution);
      if (bids == next_raise) {
        next_raise += kPatience * rows;
        if (++raises > kMostRaises) return {Outcome::incomplete, epsilon};
        if (epsilon <= Market<T>::kMaxCost / 4) epsilon = static_cast<T>(epsilon * 4);
      }
    }
    if (static_cast<std::int64_t>(i) == next_report) {
      progress.advance(kProgressInterval);
      next_report += kProgressInterval;
    }
  }
  return {Outcome::done, epsilon};
}

AuctionLevel Auction32(Market<std::int32_t>& market, std::int64_t epsilon, const Execution& execution,
                       ProgressMeter& progress) {
  const auto narrow = static_cast<std::int32_t>(epsilon);
  return market.square ? auction_level<std::int32_t, true>(market, narrow, execution, progress)
                       : auction_level<std::int32_t, false>(market, narrow, execution, progress);
}

AuctionLevel Auction64(Market<std::int64_t>& market, std::int64_t epsilon, const Execution& execution,
                       ProgressMeter& progress) {
  return market.square ? auction_level<std::int64_t, true>(market, epsilon, execution, progress)
                       : auction_level<std::int64_t, false>(market, epsilon, execution, progress);
}

}  // namespace HWY_NAMESPACE
}  // namespace bn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn {

HWY_EXPORT(Auction32);
HWY_EXPORT(Auction64);

template <>
AuctionLevel run_auction(Market<std::int32_t>& market, std::int64_t epsilon, const Execution& execution,
                         ProgressMeter& progress) {
  return HWY_DYNAMIC_DISPATCH(Auction32)(market, epsilon, execution, progress);
}

template <>
AuctionLevel run_auction(Market<std::int64_t>& market, std::int64_t epsilon, const Execution& execution,
                         ProgressMeter& progress) {
  return HWY_DYNAMIC_DISPATCH(Auction64)(market, epsilon, execution, progress);
}

}  // namespace bn
#endif
