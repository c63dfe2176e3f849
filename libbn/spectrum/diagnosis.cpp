// The diagnosis: what has probably been done to a texture that is not what it should be.
//
// Most broken masks were good once, and were broken by a program in between: an image editor that applied
// sRGB, a converter that swapped bytes, a resize, a tile pasted together, alpha multiplied in. Each leaves a
// mark that chance does not. A finding is made only where the mark is there to within rounding, so that good
// masks, white noise and ordered dithers raise none; where nothing fits, nothing is said.

#include "spectrum/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "spectrum/transform.h"

namespace bn {
using namespace spectrum;
namespace {

/// The lowest band of white noise scatters; a picture has far more than that there.
constexpr double kPictureMargin = 3.0, kPictureDeviations = 8.0;

std::optional<Finding> find_picture(const FiguresOfMerit& figures) {
  const double power = figures.bands.mean[0];
  const double independent =
      0.5 * static_cast<double>(figures.bands.count[0] * figures.textures * figures.shape.depth);
  if (!(independent >= 1.0) || !(power > kPictureMargin + kPictureDeviations / std::sqrt(independent)))
    return {};
  return Finding{
      .cause = Cause::picture,
      .text = fmt::format("looks like a picture, not like noise: {:.3g} times the power of white noise at "
                          "0 < f <= 0.0625",
                          power),
      .number = power};
}

/// A texture of one value, or of two.
std::optional<Finding> find_few_values(const Samples& samples) {
  const auto [low, high] = std::minmax_element(samples.values.begin(), samples.values.end());
  if (*low == *high) {
    return Finding{.cause = Cause::constant,
                   .text = fmt::format("is constant: every value is {:.6g}", *low),
                   .number = *low};
  }
  std::int64_t upper = 0;
  for (const double value : samples.values) {
    if (value != *low && value != *high) return {};
    upper += value == *high;
  }
  if (samples.values.size() < 4) return {};
  const double share = static_cast<double>(upper) / static_cast<double>(samples.values.size());
  return Finding{
      .cause = Cause::two_levels,
      .text = fmt::format("has two levels only, {:.3g} % of them the higher: a thresholded picture, not "
                          "a mask",
                          100.0 * share),
      .number = share};
}

}  // namespace

std::string_view name_of(Cause cause) {
  switch (cause) {
    case Cause::constant:
      return "constant";
    case Cause::two_levels:
      return "two levels";
    case Cause::gamma:
      return "gamma";
    case Cause::srgb_encoded:
      return "sRGB encoded";
    case Cause::srgb_decoded:
      return "sRGB decoded";
    case Cause::part_of_range:
      return "part of range";
    case Cause::triangular:
      return "triangular";
    case Cause::gaussian:
      return "Gaussian";
    case Cause::bytes_swapped:
      return "bytes swapped";
    case Cause::enlarged:
      return "enlarged";
    case Cause::smoothed:
      return "smoothed";
    case Cause::repeated:
      return "repeated";
    case Cause::picture:
      return "picture";
    case Cause::alpha_multiplied:
      return "multiplied by alpha";
    case Cause::alpha_divided:
      break;
  }
  return "divided by alpha";
}

std::vector<Finding> diagnose(const Samples& samples, const Analysis& analysis, const Execution& execution) {
  check_shape(samples.shape, static_cast<std::int64_t>(samples.values.size()), "diagnosis");
  check_finite(samples.values, samples.shape, "diagnosis", execution);
  if (const auto few = find_few_values(samples)) return {*few};
  std::vector<Finding> findings;
  const auto add = [&](std::optional<Finding> finding) {
    if (!finding) return false;
    findings.push_back(std::move(*finding));
    return true;
  };
  // Whatever is enlarged looks smooth too, and what has its bytes swapped fits no curve: one cause a texture
  // of each sort.
  if (!add(spectrum::find_enlarged(samples))) add(spectrum::find_smoothed(analysis.figures, analysis.power));
  add(spectrum::find_repeated(samples));
  // The values of a picture follow no law, whatever curve they happen to be near.
  if (findings.empty() && add(find_picture(analysis.figures))) return findings;
  if (!add(spectrum::find_swapped_bytes(samples, analysis, execution)))
    add(spectrum::find_curve(samples, execution));
  return findings;
}

std::string relation_of(const CrossSpectrum& cross, std::string_view first) {
  if (!cross.can_tell() || cross.independent()) return {};
  const bool still = cross.peak_x == 0 && cross.peak_y == 0 && cross.peak_z == 0;
  const double size = std::abs(cross.peak_correlation);
  const std::string_view sign = cross.peak_correlation < 0.0 ? " inverted" : "";
  std::string place;
  if (!still) {
    place = fmt::format("{} moved by ({}, {}{})", sign.empty() ? "" : " and", cross.peak_x, cross.peak_y,
                        cross.peak_z == 0 ? "" : fmt::format(", {}", cross.peak_z));
  }
  if (size > 0.9) {
    if (still && sign.empty()) return fmt::format("is {} again", first);
    return fmt::format("is {}{}{}", first, sign, place);
  }
  return fmt::format("resembles {}{}{} (correlation {:.2f})", first, sign, place, cross.peak_correlation);
}

}  // namespace bn
