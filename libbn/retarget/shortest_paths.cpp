// The exact finish: integer prices, and shortest augmenting paths from all free rows at once.
//
// The state is a partial assignment with integer prices in which each assigned row has a column that is
// cheapest for it. The reduced cost of an arc is its cost + price less the row's cheapest: 0 on assigned
// arcs, at least 0 on all. A search grows shortest-path trees (Dijkstra) from some free rows together,
// through columns into the rows that they are assigned to, up to a length `limit`. Raising the price of each
// column reached at distance t < limit by limit - t keeps the invariant and makes every tree arc cost 0; then
// each tree that has reached a free column assigns its root along the path. The trees share no column, so all
// of them may do so. When no row is free the assignment is perfect, and the prices prove it optimal.
//
// After an auction nearly all free rows violate complementary slackness by one unit of cost: a few searches
// from all of them at once, with limit 1, walk along arcs of cost 0 and assign most. Of the last ones a
// single tree soon floods the tile and takes all the free columns; so these search one by one and stop at the
// first free column.
//
// H. W. Kuhn, "The Hungarian method for the assignment problem", 1955; R. Jonker and A. Volgenant, "A
// shortest augmenting path algorithm for dense and sparse linear assignment problems", Computing 38, 1987; A.
// V. Goldberg and R. Kennedy, "An efficient cost scaling algorithm for the assignment problem", 1995, for
// taking many paths in a phase.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "retarget/shortest_paths.cpp"
#include <hwy/foreach_target.h>

#include <cstring>
#include <span>

#include "retarget/candidate_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bn::retarget {
namespace HWY_NAMESPACE {

template <class T, bool kSquare>
class PathSearch {
 public:
  PathSearch(AuctionState<T>& state, const Execution& execution)
      : state_(state), execution_(execution), candidates_(state) {
    free_rows_violating_slackness(candidates_, state, T{0}, {0, 0}, state.layout.size(), free_rows_);
    if (free_rows_.empty()) return;
    const auto cells = static_cast<std::size_t>(state.layout.cells());
    distance_.assign(cells, kUnreached);
    parent_.resize(cells);
    root_.resize(cells);
    // Reserved at their largest: growth by doubling would take more at its peak.
    reached_.reserve(static_cast<std::size_t>(state.layout.size().area()));
    settled_.reserve(reached_.capacity());
  }

  Outcome run() { return assign_together() && assign_one_by_one() ? Outcome::done : Outcome::overflow; }

 private:
  static constexpr T kUnreached = AuctionState<T>::kBlocked;
  static constexpr T kMostLimit = AuctionState<T>::kMaxPrice / 4;

  /// A column reached at a distance beyond the one being settled; `order` makes the order total.
  struct Later {
    T distance;
    std::uint32_t order;
    std::int32_t column;
    bool operator<(const Later& other) const {  // for a heap with the nearest on top
      return distance != other.distance ? distance > other.distance : order > other.order;
    }
  };

  /// Searches from all free rows at once while that assigns a good part of them. False on overflow.
  bool assign_together() {
    T limit = 1;
    while (!free_rows_.empty()) {
      grow_trees(free_rows_, limit, false);
      const std::size_t before = free_rows_.size(), reached = free_columns_.size();
      if (!raise_prices()) return false;
      augment(free_rows_);
      std::erase_if(free_rows_, [&](std::int32_t row) {
        return state_.column_of[static_cast<std::size_t>(row)] != kUnassigned;
      });
      if ((before - free_rows_.size()) * 4 >= before) continue;
      if (reached * 2 >= before || limit >= kMostLimit / 2) return true;
      limit *= 2;
    }
    return true;
  }

  /// Searches from each free row in turn, up to the nearest free column. False on overflow.
  bool assign_one_by_one() {
    for (const std::int32_t root : free_rows_) {
      for (T limit = 1; state_.column_of[static_cast<std::size_t>(root)] == kUnassigned;
           limit = std::min<T>(limit * 2, kMostLimit)) {
        grow_trees({&root, 1}, limit, true);
        if (!raise_prices()) return false;
        augment({&root, 1});
      }
    }
    return true;
  }

  /// Grows trees from `roots` up to length `limit`, or to the first free column; limit_ is the length
  /// reached.
  void grow_trees(std::span<const std::int32_t> roots, T limit, bool to_first_free) {
    for (const std::int32_t column : reached_) state_.layout.store(distance_, column, kUnreached);
    reached_.clear();
    settled_.clear();
    free_columns_.clear();
    later_.clear();
    limit_ = limit;
    to_first_free_ = to_first_free;
    for (std::size_t tree = 0; tree < roots.size(); ++tree) {
      const Assignee row = state_.as_assignee(roots[tree]);
      reach_from(row, T{0}, candidates_.cheapest(row).least, static_cast<std::int32_t>(tree));
    }
    T base = 0;
    for (std::size_t next = 0;;) {
      for (; next < settled_.size() && base < limit_; ++next) {
        const std::int32_t column = settled_[next];
        const auto at = static_cast<std::size_t>(column);
        reach_from(state_.assignee[at], base, state_.assigned_cost(column), root_[at]);
        if (next % 8192 == 0) throw_if_stopped(execution_);
      }
      while (!later_.empty() && stale(later_.front())) pop_later();
      if (later_.empty() || later_.front().distance >= limit_) return;
      base = later_.front().distance;
      while (!later_.empty() && later_.front().distance == base) {
        if (!stale(later_.front())) settled_.push_back(later_.front().column);
        pop_later();
      }
    }
  }

  bool stale(const Later& entry) const {
    return distance_[static_cast<std::size_t>(entry.column)] != entry.distance;
  }
  void pop_later() {
    std::pop_heap(later_.begin(), later_.end());
    later_.pop_back();
  }

  /// Offers the columns of `row`, itself at distance `base` and paying `assigned_cost`, their distance
  /// through it.
  HWY_INLINE void reach_from(Assignee row, T base, T assigned_cost, std::int32_t tree) {
    const typename CandidateColumns<T, kSquare>::D d;
    const auto too_far = hn::Set(d, static_cast<T>(limit_ + 1));
    const auto offset = hn::Set(d, static_cast<T>(base - assigned_cost));
    const T* distances = distance_.data() + row.row;
    candidates_.for_each_span(row, [&](const ColumnSpan& span, auto columns, auto seen) HWY_ATTR {
      const auto reached = hn::Add(seen, offset);
      const auto known = hn::LoadU(d, distances + span.shift);
      const auto nearer = hn::And(hn::Lt(reached, hn::Min(known, too_far)), columns);
      if (HWY_LIKELY(hn::AllFalse(d, nearer))) return;
      HWY_ALIGN T through[hn::MaxLanes(typename CandidateColumns<T, kSquare>::D())];
      hn::Store(reached, d, through);
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, nearer, bytes);
      std::uint64_t bits;
      std::memcpy(&bits, bytes, sizeof(bits));
      for (; bits != 0; bits &= bits - 1) {
        const int lane = __builtin_ctzll(bits);
        reach(state_.layout.home(row.row + span.shift + lane), row.row, through[lane], base, tree);
      }
    });
  }

  void reach(std::int32_t column, std::int32_t row, T distance, T base, std::int32_t tree) {
    if (distance > limit_) return;  // the limit has come nearer since
    const auto at = static_cast<std::size_t>(column);
    const bool first = distance_[at] == kUnreached;
    if (first) reached_.push_back(column);
    state_.layout.store(distance_, column, distance);
    parent_[at] = row;
    root_[at] = tree;
    if (state_.assignee[at].row == kUnassigned) {
      if (first) free_columns_.push_back(column);
      if (to_first_free_) limit_ = distance;
    } else if (distance == limit_) {
      return;  // goes no further
    } else if (distance == base) {
      settled_.push_back(column);
    } else {
      later_.push_back({distance, order_++, column});
      std::push_heap(later_.begin(), later_.end());
    }
  }

  bool raise_prices() {
    for (const std::int32_t column : reached_) {
      const T distance = distance_[static_cast<std::size_t>(column)];
      if (distance >= limit_) continue;
      const T price = state_.price[static_cast<std::size_t>(column)];
      if (price > state_.price_limit - (limit_ - distance)) return false;
      state_.layout.store(state_.price, column, static_cast<T>(price + (limit_ - distance)));
    }
    return true;
  }

  /// Assigns the root of each tree that has reached a free column, along the path to one within the limit.
  void augment(std::span<const std::int32_t> roots) {
    for (std::int32_t column : free_columns_) {
      const auto at = static_cast<std::size_t>(column);
      const std::int32_t root = roots[static_cast<std::size_t>(root_[at])];
      if (distance_[at] > limit_ || state_.column_of[static_cast<std::size_t>(root)] != kUnassigned) continue;
      for (std::int32_t row = kUnassigned; row != root;) {
        row = parent_[static_cast<std::size_t>(column)];
        const std::int32_t given_up = state_.column_of[static_cast<std::size_t>(row)];
        state_.column_of[static_cast<std::size_t>(row)] = column;
        state_.assignee[static_cast<std::size_t>(column)] = state_.as_assignee(row);
        column = given_up;
      }
    }
  }

  AuctionState<T>& state_;
  const Execution& execution_;
  CandidateColumns<T, kSquare> candidates_;
  std::vector<std::int32_t> free_rows_;
  std::vector<T> distance_;                 // per column
  std::vector<std::int32_t> parent_;        // per column: the row it was reached from
  std::vector<std::int32_t> root_;          // per column: the tree, by its root's place
  std::vector<std::int32_t> reached_;       // all columns with a distance
  std::vector<std::int32_t> settled_;       // assigned columns nearer than the limit, by distance
  std::vector<std::int32_t> free_columns_;  // reached, in order of discovery
  std::vector<Later> later_;
  std::uint32_t order_ = 0;
  T limit_ = 0;
  bool to_first_free_ = false;
};

Outcome Complete32(AuctionState<std::int32_t>& state, const Execution& execution) {
  return state.square ? PathSearch<std::int32_t, true>(state, execution).run()
                      : PathSearch<std::int32_t, false>(state, execution).run();
}

Outcome Complete64(AuctionState<std::int64_t>& state, const Execution& execution) {
  return state.square ? PathSearch<std::int64_t, true>(state, execution).run()
                      : PathSearch<std::int64_t, false>(state, execution).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace bn::retarget
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn::retarget {

HWY_EXPORT(Complete32);
HWY_EXPORT(Complete64);

template <>
Outcome complete_by_shortest_paths(AuctionState<std::int32_t>& state, const Execution& execution) {
  return HWY_DYNAMIC_DISPATCH(Complete32)(state, execution);
}

template <>
Outcome complete_by_shortest_paths(AuctionState<std::int64_t>& state, const Execution& execution) {
  return HWY_DYNAMIC_DISPATCH(Complete64)(state, execution);
}

}  // namespace bn::retarget
#endif
