// The thresholds of the checks, in one place, each with its reason.
//
// All are on figures of ranks, so a mask passes or fails alike in any encoding. Where chance alone moves a
// figure the threshold is so many standard deviations of that chance, never a constant tuned by hand.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bn/spectrum.h"

namespace bn {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

/// Upper limits of the four lower bands. The fifth needs none: by Parseval it holds the rest.
using BandLimits = std::array<double, 4>;

/// A good two-dimensional mask reads .00003 | .0003 | .0035 | .054 (void-and-cluster, sigma 1.9), one
/// of a generator that leaves a start pixel's energy behind .015 in the lowest band. The limits
/// stand near the geometric middle where both sides are known, and at three to ten times the good value
/// elsewhere.
constexpr BandLimits kBlueLimits{0.002, 0.004, 0.02, 0.15};

/// Slices of a spatiotemporal mask share their quality with time: .0008 at most in the lowest band, .0016 |
/// .016 | .215 in the next; a broken generator reads .016.
constexpr BandLimits kSliceLimits{0.004, 0.01, 0.05, 0.4};

/// Mean of a pixel over time, as power: 1 where frames are independent, about .01 in a good volume.
constexpr double kTemporalLimit = 0.05;
/// Slow changes of a pixel: .04 to .11 in good volumes of 8 to 64 slices, 1 and more where their order is
/// lost.
constexpr double kTemporalLowLimit = 0.3;

/// What blur and average leave: -24 to -31 dB in good volumes of any size, -20 where frames are good but
/// know nothing of each other, 0 in white noise.
constexpr double kFilteredLimit_db = -21.5;

/// An annulus of a single texture scatters like white noise: 0 dB, and averaged over annuli -0.5 .. 0 with a
/// standard deviation of 0.35 dB at 32 x 32. A Bayer matrix reads above +10.
constexpr double kAnisotropyMeanMargin_db = 1.5;
/// The largest of all annuli of white noise stays below +7 dB in 200 textures of any size.
constexpr double kAnisotropyMaxMargin_db = 10.0;
/// Averaging lowers the background by 10 log10 K. No method is isotropic without end, so more than ten
/// textures ask no more than ten.
constexpr std::int64_t kMostAveraged = 10;
/// Slices that are blue in time say little new about each other: their pixels hold their power in half of the
/// frequencies. Averaging D of them lowers the background as D/2 would (-5.8 dB of 8, -9.8 of 16, -12.1 of
/// 32).
constexpr std::int64_t kSlicesAnIndependentOne = 2;

/// Band powers of white noise scatter by 1/sqrt(independent frequencies); below this many they are skewed.
constexpr double kLeastIndependent = 16.0;
constexpr double kWhiteDeviations = 5.0;

/// Counts of a flat mask differ from N / bins by less than one, and 8 bit rounding may add a little.
constexpr double kHistogramMargin = 0.05;
/// A mask of 8 bit follows any curve within half a level times its steepness, .004 for the triangle; the
/// nearest other common shape, a Gaussian of the same width, is .017 off.
constexpr double kDistributionLimit = 0.012;

class Judge {
 public:
  explicit Judge(const FiguresOfMerit& figures) : figures_(figures) {}

  /// NaN, a figure that this texture does not have, passes.
  void expect(std::string figure, double value, double low, double high) {
    if (std::isnan(value)) return;
    judged_.push_back({std::move(figure), value, low, high, value >= low && value <= high});
  }

  void expect_content() {
    if (figures_.peak > 0.0) return;
    judged_.push_back({"peak", figures_.peak, 0.0, kAny, false});  // a constant texture is no noise at all
  }

  void expect_bands(const BandLimits& limits) {
    for (std::size_t b = 0; b < limits.size(); ++b) {
      expect(fmt::format("bands[{}]", b), figures_.bands.mean[b], 0.0, limits[b]);
    }
  }

  void expect_white_bands() {
    for (std::size_t b = 0; b < kBandEdges.size(); ++b) {
      const double independent = 0.5 * static_cast<double>(figures_.bands.count[b] * averaged());
      if (independent < kLeastIndependent) continue;
      const double tolerance = kWhiteDeviations / std::sqrt(independent);
      expect(fmt::format("bands[{}]", b), figures_.bands.mean[b], 1.0 - tolerance, 1.0 + tolerance);
    }
  }

  void expect_isotropy(std::int64_t independent) {
    const auto textures = static_cast<double>(std::clamp<std::int64_t>(independent, 1, kMostAveraged));
    const double background_db = -10.0 * std::log10(textures);
    expect("anisotropy_db_mean", figures_.anisotropy_db_mean, -kAny,
           background_db + kAnisotropyMeanMargin_db);
    expect("anisotropy_db_max", figures_.anisotropy_db_max, -kAny, background_db + kAnisotropyMaxMargin_db);
  }

  void expect_distribution() {
    if (figures_.distribution != Distribution::uniform) {
      return expect("distribution_distance", figures_.distribution_distance, 0.0, kDistributionLimit);
    }
    const double expected = std::max(1.0, static_cast<double>(figures_.shape.count()) / kHistogramBins);
    expect("histogram_max_deviation", figures_.histogram_max_deviation, 0.0,
           1.0 / expected + kHistogramMargin);
  }

  void expect_blue_in_time() {
    expect("temporal_power_at_0", figures_.temporal_power_at_0, 0.0, kTemporalLimit);
    expect("temporal_power_low", figures_.temporal_power_low, 0.0, kTemporalLowLimit);
    expect("filtered_residual_db", figures_.filtered_residual_db, -kAny, kFilteredLimit_db);
  }

  void expect_volume() {
    if (figures_.shape.depth > 1) return;
    expect("depth", static_cast<double>(figures_.shape.depth), 2.0, kMaxSpectrumSide);
  }

  /// Periodograms in the average; the slices of a volume are averaged too.
  std::int64_t averaged() const { return figures_.textures * figures_.shape.depth; }

  std::vector<JudgedFigure> judged() && { return std::move(judged_); }

 private:
  const FiguresOfMerit& figures_;
  std::vector<JudgedFigure> judged_;
};

/// What a check allows, without the ends that no figure can reach.
std::string limits_in_words(double low, double high) {
  if (std::isinf(high)) return low == 0.0 ? "more than 0 is needed" : fmt::format("at least {:.4g}", low);
  if (std::isinf(low) || low == 0.0) return fmt::format("at most {:.4g}", high);
  return fmt::format("{:.4g} to {:.4g} is allowed", low, high);
}

}  // namespace

std::string label_of(std::string_view figure) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kLabels{{
      {"bands[0]", "power, 0 < f <= 0.0625"},
      {"bands[1]", "power, 0.0625 < f <= 0.125"},
      {"bands[2]", "power, 0.125 < f <= 0.1875"},
      {"bands[3]", "power, 0.1875 < f <= 0.25"},
      {"bands[4]", "power, 0.25 < f <= 0.5"},
      {"anisotropy_db_mean", "anisotropy, mean, dB"},
      {"anisotropy_db_max", "anisotropy, largest, dB"},
      {"histogram_max_deviation", "histogram, largest deviation"},
      {"distribution_distance", "distribution, largest distance"},
      {"temporal_power_at_0", "power in time, 0 cycles/frame"},
      {"temporal_power_low", "power in time, 0 < f <= 0.125"},
      {"filtered_residual_db", "left by blur and average, dB"},
      {"peak", "peak of the radial power"},
      {"depth", "slices"},
  }};
  for (const auto& [name, label] : kLabels) {
    if (name == figure) return std::string(label);
  }
  return std::string(figure);
}

std::string describe(const JudgedFigure& figure) {
  return fmt::format("{}: {:.3g}, {}", label_of(figure.figure), figure.value,
                     limits_in_words(figure.low, figure.high));
}

std::string describe(const CheckFailure& failure) {
  return describe(JudgedFigure{failure.figure, failure.value, failure.low, failure.high, false});
}

std::vector<JudgedFigure> judge(const FiguresOfMerit& figures, Check kind) {
  Judge judge(figures);
  judge.expect_content();
  judge.expect_isotropy(kind == Check::stbn ? judge.averaged() / kSlicesAnIndependentOne : judge.averaged());
  switch (kind) {
    case Check::blue:
      judge.expect_bands(kBlueLimits);
      judge.expect_distribution();
      break;
    case Check::white:
      judge.expect_white_bands();
      break;
    case Check::stbn:
      judge.expect_volume();
      judge.expect_bands(kSliceLimits);
      judge.expect_blue_in_time();
      judge.expect_distribution();
      break;
  }
  return std::move(judge).judged();
}

std::vector<CheckFailure> check(const FiguresOfMerit& figures, Check kind) {
  std::vector<CheckFailure> failures;
  for (auto& [figure, value, low, high, passed] : judge(figures, kind)) {
    if (!passed) failures.push_back({figure, value, low, high});
  }
  return failures;
}

}  // namespace bn
