// The auction: a nearly optimal assignment with nearly optimal prices.
//
// Rows without a column bid, one after the other. A row takes the column that is cheapest for it at present
// prices and raises its price until the row is indifferent between it and the second cheapest, plus epsilon;
// the row that the column was assigned to is outbid and bids next. Prices only rise, and each assigned row
// stays within epsilon of its cheapest column, so a complete assignment is within rows * epsilon of the
// optimum. Coarse epsilons settle the prices roughly in few bids; each finer level starts from them and frees
// only the rows that are not within the new epsilon.
//
// The outbid row bids next while its part of the tile is in the cache; for the same reason rows start block
// by block. Each bid waits for the one before it in its chain, so a few chains, each with its own share of
// the block's rows, take turns: the processor overlaps their waits. The order is fixed, hence the result.
//
// A level that makes more bids than kPatience a row is in a price war, rows outbidding each other by epsilon
// over scarce columns: epsilon is raised until it ends, which costs no correctness.
//
// D. P. Bertsekas, "The auction algorithm: a distributed relaxation method for the assignment problem",
// Annals of Operations Research 14, 1988.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "retarget/auction.cpp"
#include <hwy/foreach_target.h>

#include <array>
#include <span>

#include "retarget/candidate_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bn::retarget {
namespace HWY_NAMESPACE {

template <class T, bool kSquare>
class Auction {
 public:
  Auction(AuctionState<T>& state, T epsilon, const Execution& execution, ProgressMeter& progress)
      : state_(state),
        execution_(execution),
        progress_(progress),
        candidates_(state),
        epsilon_(epsilon),
        patience_(kPatience * state.layout.size().area()) {}

  AuctionLevel run() {
    const auto [width, height] = state_.layout.size();
    // All rows are looked at before the first bid: a freed row's column draws its neighbours' chains to an
    // end.
    std::vector<std::int32_t> free_rows;
    std::vector<std::size_t> block_ends;
    std::vector<std::int64_t> block_areas;
    for (int y = 0; y < height; y += kBlock) {
      for (int x = 0; x < width; x += kBlock) {
        const Extent size{std::min(kBlock, width - x), std::min(kBlock, height - y)};
        free_rows_violating_slackness(candidates_, state_, epsilon_, {x, y}, size, free_rows);
        block_ends.push_back(free_rows.size());
        block_areas.push_back(size.area());
        throw_if_stopped(execution_);
      }
    }
    Outcome outcome = Outcome::done;
    for (std::size_t block = 0, begin = 0; block < block_ends.size(); begin = block_ends[block++]) {
      outcome = settle(std::span(free_rows).subspan(begin, block_ends[block] - begin));
      if (outcome != Outcome::done) break;
      progress_.advance(static_cast<std::uint64_t>(block_areas[block]));
    }
    state_.find_columns();
    return {outcome, epsilon_};
  }

 private:
  static constexpr int kBlock = 64;              // a block's rows and columns stay in the second-level cache
  static constexpr std::size_t kChains = 4;      // a bid's latency hides behind the other chains' bids
  static constexpr std::int64_t kPatience = 48;  // bids a row before epsilon is raised
  static constexpr int kMostRaises = 12;
  static constexpr std::int64_t kStopInterval = 8192;

  /// Bids until all of these rows have a column, and whoever they outbid too.
  Outcome settle(std::span<const std::int32_t> free_rows) {
    struct Chain {
      Assignee bidder;
      std::size_t next, end;
    };
    std::array<Chain, kChains> chains;
    for (std::size_t i = 0; i < kChains; ++i) {
      chains[i] = {{kUnassigned, 0}, free_rows.size() * i / kChains, free_rows.size() * (i + 1) / kChains};
    }
    for (std::size_t ended = 0; ended < kChains;) {
      ended = 0;
      for (Chain& chain : chains) {
        if (chain.bidder.row == kUnassigned) {
          if (chain.next == chain.end) {
            ++ended;
            continue;
          }
          chain.bidder = state_.as_assignee(free_rows[chain.next++]);
        }
        if (!bid(chain.bidder)) return Outcome::overflow;
        if (++bids_ % kStopInterval == 0) throw_if_stopped(execution_);
        if (bids_ % patience_ == 0 && !raise_epsilon()) return Outcome::incomplete;
      }
    }
    return Outcome::done;
  }

  /// `bidder` takes its cheapest column and becomes who is outbid, if anyone. False if a price passes the
  /// limit.
  HWY_INLINE bool bid(Assignee& bidder) {
    const auto best = candidates_.cheapest(bidder);
    const std::int32_t column = candidates_.column(bidder.row, best.position);
    T& price = state_.price[static_cast<std::size_t>(column)];
    // Without a second column there is nobody to outbid.
    const T raise = (best.second < AuctionState<T>::kBlocked ? best.second - best.least : T{0}) + epsilon_;
    if (price > state_.price_limit - raise) return false;
    state_.layout.store(state_.price, column, static_cast<T>(price + raise));
    std::swap(bidder, state_.assignee[static_cast<std::size_t>(column)]);
    return true;
  }

  bool raise_epsilon() {
    if (epsilon_ <= AuctionState<T>::kMaxCost / 4) epsilon_ = static_cast<T>(epsilon_ * 4);
    return ++raises_ <= kMostRaises;
  }

  AuctionState<T>& state_;
  const Execution& execution_;
  ProgressMeter& progress_;
  CandidateColumns<T, kSquare> candidates_;
  T epsilon_;
  std::int64_t patience_;
  std::int64_t bids_ = 0;
  int raises_ = 0;
};

AuctionLevel Auction32(AuctionState<std::int32_t>& state, std::int64_t epsilon, const Execution& execution,
                       ProgressMeter& progress) {
  const auto narrow = static_cast<std::int32_t>(epsilon);
  return state.square ? Auction<std::int32_t, true>(state, narrow, execution, progress).run()
                      : Auction<std::int32_t, false>(state, narrow, execution, progress).run();
}

AuctionLevel Auction64(AuctionState<std::int64_t>& state, std::int64_t epsilon, const Execution& execution,
                       ProgressMeter& progress) {
  return state.square ? Auction<std::int64_t, true>(state, epsilon, execution, progress).run()
                      : Auction<std::int64_t, false>(state, epsilon, execution, progress).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace bn::retarget
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn::retarget {

HWY_EXPORT(Auction32);
HWY_EXPORT(Auction64);

template <>
AuctionLevel run_auction(AuctionState<std::int32_t>& state, std::int64_t epsilon, const Execution& execution,
                         ProgressMeter& progress) {
  return HWY_DYNAMIC_DISPATCH(Auction32)(state, epsilon, execution, progress);
}

template <>
AuctionLevel run_auction(AuctionState<std::int64_t>& state, std::int64_t epsilon, const Execution& execution,
                         ProgressMeter& progress) {
  return HWY_DYNAMIC_DISPATCH(Auction64)(state, epsilon, execution, progress);
}

}  // namespace bn::retarget
#endif
