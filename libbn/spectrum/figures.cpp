// Figures of merit: what is left of a spectrum when it must fit on one line.

#include <algorithm>
#include <cmath>

#include "bn/spectrum.h"
#include "spectrum/distribution.h"
#include "spectrum/ranks.h"
#include "spectrum/transform.h"

namespace bn {
using namespace spectrum;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Annuli with fewer frequencies, 16 independent ones, are too noisy to be a mean's or maximum's part.
constexpr std::int64_t kLeastFrequencies = 32;

/// Circles of up to 1/2 cycle/pixel lie whole in the square of frequencies. Those beyond are cut to arcs of
/// ever fewer frequencies, the largest of which would be a matter of luck: from the corner inwards they are
/// joined until they hold as many as the last whole one.
void find_peak(const RadialCurve& curve, FiguresOfMerit& figures) {
  figures.peak = 0.0;
  figures.peak_frequency = kNaN;
  const auto consider = [&](double power, double frequency) {
    if (power <= figures.peak) return;
    figures.peak = power;
    figures.peak_frequency = frequency;
  };
  std::size_t whole = 0;
  for (; whole < curve.power.size() && curve.frequency[whole] <= 0.5; ++whole) {
    if (curve.count[whole] > 0) consider(curve.power[whole], curve.frequency[whole]);
  }
  const std::int64_t wanted = whole > 0 ? curve.count[whole - 1] : 1;
  for (std::size_t end = curve.power.size(); end > whole;) {
    double power = 0.0, moment = 0.0;
    std::int64_t count = 0;
    while (end > whole && count < wanted) {
      --end;
      if (curve.count[end] == 0) continue;
      const double sum = curve.power[end] * static_cast<double>(curve.count[end]);
      power += sum;
      moment += curve.frequency[end] * sum;
      count += curve.count[end];
    }
    if (power > 0.0) consider(power / static_cast<double>(count), moment / power);
  }
}

void find_anisotropy(const RadialCurve& curve, FiguresOfMerit& figures) {
  double sum = 0.0, largest = -std::numeric_limits<double>::infinity();
  int annuli = 0;
  for (std::size_t j = 0; j < curve.power.size(); ++j) {
    if (curve.count[j] < kLeastFrequencies || std::isnan(curve.anisotropy_db[j])) continue;
    sum += curve.anisotropy_db[j];
    largest = std::max(largest, curve.anisotropy_db[j]);
    ++annuli;
  }
  figures.anisotropy_db_mean = annuli > 0 ? sum / annuli : kNaN;
  figures.anisotropy_db_max = annuli > 0 ? largest : kNaN;
}

/// Mean power at 0 < f <= 1/8 of a line.
double mean_of_low(const PowerSpectrum& line) {
  const int last = line.shape.width / 8;
  double sum = 0.0;
  for (int k = 1; k <= last; ++k) sum += line.half[static_cast<std::size_t>(k)];
  return last > 0 ? sum / last : kNaN;
}

}  // namespace

FiguresOfMerit figures_of_merit(const PowerSpectrum& power, double histogram_max_deviation) {
  if (power.shape.depth > 1) {
    FiguresOfMerit figures = figures_of_merit(project(power, Projection::xy), histogram_max_deviation);
    figures.shape = power.shape;
    figures.textures = power.textures;
    const PowerSpectrum time = project(power, Projection::z);
    figures.temporal_power_at_0 = time.half[0];
    figures.temporal_power_low = mean_of_low(time);
    figures.filtered_residual_db = filtered_residual_db(power);
    return figures;
  }
  FiguresOfMerit figures{.shape = power.shape, .textures = power.textures, .bands = band_power(power)};
  const RadialCurve curve = radial_power(power);
  find_peak(curve, figures);
  find_anisotropy(curve, figures);
  for (std::size_t s = 0; s < kResidualSigmas.size(); ++s) {
    figures.gauss_residual_db[s] = gauss_residual_db(power, kResidualSigmas[s]);
  }
  figures.histogram_max_deviation = histogram_max_deviation;
  return figures;
}

Analysis analyse(std::span<const double> values, Shape shape, double low, double high,
                 const Execution& execution, Distribution distribution) {
  check_shape(shape, static_cast<std::int64_t>(values.size()), "analysis");
  check_finite(values, shape, "analysis", execution);
  const auto bins = static_cast<int>(std::min<std::int64_t>(kHistogramBins, shape.count()));
  const double deviation = histogram_max_deviation(histogram(values, low, high, bins));
  // A mask of ranks is its own ranks, and power does not see the offset: no copy.
  PowerSpectrum power = is_permutation_of_a_range(values)
                            ? power_spectrum(values, shape, execution)
                            : power_spectrum(midranks(values, execution), shape, execution);
  FiguresOfMerit figures = figures_of_merit(power, deviation);
  figures.distribution = distribution;
  if (distribution == Distribution::triangular) {
    const spectrum::Spread spread = spectrum::spread_of(values, low, high, execution);
    figures.distribution_distance =
        spectrum::distance_from(spread, [](double u) { return spectrum::triangular_share(u); });
  }
  return {std::move(power), figures};
}

}  // namespace bn
