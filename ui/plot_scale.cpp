#include "ui/plot_scale.h"

#include <fmt/format.h>

#include <algorithm>

namespace bn::ui {

double clean(const Axis& axis, double value) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0.0)
             ? value
             : std::numeric_limits<double>::quiet_NaN();
}

Interval finish(const Axis& axis, Extremes data, double padding) {
  if (std::isnan(data.low)) data.low = data.high = 1.0;
  if (axis.logarithmic) {
    const double grow = std::pow(data.high / data.low, padding);
    data.low /= grow, data.high *= grow;
    if (data.high < data.low * 1.01) data.low /= 1.5, data.high *= 1.5;
  } else {
    const double grow = (data.high - data.low) * padding;
    data.low -= grow, data.high += grow;
    if (data.high <= data.low) data.low -= 0.5, data.high += 0.5;
  }
  if (!std::isnan(axis.low)) data.low = axis.low;
  if (!std::isnan(axis.high)) data.high = axis.high;
  return {data.low, data.high};
}

bool is_sound(const Axis& axis, Interval range) {
  if (!std::isfinite(range.low) || !std::isfinite(range.high) || range.high <= range.low) return false;
  if (axis.logarithmic) return range.low > 1e-30 && range.high < 1e30 && range.high / range.low > 1.0 + 1e-6;
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  return size < 1e30 && range.high - range.low > 1e-9 * size;
}

std::vector<Tick> ticks_of(const Axis& axis, Interval range, double most) {
  std::vector<Tick> ticks;
  if (axis.logarithmic && range.high / range.low > 8.0) {
    const double first = std::floor(std::log10(range.low)), last = std::ceil(std::log10(range.high));
    const double stride = std::max(1.0, std::ceil((last - first) / most));
    for (double decade = first; decade <= last; ++decade) {
      const double base = std::pow(10.0, decade);
      const bool named = std::fmod(decade - first, stride) == 0.0;
      ticks.push_back({base, named ? short_number(base) : ""});
      // With few decades their parts are worth a name.
      for (const int part : {2, 3, 4, 5, 6, 7, 8, 9}) {
        const bool worth = last - first <= 3.0 && stride == 1.0 && (part == 2 || part == 5);
        if (stride == 1.0) ticks.push_back({base * part, worth ? short_number(base * part) : ""});
      }
    }
  } else {
    const double raw = (range.high - range.low) / std::max(1.0, most),
                 power = std::pow(10.0, std::floor(std::log10(raw)));
    double stride = 10.0 * power;
    for (const double part : {1.0, 2.0, 5.0}) {
      if (part * power >= raw) {
        stride = part * power;
        break;
      }
    }
    const double first = std::ceil(range.low / stride), last = std::floor(range.high / stride);
    for (double i = first; i <= last; ++i) ticks.push_back({i * stride, short_number(i * stride)});
  }
  std::erase_if(ticks, [&](const Tick& t) { return t.value < range.low || t.value > range.high; });
  return ticks;
}

std::string short_number(double value, int digits) {
  const double size = std::abs(value);
  if (value == 0.0) return "0";
  if (size >= 1e5 || size < 1e-3) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    // "1e+09" is "1e9"; what is no power stays short too: "2.5e8".
    if (text.find('e') == std::string::npos) text = fmt::format("{:.{}e}", value, digits - 1);
    const auto e = text.find('e');
    std::string mantissa = text.substr(0, e), power = text.substr(e + 1);
    if (mantissa.find('.') != std::string::npos) {
      mantissa.erase(mantissa.find_last_not_of('0') + 1);
      if (mantissa.back() == '.') mantissa.pop_back();
    }
    const bool minus = power[0] == '-';
    power.erase(0, power.find_first_not_of("+-0"));
    return fmt::format("{}e{}{}", mantissa, minus ? "-" : "", power);
  }
  return fmt::format("{:.{}g}", value, digits);
}
}  // namespace bn::ui
