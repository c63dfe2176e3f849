#include "bn_study/trade_off.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "bn_study/convergence.h"
#include "core/progress.h"

namespace bn {
namespace {

constexpr std::array kSliceShares{0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
constexpr std::array kPixelShares{0.0, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0};

void measure(TradeOff& row, const SpatiotemporalOptions& options, const Execution& execution) {
  const Grid<float> samples = samples_of_ranks(spatiotemporal_mask(options, execution));
  const int frames = options.size.depth;
  const std::vector<double> error = filtered_error(samples, {}, frames, 0, execution);
  const auto last = std::max(frames / 8, 1);
  row.slice_error = error.front();
  row.average_error = std::accumulate(error.end() - last, error.end(), 0.0) / last;
  row.pixel_error = pixel_error(samples).back();
}

/// Whether `a` makes `b` pointless.
bool dominates(const TradeOff& a, const TradeOff& b) {
  const std::array errors{std::pair{a.slice_error, b.slice_error},
                          std::pair{a.average_error, b.average_error},
                          std::pair{a.pixel_error, b.pixel_error}};
  return std::all_of(errors.begin(), errors.end(), [](const auto& e) { return e.first <= e.second; }) &&
         std::any_of(errors.begin(), errors.end(), [](const auto& e) { return e.first < e.second; });
}

}  // namespace

std::vector<TradeOff> study_trade_off(Shape size, std::uint64_t seed, const Execution& execution) {
  std::vector<TradeOff> rows;
  std::vector<SpatiotemporalOptions> masks;
  const auto add = [&](std::string name, SpatiotemporalOptions options) {
    options = spatiotemporal_constants(options);
    rows.push_back({.name = std::move(name),
                    .slice_share = options.slice_share.value_or(1.0),
                    .pixel_share = options.pixel_share.value_or(0.0)});
    masks.push_back(options);
  };
  for (const auto preset :
       {SpatiotemporalPreset::stbn, SpatiotemporalPreset::filtered, SpatiotemporalPreset::both})
    add(std::string(name_of(preset)), {.size = size, .preset = preset, .seed = seed});
  for (const double slice_share : kSliceShares) {
    for (const double pixel_share : kPixelShares) {
      // Nothing joins the slices.
      if (slice_share == 1.0 && pixel_share == 0.0) continue;
      add("", {.size = size, .seed = seed, .slice_share = slice_share, .pixel_share = pixel_share});
    }
  }
  ProgressMeter meter(execution, rows.size());
  Execution quiet = execution;
  quiet.progress = {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    measure(rows[i], masks[i], quiet);
    meter.advance(1);
  }
  meter.finish();
  for (TradeOff& row : rows) {
    row.is_best =
        std::none_of(rows.begin(), rows.end(), [&](const TradeOff& other) { return dominates(other, row); });
  }
  return rows;
}

std::string trade_off_csv(const std::vector<TradeOff>& rows) {
  std::string text = "name,slice_share,pixel_share,slice_error,average_error,pixel_error,best\n";
  for (const TradeOff& row : rows) {
    text += fmt::format("{},{},{},{:.5f},{:.5f},{:.5f},{}\n", row.name, row.slice_share, row.pixel_share,
                        row.slice_error, row.average_error, row.pixel_error, row.is_best ? 1 : 0);
  }
  return text;
}

}  // namespace bn
