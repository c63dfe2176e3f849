// The grade: one number that says how near a texture comes to the best known.
//
// A threshold tells good from broken; it must leave room for every honest method, so a mask seventy times
// worse than the best known in the lowest band can pass it. The grade measures that room. The reference are
// our own void-and-cluster masks, sigma 1.9, which read like the best published ones (Peters 2016: .00003 |
// .0003 | .0035 | .051 at 128 x 128). A single mask scatters about its method's mean, more so the smaller it
// is, hence the reference is not the mean but what 19 of 20 masks of the size stay below. Sums of power over
// a band are compared as ratios: on this scale white noise is at 1 whatever the band.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bn/judgement.h"

namespace bn {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// 95 of 100 masks of side x side, stored in 8 bit, read less. 200 seeds a size to 64, 64 at 128, 24 at 256,
/// 8 at 512; docs/spectrum.md has the command. Rounding to 8 bit adds .000015 to every band.
struct BestKnown {
  double side;
  std::array<double, 4> bands;
};
constexpr std::array<BestKnown, 8> kBestKnown{{
    {8.0, {kNaN, 3.4e-3, 2.7e-2, 0.14}},
    {16.0, {3.8e-4, 2.9e-3, 8.3e-3, 0.12}},
    {24.0, {1.4e-4, 6.3e-4, 6.3e-3, 0.090}},
    {32.0, {1.1e-4, 4.4e-4, 4.6e-3, 0.072}},
    {64.0, {5.4e-5, 3.3e-4, 3.7e-3, 0.061}},
    {128.0, {4.5e-5, 3.0e-4, 3.5e-3, 0.057}},
    {256.0, {4.1e-5, 2.9e-4, 3.4e-3, 0.055}},
    {512.0, {4.0e-5, 2.8e-4, 3.35e-3, 0.054}},
}};

/// Slices of the best known volumes that are blue in space and time at once, and their power in time
/// (docs/spectrum.md). The share of slow changes depends on the number of slices: .04 of 64, .11 of 8.
constexpr std::array<double, 4> kBestSlices{1.1e-3, 2.5e-3, 0.011, 0.073};
constexpr double kBestInTime = 0.014, kBestSlow = 0.11;

/// Slices of the best known volumes that are made for the blurred and averaged picture alone.
constexpr std::array<double, 4> kBestFilteredSlices{4.5e-4, 1.05e-3, 5.0e-3, 0.039};

/// The anisotropy that a check allows, beyond the background of an average, and how far beyond it scores 0.
constexpr double kAnisotropyToZero_db = 10.0;

double score_of(double ratio_db, double white_db) {
  return 100.0 * (1.0 - std::clamp(ratio_db / white_db, 0.0, 1.0));
}

void add_power(std::string figure, double value, double best, Grade& grade) {
  if (std::isnan(value) || std::isnan(best)) return;
  // No power at all is as good as can be, and has no logarithm.
  const double ratio_db = 10.0 * std::log10(std::max(value, 1e-12) / best);
  grade.parts.push_back(
      {std::move(figure), value, best, ratio_db, score_of(ratio_db, -10.0 * std::log10(best))});
}

}  // namespace

std::array<double, 4> best_known_bands(Shape shape) {
  const double side = std::sqrt(static_cast<double>(shape.width) * shape.height);
  if (side <= kBestKnown.front().side) return kBestKnown.front().bands;
  if (side >= kBestKnown.back().side) return kBestKnown.back().bands;
  std::size_t next = 1;
  while (kBestKnown[next].side < side) ++next;
  const BestKnown &below = kBestKnown[next - 1], &above = kBestKnown[next];
  const double share = std::log(side / below.side) / std::log(above.side / below.side);
  std::array<double, 4> bands{};
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const double low = std::isnan(below.bands[b]) ? above.bands[b] : below.bands[b];
    bands[b] = low * std::pow(above.bands[b] / low, share);
  }
  return bands;
}

Grade grade(const FiguresOfMerit& figures, Check kind) {
  Grade result{.score = kNaN, .weakest = {}, .parts = {}};
  if (kind == Check::white) return result;
  const std::array<double, 4> best = kind == Check::stbn       ? kBestSlices
                                     : figures.shape.depth > 1 ? kBestFilteredSlices
                                                               : best_known_bands(figures.shape);
  for (std::size_t b = 0; b < best.size(); ++b) {
    add_power(fmt::format("bands[{}]", b), figures.bands.mean[b], best[b], result);
  }
  if (kind == Check::stbn) {
    add_power("temporal_power_at_0", figures.temporal_power_at_0, kBestInTime, result);
    add_power("temporal_power_low", figures.temporal_power_low, kBestSlow, result);
  }
  if (result.parts.empty()) return result;
  for (const JudgedFigure& judged : judge(figures, kind)) {
    if (judged.figure != "anisotropy_db_mean") continue;
    const double beyond_db = judged.value - judged.high;
    result.parts.push_back(
        {judged.figure, judged.value, judged.high, beyond_db, score_of(beyond_db, kAnisotropyToZero_db)});
  }
  // A constant has no power anywhere; it is not graded by that.
  const bool constant = !(figures.peak > 0.0);
  const auto least = std::min_element(result.parts.begin(), result.parts.end(),
                                      [](const auto& a, const auto& b) { return a.score < b.score; });
  result.score = constant ? 0.0 : least->score;
  if (constant) {
    result.weakest = "peak";
  } else if (least->score < 99.5) {
    result.weakest = least->figure;
  }
  return result;
}

}  // namespace bn
