// From values to places on a plot and to the numbers beside it; no drawing here.

#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ui/plot.h"

namespace bn::ui {

/// `value` where the axis can show it, else NaN.
double clean(const Axis& axis, double value);

/// From values to shares 0..1 of an axis and back.
struct Scale {
  bool logarithmic;
  double from, to;
  Scale(bool log, Interval range)
      : logarithmic(log),
        from(log ? std::log10(range.low) : range.low),
        to(log ? std::log10(range.high) : range.high) {}
  double share(double value) const {
    return ((logarithmic ? std::log10(value) : value) - from) / (to - from);
  }
  double value(double share) const {
    const double v = from + share * (to - from);
    return logarithmic ? std::pow(10.0, v) : v;
  }
  Interval between(double low_share, double high_share) const {
    return {value(low_share), value(high_share)};
  }
};

/// Least and greatest of what was taken; NaN: nothing was.
struct Extremes {
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
  void take(double value) {
    if (std::isnan(value)) return;
    low = std::isnan(low) ? value : std::min(low, value);
    high = std::isnan(high) ? value : std::max(high, value);
  }
};

/// A range with something in it, grown by `padding` of itself; the axis' own ends go before those of the
/// data.
Interval finish(const Axis& axis, Extremes data, double padding);

/// Neither narrower nor farther out than numbers can tell apart.
bool is_sound(const Axis& axis, Interval range);

struct Tick {
  double value;
  std::string text;  ///< empty: a minor one
};
/// About `most` named ticks in `range`, ascending, at round numbers.
std::vector<Tick> ticks_of(const Axis& axis, Interval range, double most);

}  // namespace bn::ui
