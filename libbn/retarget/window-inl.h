// What one row sees through its window, in vectors: cost + price of each column. Compiled once for each
// instruction set. All of it is integers, and ties go to the lowest position (y, then x), so every
// instruction set finds the same.

#if defined(BN_RETARGET_WINDOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BN_RETARGET_WINDOW_INL_H_
#undef BN_RETARGET_WINDOW_INL_H_
#else
#define BN_RETARGET_WINDOW_INL_H_
#endif

#include <hwy/highway.h>

#include "retarget/assignment.h"

HWY_BEFORE_NAMESPACE();
namespace bn {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A run of at most a vector's lanes of columns in one line of the window.
struct Run {
  std::int32_t shift;     ///< from a row's cell to the cell of the run's first column
  std::int32_t columns;   ///< 1..lanes
  std::int32_t position;  ///< of the first column among all columns of the window
};

template <class T, bool kSquare>
class Window {
 public:
  using D = hn::ScalableTag<T>;
  using V = hn::Vec<D>;

  explicit Window(const Market<T>& market) : market_(market) {
    const auto lanes = static_cast<int>(hn::Lanes(D()));
    std::int32_t position = 0;
    for (const ReachRow& line : market.window) {
      const std::int32_t origin = line.y * market.layout.stride();
      for (int x = line.x_low; x <= line.x_high; x += lanes) {
        const int columns = std::min(lanes, line.x_high - x + 1);
        runs_.push_back({origin + x, columns, position});
        for (int i = 0; i < columns; ++i) shifts_.push_back(origin + x + i);
        position += columns;
      }
    }
  }

  const std::vector<Run>& runs() const { return runs_; }
  /// The column at a position of the window of `row`.
  std::int32_t column(std::int32_t row, std::int32_t position) const {
    return market_.layout.home(row + shifts_[static_cast<std::size_t>(position)]);
  }

  /// cost + price of the columns of a run; what lies beyond its end is undefined.
  HWY_INLINE V values(V row_level, std::int32_t row, const Run& run) const {
    const auto first = static_cast<std::size_t>(row + run.shift);
    const D d;
    const V price = hn::LoadU(d, market_.price.data() + first);
    const std::int32_t* levels = market_.column_level.data() + first;
    if constexpr (sizeof(T) == sizeof(std::int32_t)) {
      const V difference = hn::Sub(row_level, hn::LoadU(d, levels));
      return hn::Add(price, kSquare ? hn::Mul(difference, difference) : hn::Abs(difference));
    } else {
      const hn::Rebind<std::int32_t, D> half;
      const V difference = hn::Sub(row_level, hn::PromoteTo(d, hn::LoadU(half, levels)));
      return hn::Add(price, kSquare ? hn::Mul(difference, difference) : hn::Max(difference, hn::Neg(difference)));
    }
  }

  struct Best {
    T least;
    T second;               ///< the least but for the column of `least`
    std::int32_t position;  ///< of `least`; the lowest if several are
  };

  HWY_INLINE Best cheapest(Holder who) const {
    const D d;
    const V blocked = hn::Set(d, Market<T>::kBlocked);
    const V level = hn::Set(d, T{who.level});
    V first = blocked, second = blocked, position = hn::Zero(d);
    std::int32_t columns = 0;
    auto inside = hn::FirstN(d, 0);
    for (const Run& run : runs_) {
      if (run.columns != columns) {  // most windows need one mask for all runs
        columns = run.columns;
        inside = hn::FirstN(d, static_cast<std::size_t>(columns));
      }
      const V value = hn::IfThenElse(inside, values(level, who.row, run), blocked);
      second = hn::Min(second, hn::Max(first, value));
      position = hn::IfThenElse(hn::Lt(value, first), hn::Set(d, T{run.position}), position);
      first = hn::Min(first, value);
    }
    const V least = hn::MinOfLanes(d, first);
    const V place = hn::IfThenElse(hn::Eq(first, least), hn::Add(position, hn::Iota(d, T{0})), blocked);
    const V lowest = hn::MinOfLanes(d, place);
    const V others = hn::IfThenElse(hn::Eq(place, lowest), second, first);
    return {hn::GetLane(least), hn::GetLane(hn::MinOfLanes(d, others)), static_cast<std::int32_t>(hn::GetLane(lowest))};
  }

 private:
  const Market<T>& market_;
  std::vector<Run> runs_;
  std::vector<std::int32_t> shifts_;
};

/// With column_of up to date: frees the rows of a rectangle whose column is more than `slack` above their cheapest, and appends all free
/// rows of the rectangle to `free_rows`, in index order.
template <class T, bool kSquare>
void free_discontent_rows(const Window<T, kSquare>& window, Market<T>& market, T slack, Offset origin, Extent size,
                          std::vector<std::int32_t>& free_rows) {
  for (int y = origin.y; y < origin.y + size.height; ++y) {
    for (int x = origin.x; x < origin.x + size.width; ++x) {
      const std::int32_t row = market.layout.cell(x, y);
      std::int32_t& column = market.column_of[static_cast<std::size_t>(row)];
      if (column != kUnassigned) {
        if (market.paid(column) <= window.cheapest(market.as_holder(row)).least + slack) continue;
        market.holder[static_cast<std::size_t>(column)].row = kUnassigned;
        column = kUnassigned;
      }
      free_rows.push_back(row);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace bn
HWY_AFTER_NAMESPACE();

#endif  // BN_RETARGET_WINDOW_INL_H_
