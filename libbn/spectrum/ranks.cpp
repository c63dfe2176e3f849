// Ranks of values, and what follows from them: thresholds and histograms.
//
// Problem: the same mask comes as 8 bit, 16 bit or float, its values spaced differently and some
// equal; the figures should not care. Sorting 4096^2 values by comparisons would take longer than the
// transform. Method: integers in a range not much longer than the data are counted; others go through a radix
// sort of their place between the least and the greatest value, in 32 bits, and the few that share a place
// through a comparison sort. Invariant: equal values get equal ranks, their mean; the order of equal values
// decides nothing.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bn/error.h"
#include "bn/spectrum.h"
#include "spectrum/ranks.h"
#include "spectrum/transform.h"

namespace bn {
namespace spectrum {
namespace {

/// Longest table of counts for a small picture.
constexpr double kSmallRange = 65536.0;

bool all_integers(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == std::trunc(v); });
}

std::vector<double> ranks_by_counting(std::span<const double> values, double low, double high) {
  std::vector<std::uint32_t> count(static_cast<std::size_t>(high - low) + 1);
  for (const double value : values) ++count[static_cast<std::size_t>(value - low)];
  std::vector<double> rank_of(count.size());
  std::uint64_t before = 0;
  for (std::size_t level = 0; level < count.size(); ++level) {
    rank_of[level] = static_cast<double>(before) + 0.5 * (static_cast<double>(count[level]) - 1.0);
    before += count[level];
  }
  std::vector<double> rank(values.size());
  for (std::size_t i = 0; i < rank.size(); ++i) rank[i] = rank_of[static_cast<std::size_t>(values[i] - low)];
  return rank;
}

/// A value's place among low..high in 32 bits, and where it stands.
struct Placed {
  std::uint32_t place;
  std::uint32_t index;
};

/// Indices of the values in ascending order.
std::vector<Placed> sorted(std::span<const double> values, double low, double high) {
  constexpr int kDigitBits = 11, kPasses = 3;
  constexpr std::uint32_t kDigits = 1u << kDigitBits;
  constexpr double kLastPlace = 4294967295.0;
  // Halves, because high - low may be above the largest double. Each step keeps the order, so places
  // never contradict values; a range too small for the scale leaves all in one place.
  const double scale = std::min(kLastPlace / (0.5 * high - 0.5 * low), std::numeric_limits<double>::max());
  std::vector<Placed> from(values.size()), to(values.size());
  std::array<std::array<std::uint32_t, kDigits>, kPasses> start{};
  const auto digit = [](std::uint32_t place, int pass) { return (place >> (pass * kDigitBits)) % kDigits; };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double place = std::min((0.5 * values[i] - 0.5 * low) * scale, kLastPlace);
    from[i] = {static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(i)};
    for (int pass = 0; pass < kPasses; ++pass) ++start[pass][digit(from[i].place, pass)];
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    std::uint32_t before = 0;
    for (std::uint32_t& at : start[pass]) before += std::exchange(at, before);
    for (const Placed& entry : from) to[start[pass][digit(entry.place, pass)]++] = entry;
    from.swap(to);
  }
  return from;
}

std::vector<double> ranks_by_sorting(std::span<const double> values, double low, double high) {
  std::vector<Placed> order = sorted(values, low, high);
  std::vector<double> rank(values.size());
  const auto value = [&](std::size_t i) { return values[order[i].index]; };
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first + 1;
    while (last < order.size() && order[last].place == order[first].place) ++last;
    if (last == first + 1) {
      rank[order[first].index] = static_cast<double>(first);
      first = last;
      continue;
    }
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(first),
              order.begin() + static_cast<std::ptrdiff_t>(last),
              [&](const Placed& a, const Placed& b) { return values[a.index] < values[b.index]; });
    while (first < last) {
      std::size_t end = first + 1;
      while (end < last && value(end) == value(first)) ++end;
      const double mean = 0.5 * static_cast<double>(first + end - 1);
      for (; first < end; ++first) rank[order[first].index] = mean;
    }
  }
  return rank;
}

}  // namespace

bool is_permutation_of_a_range(std::span<const double> values) {
  if (values.empty()) return true;
  const double low = *std::min_element(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  std::vector<bool> seen(values.size());
  for (const double value : values) {
    const double at = value - low;
    if (!(at < n)) return false;
    const auto index = static_cast<std::size_t>(at);
    if (static_cast<double>(index) != at || seen[index]) return false;
    seen[index] = true;
  }
  return true;
}

}  // namespace spectrum

using namespace spectrum;

std::vector<double> midranks(std::span<const double> values, const Execution& execution) {
  const auto count = static_cast<std::int64_t>(values.size());
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = fmt::format("{} values to rank", count),
                 .where = "ranks",
                 .limit = "below 2^32",
                 .remedy = "analyse a part"});
  }
  if (values.empty()) return {};
  check_finite(values, {static_cast<int>(std::min<std::int64_t>(count, kMaxSpectrumSide)), 1, 1}, "ranks",
               execution);
  check_memory(execution, static_cast<std::uint64_t>(count) * (2 * sizeof(Placed) + sizeof(double)), "ranks");
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double range = *high - *low + 1.0;
  if (range <= std::max(kSmallRange, 4.0 * static_cast<double>(count)) && all_integers(values)) {
    return ranks_by_counting(values, *low, *high);
  }
  return ranks_by_sorting(values, *low, *high);
}

std::vector<double> thresholded(std::span<const double> values, double level, const Execution& execution) {
  if (!(level > 0.0 && level < 1.0)) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("grey level {}", level),
                 .where = "threshold",
                 .limit = "above 0, below 1",
                 .remedy = ""});
  }
  std::vector<double> picture = midranks(values, execution);
  const double limit = level * static_cast<double>(values.size());
  for (double& value : picture) value = value + 0.5 < limit ? 1.0 : 0.0;
  return picture;
}

std::vector<std::int64_t> histogram(std::span<const double> values, double low, double high, int bins) {
  if (!(std::isfinite(low) && std::isfinite(high) && low < high) || bins < 1) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("{} bins over {}..{}", bins, low, high),
                 .where = "histogram",
                 .limit = "at least one bin over a range that is not empty",
                 .remedy = ""});
  }
  std::vector<std::int64_t> counts(static_cast<std::size_t>(bins));
  const double scale = bins / (high - low);
  for (const double value : values) {
    // A NaN lands in the first bin; callers that must not see one have checked.
    const double at = std::min((value - low) * scale, bins - 1.0);
    ++counts[at > 0.0 ? static_cast<std::size_t>(at) : 0];
  }
  return counts;
}

double histogram_max_deviation(std::span<const std::int64_t> counts) {
  std::int64_t total = 0;
  for (const std::int64_t count : counts) total += count;
  if (total == 0) return 0.0;
  const double expected = static_cast<double>(total) / static_cast<double>(counts.size());
  double deviation = 0.0;
  for (const std::int64_t count : counts) {
    deviation = std::max(deviation, std::abs(static_cast<double>(count) / expected - 1.0));
  }
  return deviation;
}

}  // namespace bn
