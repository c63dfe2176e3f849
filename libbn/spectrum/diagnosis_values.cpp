// What was done to values: curves, distributions, the order of bytes.
//
// A mask holds every value equally often, so the share of pixels below a value is the value. Whatever curve
// was applied shows as the relation of the two, to within a level: candidates are compared by their largest
// distance from it. Exponents are found by least squares of log(place) = e log(share) over the middle of the
// range, where rounding matters least.

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "spectrum/diagnosis.h"
#include "spectrum/distribution.h"

namespace bn::spectrum {
namespace {

/// A curve is told only where it leaves this, and a third of what a straight line leaves.
double tolerance(std::size_t count) { return 0.008 + 0.8 / std::sqrt(static_cast<double>(count)); }
constexpr double kLessThanStraight = 1.0 / 3.0;
/// Exponents nearer to 1 than this, or than chance makes them, are none.
double least_exponent_step(std::size_t count) {
  return std::max(0.05, 5.0 / std::sqrt(static_cast<double>(count)));
}

double srgb_decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double exponent_of(const Spread& spread) {
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < spread.place.size(); ++i) {
    const double place = spread.place[i], share = spread.share[i];
    if (share < 0.1 || share > 0.9 || place <= 0.0) continue;
    products += std::log(place) * std::log(share);
    squares += std::log(share) * std::log(share);
  }
  return squares > 0.0 ? products / squares : 1.0;
}

/// Distance between what a curve makes of even values and what stands there. Measured in the values where the
/// curve is steep in the shares, and the other way round, so that a level's step is never magnified.
double distance_of_curve(const Spread& spread, double exponent) {
  if (exponent < 1.0) return distance_from(spread, [&](double u) { return std::pow(u, 1.0 / exponent); });
  double largest = 0.0;
  for (std::size_t i = 0; i < spread.place.size(); ++i) {
    largest = std::max(largest, std::abs(std::pow(spread.share[i], exponent) - spread.place[i]));
  }
  return largest;
}

struct Candidate {
  Finding finding;
  double distance;
};

std::string short_number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  return text.starts_with("0.") ? text.substr(1) : text;
}

Candidate power_curve(const Spread& spread) {
  const double e = exponent_of(spread);
  double shown = e;
  std::string_view known_as;
  // Rounding to levels moves the exponent by a hundredth; the usual ones are called by their names.
  for (const auto& [known, name] :
       {std::pair(1.8, "1.8"), std::pair(2.0, "2"), std::pair(2.2, "2.2"), std::pair(2.4, "2.4")}) {
    if (std::abs(1.0 / e - known) < 0.04) shown = 1.0 / known, known_as = name;
  }
  std::string text =
      fmt::format("looks gamma-{}, exponent {}", e < 1.0 ? "encoded" : "decoded", short_number(shown));
  if (!known_as.empty()) text += fmt::format(" (1/{})", known_as);
  return {{.cause = Cause::gamma, .text = text, .number = e}, distance_of_curve(spread, e)};
}

std::vector<Candidate> candidates(const Spread& spread) {
  std::vector<Candidate> list;
  const std::size_t count = spread.place.size();
  if (std::all_of(spread.place.begin(), spread.place.end(), [](double u) { return u >= 0.0 && u <= 1.0; })) {
    Candidate power = power_curve(spread);
    if (std::abs(power.finding.number - 1.0) > least_exponent_step(count)) list.push_back(std::move(power));
    list.push_back(
        {{.cause = Cause::srgb_encoded, .text = "looks sRGB-encoded (linear data saved as colours)"},
         distance_from(spread, [](double u) { return srgb_decoded(u); })});
    double decoded = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      decoded = std::max(decoded, std::abs(srgb_decoded(spread.share[i]) - spread.place[i]));
    }
    list.push_back(
        {{.cause = Cause::srgb_decoded, .text = "looks sRGB-decoded (linear data read as colours)"},
         decoded});
  }
  double mean = 0.0, square = 0.0;
  for (const double u : spread.place) mean += u;
  mean /= static_cast<double>(count);
  for (const double u : spread.place) square += (u - mean) * (u - mean);
  const double deviation = std::sqrt(square / static_cast<double>(count));
  const double triangle = 2.0 * std::sqrt(6.0) * deviation;
  list.push_back(
      {{.cause = Cause::triangular,
        .text = "has values of triangular distribution (TPDF); judge it with --distribution triangular",
        .number = triangle},
       distance_from(spread, [&](double u) { return triangular_share((u - mean) / triangle + 0.5); })});
  list.push_back(
      {{.cause = Cause::gaussian,
        .text = fmt::format("has values of normal (Gaussian) distribution, deviation {:.3g} of the range",
                            deviation),
        .number = deviation},
       distance_from(spread,
                     [&](double u) { return 0.5 * std::erfc((mean - u) / (deviation * std::sqrt(2.0))); })});
  const auto [least, most] = std::minmax_element(spread.place.begin(), spread.place.end());
  const double width = *most - *least;
  list.push_back(
      {{.cause = Cause::part_of_range,
        .text = fmt::format("is evenly spread, but over {:.3g} to {:.3g} of the range only", *least, *most),
        .number = width},
       distance_from(spread, [low = *least, width](double u) { return (u - low) / width; })});
  return list;
}

}  // namespace

std::optional<Finding> find_curve(const Samples& samples, const Execution& execution) {
  if (samples.values.size() < 64 || !(samples.low < samples.high)) return {};
  const Spread spread = spread_of(samples.values, samples.low, samples.high, execution);
  const double straight = distance_from(spread, [](double u) { return u; });
  std::optional<Candidate> best;
  for (Candidate& candidate : candidates(spread)) {
    if (!(candidate.distance < tolerance(spread.place.size())) ||
        !(candidate.distance < kLessThanStraight * straight)) {
      continue;
    }
    if (!best || candidate.distance < best->distance) best = std::move(candidate);
  }
  if (!best) return {};
  return best->finding;
}

std::optional<Finding> find_swapped_bytes(const Samples& samples, const Analysis& analysis,
                                          const Execution& execution) {
  const bool sixteen_bit = samples.low == 0.0 && samples.high == 65536.0 &&
                           std::all_of(samples.values.begin(), samples.values.end(), [](double v) {
                             return v >= 0.0 && v < 65536.0 && v == std::trunc(v);
                           });
  if (!sixteen_bit) return {};
  std::vector<double> swapped(samples.values.size());
  for (std::size_t i = 0; i < swapped.size(); ++i) {
    const auto value = static_cast<unsigned>(samples.values[i]);
    swapped[i] = static_cast<double>((value & 255u) << 8 | value >> 8);
  }
  const Analysis other = analyse(swapped, samples.shape, samples.low, samples.high, execution);
  // Right way round, the histogram is flat where it was not, or the lowest bands are empty where they were
  // not.
  const auto flat = [](const FiguresOfMerit& figures) {
    const auto judged = judge(figures, Check::blue);
    return std::all_of(judged.begin(), judged.end(),
                       [](const auto& f) { return f.passed || f.figure != "histogram_max_deviation"; });
  };
  if (!flat(other.figures)) return {};
  const double here = analysis.figures.bands.mean[0], there = other.figures.bands.mean[0];
  const bool bluer = here > 0.1 && there < 0.1 * here;
  if (flat(analysis.figures) && !bluer) return {};
  return Finding{.cause = Cause::bytes_swapped, .text = "looks like 16-bit samples with their bytes swapped"};
}

}  // namespace bn::spectrum
