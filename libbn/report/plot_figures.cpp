// Plots as figures of the page, and what textures are compared with in them.

#include <fmt/format.h>

#include "bn/noise.h"
#include "report/html.h"
#include "report/section.h"

namespace bn::report {
namespace {

constexpr int kReferenceMasks = 4;
constexpr std::uint64_t kReferenceSeed = 1001;

/// The line of white noise, over all frequencies.
Curve white(double level) { return {"white noise", Role::white, 0, {0.0, 0.7071}, {level, level}}; }

}  // namespace

std::string plot_slot(std::size_t index) { return fmt::format("\x01{}\x02", index); }

std::string plot_figure(const Plot& plot, std::size_t index, std::string_view title,
                        std::string_view caption) {
  std::string key;
  for (const Curve& curve : plot.curves) {
    const std::string_view kind = curve.role == Role::white       ? "white"
                                  : curve.role == Role::reference ? "reference"
                                                                  : "";
    key += fmt::format("<li><i class=\"line {}\" style=\"--c:var(--plot-{})\"></i>{}</li>", kind,
                       curve.role == Role::white       ? 1
                       : curve.role == Role::reference ? 2
                                                       : 3 + curve.colour % kCurveColours,
                       escaped(curve.name));
  }
  return fmt::format(
      "<figure class=\"plot\"><figcaption><b>{}</b> {}</figcaption>{}<ul class=\"key\">{}</ul></figure>\n",
      title, caption, plot_slot(index), plot.curves.size() > 1 ? key : "");
}

Reference make_reference(const Execution& execution) {
  std::optional<PowerSpectrum> average;
  for (int i = 0; i < kReferenceMasks; ++i) {
    const auto rank = void_and_cluster(
        {.size = {128, 128}, .seed = kReferenceSeed + static_cast<std::uint64_t>(i)}, execution);
    const std::vector<double> values(rank.begin(), rank.end());
    PowerSpectrum power = power_spectrum(values, {128, 128}, execution);
    if (average) {
      accumulate(*average, power);
    } else {
      average = std::move(power);
    }
  }
  return {radial_power(*average)};
}

Plot power_plot(std::string file_name, const Reference& reference) {
  return {
      PlotStyle::power,
      std::move(file_name),
      "frequency_cycles_per_pixel",
      "power",
      {white(1.0), {"good masks", Role::reference, 0, reference.radial.frequency, reference.radial.power}}};
}

Plot anisotropy_plot(std::string file_name, const Reference&) {
  return {PlotStyle::anisotropy,
          std::move(file_name),
          "frequency_cycles_per_pixel",
          "anisotropy_db",
          {white(0.0)}};
}

}  // namespace bn::report
