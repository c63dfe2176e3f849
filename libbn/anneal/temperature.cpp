#include "anneal/temperature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/refuse.h"
#include "core/reproducible_math.h"

namespace bn::anneal {

double temperature_for_acceptance(const std::vector<std::int64_t>& rises, double wanted) {
  if (rises.empty()) return 1.0;  // nothing to accept
  const auto share_at = [&](double temperature) {
    double sum = 0.0;
    for (const std::int64_t rise : rises) sum += reproducible_exp(-static_cast<double>(rise) / temperature);
    return sum / static_cast<double>(rises.size());
  };
  // By bisection of the exponent; IEEE operations in a written order give the same bits everywhere.
  double low = 0x1p-10, high = 0x1p62;
  for (int i = 0; i < 24; ++i) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (share_at(middle) < wanted ? low : high) = middle;
  }
  return high;
}

TemperatureRange temperatures_of(const AnnealOptions& options, const TemperatureSource& source) {
  using Rule = StartTemperature::Rule;
  const bool automatic_start = options.start.rule == Rule::automatic,
             automatic_end = options.end_temperature == 0.0;
  TemperatureRange range;
  if (automatic_start || automatic_end) range = source.automatic();
  if (options.start.rule == Rule::given) range.start = options.start.value;
  if (options.start.rule == Rule::acceptance)
    range.start = temperature_for_acceptance(source.rises(), options.start.value);
  if (options.start.rule == Rule::everything) {
    if (source.largest_change == 0) {
      refuse("start_temperature", "accept everything with a filtered residual",
             "automatic, given or an acceptance");
    }
    range.start = static_cast<double>(source.largest_change);
  }
  if (!automatic_end) range.end = options.end_temperature;
  if (range.end > range.start) {
    if (automatic_end) {
      range.end = range.start;
    } else if (automatic_start) {
      range.start = range.end;
    } else {
      refuse("end_temperature", fmt::format("{}", range.end),
             fmt::format("at most {}, the start temperature", range.start));
    }
  }
  return range;
}

}  // namespace bn::anneal
