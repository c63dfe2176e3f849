// The columns that a row may take, its candidates, in vectors: cost + price of each. Compiled once for each
// instruction set. All of it is integers, and ties go to the lowest position (y, then x), so every
// instruction set finds the same.

#if defined(BN_RETARGET_CANDIDATE_COLUMNS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BN_RETARGET_CANDIDATE_COLUMNS_INL_H_
#undef BN_RETARGET_CANDIDATE_COLUMNS_INL_H_
#else
#define BN_RETARGET_CANDIDATE_COLUMNS_INL_H_
#endif

#include <hwy/highway.h>

#include "retarget/assignment.h"

HWY_BEFORE_NAMESPACE();
namespace bn::retarget {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// At most a vector's lanes of columns in one line of the window.
struct ColumnSpan {
  std::int32_t shift;     ///< from a row's cell to the cell of the first column
  std::int32_t position;  ///< of the first column among all columns of the window
};

/// Consecutive spans with the same number of columns; most windows are one group.
struct SpanGroup {
  int columns;  ///< 1..lanes
  std::size_t begin, end;
};

template <class T, bool kSquare>
class CandidateColumns {
 public:
  using D = hn::ScalableTag<T>;
  using V = hn::Vec<D>;

  explicit CandidateColumns(const AuctionState<T>& state) : state_(state) {
    const auto lanes = static_cast<int>(hn::Lanes(D()));
    std::int32_t position = 0;
    for (const ReachRow& line : state.window) {
      const std::int32_t origin = line.y * state.layout.stride();
      for (int x = line.x_low; x <= line.x_high; x += lanes) {
        const int columns = std::min(lanes, line.x_high - x + 1);
        spans_.push_back({origin + x, position});
        if (groups_.empty() || groups_.back().columns != columns)
          groups_.push_back({columns, spans_.size() - 1, 0});
        groups_.back().end = spans_.size();
        for (int i = 0; i < columns; ++i) shifts_.push_back(origin + x + i);
        position += columns;
      }
    }
  }

  /// Calls visit(span, mask of its columns, cost + price of each; what lies beyond the mask is undefined).
  template <class Visit>
  HWY_INLINE void for_each_span(Assignee who, Visit&& visit) const {
    const D d;
    const V row_level = hn::Set(d, T{who.level});
    const std::int32_t* levels = state_.column_level.data() + who.row;
    const T* prices = state_.price.data() + who.row;
    const ColumnSpan* spans = spans_.data();
    for (const SpanGroup& group : groups_) {
      const auto columns = hn::FirstN(d, static_cast<std::size_t>(group.columns));
      for (const ColumnSpan* span = spans + group.begin; span != spans + group.end; ++span) {
        visit(*span, columns,
              hn::Add(hn::LoadU(d, prices + span->shift), costs(row_level, levels + span->shift)));
      }
    }
  }

  /// The column at a position of the window of `row`.
  std::int32_t column(std::int32_t row, std::int32_t position) const {
    return state_.layout.home(row + shifts_[static_cast<std::size_t>(position)]);
  }

  struct Best {
    T least;
    T second;               ///< the least but for the column of `least`
    std::int32_t position;  ///< of `least`; the lowest if several are
  };

  HWY_INLINE Best cheapest(Assignee who) const {
    const D d;
    const V blocked = hn::Set(d, AuctionState<T>::kBlocked);
    V first = blocked, second = blocked, position = hn::Zero(d);
    for_each_span(who, [&](const ColumnSpan& span, auto columns, V seen) HWY_ATTR {
      const V value = hn::IfThenElse(columns, seen, blocked);
      second = hn::Min(second, hn::Max(first, value));
      position = hn::IfThenElse(hn::Lt(value, first), hn::Set(d, T{span.position}), position);
      first = hn::Min(first, value);
    });
    const V least = hn::MinOfLanes(d, first);
    const V place = hn::IfThenElse(hn::Eq(first, least), hn::Add(position, hn::Iota(d, T{0})), blocked);
    const V lowest = hn::MinOfLanes(d, place);
    const V others = hn::IfThenElse(hn::Eq(place, lowest), second, first);
    return {hn::GetLane(least), hn::GetLane(hn::MinOfLanes(d, others)),
            static_cast<std::int32_t>(hn::GetLane(lowest))};
  }

 private:
  HWY_INLINE static V costs(V row_level, const std::int32_t* levels) {
    const D d;
    if constexpr (sizeof(T) == sizeof(std::int32_t)) {
      const V difference = hn::Sub(row_level, hn::LoadU(d, levels));
      return kSquare ? hn::Mul(difference, difference) : hn::Abs(difference);
    } else {
      const hn::Rebind<std::int32_t, D> half;
      const V difference = hn::Sub(row_level, hn::PromoteTo(d, hn::LoadU(half, levels)));
      return kSquare ? hn::Mul(difference, difference) : hn::Max(difference, hn::Neg(difference));
    }
  }

  const AuctionState<T>& state_;
  std::vector<ColumnSpan> spans_;
  std::vector<SpanGroup> groups_;
  std::vector<std::int32_t> shifts_;
};

/// Frees the rows of a rectangle that violate complementary slackness, whose column costs more than `slack`
/// above their cheapest, with column_of up to date; and appends all free rows of the rectangle to
/// `free_rows`, in index order.
template <class T, bool kSquare>
void free_rows_violating_slackness(const CandidateColumns<T, kSquare>& candidates, AuctionState<T>& state,
                                   T slack, Offset origin, Extent size,
                                   std::vector<std::int32_t>& free_rows) {
  for (int y = origin.y; y < origin.y + size.height; ++y) {
    for (int x = origin.x; x < origin.x + size.width; ++x) {
      const std::int32_t row = state.layout.cell(x, y);
      std::int32_t& column = state.column_of[static_cast<std::size_t>(row)];
      if (column != kUnassigned) {
        if (state.assigned_cost(column) <= candidates.cheapest(state.as_assignee(row)).least + slack)
          continue;
        state.assignee[static_cast<std::size_t>(column)].row = kUnassigned;
        column = kUnassigned;
      }
      free_rows.push_back(row);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace bn::retarget
HWY_AFTER_NAMESPACE();

#endif  // BN_RETARGET_CANDIDATE_COLUMNS_INL_H_
