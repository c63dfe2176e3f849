#include "report/slice_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.h"

namespace bn::report {

SliceBands slice_bands(const std::vector<double>& values, Shape shape, const Execution& execution) {
  SliceBands slices;
  const auto count = static_cast<std::ptrdiff_t>(shape.slice().area());
  for (int z = 0; z < shape.depth; ++z) {
    throw_if_stopped(execution);
    const auto begin = values.begin() + z * count;
    // By ranks, as the figures of merit have it.
    const auto ranks = midranks(std::vector<double>(begin, begin + count), execution);
    slices.of_slice.push_back(
        band_power(power_spectrum({ranks.begin(), ranks.end()}, {shape.width, shape.height}, execution)));
  }
  return slices;
}

std::size_t SliceBands::lowest_band() const {
  std::size_t band = 0;
  while (band + 1 < kBandEdges.size() && std::isnan(of_slice[0].mean[band])) ++band;
  return band;
}

std::size_t SliceBands::worst() const {
  const std::size_t band = lowest_band();
  const auto found =
      std::max_element(of_slice.begin(), of_slice.end(),
                       [&](const BandPower& a, const BandPower& b) { return a.mean[band] < b.mean[band]; });
  return static_cast<std::size_t>(found - of_slice.begin());
}

Plot SliceBands::plot(std::string file_name) const {
  Plot plot{PlotStyle::slice_bands, std::move(file_name), "slice", "power", {}};
  Curve white{"white noise", Role::white, 0, {0.0, static_cast<double>(of_slice.size() - 1)}, {1.0, 1.0}};
  plot.curves.push_back(std::move(white));
  for (std::size_t band = lowest_band(); band < 4; ++band) {
    Curve curve{fmt::format("{} < f ≤ {}", band == 0 ? 0.0 : kBandEdges[band - 1], kBandEdges[band]),
                Role::texture,
                static_cast<int>(band),
                {},
                {}};
    for (std::size_t z = 0; z < of_slice.size(); ++z) {
      curve.x.push_back(static_cast<double>(z));
      curve.y.push_back(of_slice[z].mean[band]);
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

std::string SliceBands::words() const {
  const std::size_t band = lowest_band();
  return fmt::format("In the lower bands, against white noise. The worst slice is {}: {} in the lowest band.",
                     worst(), number(of_slice[worst()].mean[band]));
}

std::string SliceBands::greatest(std::size_t band) const {
  const auto less = [&](const BandPower& a, const BandPower& b) { return a.mean[band] < b.mean[band]; };
  const auto most = std::max_element(of_slice.begin(), of_slice.end(), less);
  return std::isnan(most->mean[band])
             ? "–"
             : fmt::format("{} (slice {})", number(most->mean[band]), most - of_slice.begin());
}

}  // namespace bn::report
