// What was done to places: enlarging, smoothing, tiling; and to colours by alpha.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "bn/error.h"
#include "spectrum/diagnosis.h"
#include "spectrum/transform.h"

namespace bn {
namespace spectrum {
namespace {

/// Where the radial peak of a blue-noise mask lies, cycles/pixel; enlarged by s it lies at 1/s of that.
constexpr double kPeakOfAMask = 0.35;
constexpr double kLowPeak = 0.27, kEmptyAbove = 0.4, kEmptyPower = 0.2;
/// Opposite a period there must be something to compare.
constexpr int kLeastOverlap = 8;

struct View {
  const Samples& samples;
  double operator()(int x, int y, int z) const {
    const Shape& s = samples.shape;
    return samples.values[(static_cast<std::size_t>(z) * s.height + y) * s.width + x];
  }
};

/// Whether test(x, y, z) holds everywhere.
template <class Test>
bool everywhere(const Shape& shape, const Test& test) {
  for (int z = 0; z < shape.depth; ++z) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        if (!test(x, y, z)) return false;
      }
    }
  }
  return true;
}

/// A line of values as one number, so that lines are compared at once. Equal lines have equal ones; that
/// unequal lines have is as likely as 2^-64, and is looked into.
struct LineHash {
  std::uint64_t state = 0x9e3779b97f4a7c15u;
  void add(double value) {
    state ^= std::bit_cast<std::uint64_t>(value + 0.0);  // -0 is 0
    state = (state ^ state >> 29) * 0xbf58476d1ce4e5b9u;
  }
};

/// Least move by which `lines` repeat themselves, of at most three quarters of them, with enough beyond it to
/// compare; or 0. `equal(p)` makes sure.
template <class Equal>
int least_period(const std::vector<LineHash>& lines, int most, const Equal& equal) {
  const auto count = static_cast<int>(lines.size());
  for (int p = 1; p <= most; ++p) {
    int i = 0;
    while (i + p < count &&
           lines[static_cast<std::size_t>(i)].state == lines[static_cast<std::size_t>(i + p)].state)
      ++i;
    if (i + p == count && equal(p)) return p;
  }
  return 0;
}

int most_period(int side) { return std::min(3 * side / 4, side - std::min(kLeastOverlap, side / 2)); }

int largest_block(int side, const auto& blocky) {
  for (int k = side / 2; k >= 2; --k) {
    if (side % k == 0 && blocky(k)) return k;
  }
  return 1;
}

std::string period_in_words(int x, int y, int z) {
  std::string text;
  const auto add = [&](int period, std::string_view of) {
    if (period > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", period, of);
  };
  if (x == y) {
    add(x, "pixels in x and y");
  } else {
    add(x, "pixels in x");
    add(y, "pixels in y");
  }
  add(z, "slices");
  return text;
}

}  // namespace

std::optional<Finding> find_enlarged(const Samples& samples) {
  const Shape& shape = samples.shape;
  const View at{samples};
  const int x = largest_block(shape.width, [&](int k) {
    return everywhere(shape,
                      [&](int px, int py, int pz) { return at(px, py, pz) == at(px - px % k, py, pz); });
  });
  const int y = largest_block(shape.height, [&](int k) {
    return everywhere(shape,
                      [&](int px, int py, int pz) { return at(px, py, pz) == at(px, py - py % k, pz); });
  });
  if (x == 1 && y == 1) return {};
  return Finding{
      .cause = Cause::enlarged,
      .text = x == y ? fmt::format("is enlarged {} times, every pixel repeated", x)
                     : fmt::format("is enlarged {} times in x and {} in y, every pixel repeated", x, y),
      .number = std::sqrt(static_cast<double>(x) * y),
      .x = x,
      .y = y};
}

std::optional<Finding> find_smoothed(const FiguresOfMerit& figures, const PowerSpectrum& power) {
  if (!(figures.peak_frequency < kLowPeak)) return {};
  const RadialCurve curve = radial_power(power.shape.depth > 1 ? project(power, Projection::xy) : power);
  double sum = 0.0;
  std::int64_t count = 0;
  for (std::size_t j = 0; j < curve.power.size(); ++j) {
    if (curve.frequency[j] < kEmptyAbove || curve.count[j] == 0) continue;
    sum += curve.power[j] * static_cast<double>(curve.count[j]);
    count += curve.count[j];
  }
  if (count == 0 || sum > kEmptyPower * static_cast<double>(count)) return {};
  // A picture is smooth too; only noise has its hole at low frequencies kept.
  const double lowest = figures.bands.mean[0];
  if (!(lowest < 0.1 * figures.peak)) return {};
  const double times = kPeakOfAMask / figures.peak_frequency;
  return Finding{
      .cause = Cause::smoothed,
      .text = fmt::format("looks enlarged or blurred smoothly, about {:.1f} times: the peak is at {:.2f} "
                          "cycles/pixel, a mask's at {:.2f}",
                          times, figures.peak_frequency, kPeakOfAMask),
      .number = times};
}

std::optional<Finding> find_repeated(const Samples& samples) {
  const Shape& s = samples.shape;
  const View at{samples};
  std::vector<LineHash> columns(static_cast<std::size_t>(s.width)), rows(static_cast<std::size_t>(s.height)),
      slices(static_cast<std::size_t>(s.depth));
  everywhere(s, [&](int px, int py, int pz) {
    const double value = at(px, py, pz);
    columns[static_cast<std::size_t>(px)].add(value);
    rows[static_cast<std::size_t>(py)].add(value);
    slices[static_cast<std::size_t>(pz)].add(value);
    return true;
  });
  const int x = least_period(columns, most_period(s.width), [&](int p) {
    return everywhere({s.width - p, s.height, s.depth},
                      [&](int px, int py, int pz) { return at(px, py, pz) == at(px + p, py, pz); });
  });
  const int y = least_period(rows, most_period(s.height), [&](int p) {
    return everywhere({s.width, s.height - p, s.depth},
                      [&](int px, int py, int pz) { return at(px, py, pz) == at(px, py + p, pz); });
  });
  const int z = least_period(slices, s.depth / 2, [&](int p) {
    return everywhere({s.width, s.height, s.depth - p},
                      [&](int px, int py, int pz) { return at(px, py, pz) == at(px, py, pz + p); });
  });
  if (x == 0 && y == 0 && z == 0) return {};
  return Finding{.cause = Cause::repeated,
                 .text = "is one tile repeated, every " + period_in_words(x, y, z),
                 .x = x,
                 .y = y,
                 .z = z};
}

}  // namespace spectrum

using namespace spectrum;

std::vector<Finding> diagnose_alpha(std::span<const Samples> channels) {
  if (channels.size() != 2 && channels.size() != 4) return {};
  const Samples& alpha = channels.back();
  const std::size_t count = alpha.values.size();
  for (const Samples& channel : channels) {
    check_shape(channel.shape, static_cast<std::int64_t>(channel.values.size()), "diagnosis of alpha");
    if (channel.shape == alpha.shape) continue;
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "channels of different sizes",
                 .where = "diagnosis of alpha",
                 .limit = "",
                 .remedy = ""});
  }
  const auto [least, most] = std::minmax_element(alpha.values.begin(), alpha.values.end());
  if (count < 64 || *least == *most) return {};  // an opaque alpha does nothing
  const double step = alpha.high > 2.0 ? 1.0 : 0.0;
  int multiplied = 0, divided = 0;
  for (const Samples& colour : channels.first(channels.size() - 1)) {
    const double top = *std::max_element(colour.values.begin(), colour.values.end());
    std::int64_t below = 0, equal = 0, clamped = 0;
    double alpha_of_clamped = 0.0, alpha_of_others = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      below += colour.values[i] <= alpha.values[i] + step;
      equal += std::abs(colour.values[i] - alpha.values[i]) <= step;
      const bool at_top = colour.values[i] == top;
      clamped += at_top;
      (at_top ? alpha_of_clamped : alpha_of_others) += alpha.values[i];
    }
    // Grey stored as colour, alpha included, is no product.
    multiplied += below == static_cast<std::int64_t>(count) && 2 * equal < static_cast<std::int64_t>(count);
    const double share = static_cast<double>(clamped) / static_cast<double>(count);
    if (share < 0.3 || share > 0.7) continue;
    const double range = alpha.high - alpha.low;
    alpha_of_clamped = (alpha_of_clamped / static_cast<double>(clamped) - alpha.low) / range;
    alpha_of_others =
        (alpha_of_others / static_cast<double>(static_cast<std::int64_t>(count) - clamped) - alpha.low) /
        range;
    // Of independent even values min(1, colour / alpha) reaches 1 in half of the pixels, where alpha is 1/3
    // in the mean, against 2/3 elsewhere.
    divided += std::abs(alpha_of_clamped - 1.0 / 3.0) < 0.08 && std::abs(alpha_of_others - 2.0 / 3.0) < 0.08;
  }
  const int colours = static_cast<int>(channels.size()) - 1;
  if (multiplied == colours) {
    return {{.cause = Cause::alpha_multiplied,
             .text = "the colours are multiplied by alpha; save with straight (unassociated) alpha"}};
  }
  if (divided == colours) {
    return {
        {.cause = Cause::alpha_divided,
         .text = "the colours are divided by alpha and clamped; save with straight (unassociated) alpha"}};
  }
  return {};
}

}  // namespace bn
