#include "spectrum/distribution.h"

#include <algorithm>

namespace bn {

std::string_view name_of(Distribution distribution) {
  return distribution == Distribution::triangular ? "triangular" : "uniform";
}

namespace spectrum {

Spread spread_of(std::span<const double> values, double low, double high, const Execution& execution) {
  Spread spread{std::vector<double>(values.size()), midranks(values, execution)};
  const double count = static_cast<double>(values.size());
  for (double& share : spread.share) share = (share + 0.5) / count;
  // Ranges of stored levels (0..256, 0..65536) hold whole numbers; a float's 0..1 does not.
  const bool levels = high - low > 2.0 &&
                      std::all_of(values.begin(), values.end(), [](double v) { return v == std::trunc(v); });
  const double half_step = levels ? 0.5 : 0.0, scale = 1.0 / (high - low);
  for (std::size_t i = 0; i < values.size(); ++i) spread.place[i] = (values[i] + half_step - low) * scale;
  return spread;
}

}  // namespace spectrum
}  // namespace bn
