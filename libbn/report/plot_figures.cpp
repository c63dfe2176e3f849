// Plots as figures of the page, and what textures are compared with in them.

#include <fmt/format.h>

#include <cmath>

#include "bn/noise.h"
#include "report/html.h"
#include "report/section.h"

namespace bn::report {
namespace {

constexpr int kReferenceMasks = 10;
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
                       : curve.role == Role::others    ? 9
                                                       : 3 + curve.colour % kCurveColours,
                       escaped(curve.name));
  }
  return fmt::format(
      "<figure class=\"plot\"><figcaption><b>{}</b> {}</figcaption>{}<ul class=\"key\">{}</ul></figure>\n",
      title, caption, plot_slot(index), plot.curves.size() > 1 ? key : "");
}

Reference make_reference(const Execution& execution) {
  std::vector<PowerSpectrum> powers(kReferenceMasks);
  parallel_for(execution, kReferenceMasks, [&](std::int64_t i) {
    const Execution single{.threads = 1, .stop = execution.stop};
    const auto rank = void_and_cluster(
        {.size = {128, 128}, .seed = kReferenceSeed + static_cast<std::uint64_t>(i)}, single);
    powers[static_cast<std::size_t>(i)] =
        power_spectrum(std::vector<double>(rank.begin(), rank.end()), {128, 128}, single);
  });
  PowerSpectrum average = powers.front();
  Reference reference;
  reference.anisotropy_db.resize(radial_power(average).power.size());
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (i > 0) accumulate(average, powers[i]);
    const RadialCurve one = radial_power(powers[i]);
    for (std::size_t j = 0; j < one.anisotropy_db.size(); ++j) {
      reference.anisotropy_db[j] += std::pow(10.0, 0.1 * one.anisotropy_db[j]) / kReferenceMasks;
    }
  }
  for (double& a : reference.anisotropy_db) a = 10.0 * std::log10(a);
  reference.radial = radial_power(average);
  return reference;
}

Plot power_plot(std::string file_name, const Reference& reference) {
  return {
      PlotStyle::power,
      std::move(file_name),
      "frequency_cycles_per_pixel",
      "power",
      {white(1.0), {"good masks", Role::reference, 0, reference.radial.frequency, reference.radial.power}}};
}

Plot anisotropy_plot(std::string file_name, const Reference& reference) {
  return {
      PlotStyle::anisotropy,
      std::move(file_name),
      "frequency_cycles_per_pixel",
      "anisotropy_db",
      {white(0.0), {"good masks", Role::reference, 0, reference.radial.frequency, reference.anisotropy_db}}};
}

}  // namespace bn::report
