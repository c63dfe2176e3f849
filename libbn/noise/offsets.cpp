#include "bn/offsets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/refuse.h"

namespace bn {
namespace {

void check_range(const char* where, std::int64_t value, std::int64_t most) {
  if (value < 1 || value > most) refuse(where, fmt::format("{}", value), fmt::format("1..{}", most));
}

/// The distance around a torus of side `side`.
std::int64_t around(std::int64_t d, std::int64_t side) { return std::min(d, side - d); }

/// The least squared distance of lattice points i (1, a) / count, i = 1.., from the origin, in units of a
/// pixel's count-th part.
std::int64_t least_distance(int count, int a, Extent size) {
  std::int64_t least = INT64_MAX;
  for (std::int64_t i = 1; i < count; ++i) {
    const std::int64_t x = around(i * size.width, std::int64_t{count} * size.width);
    const std::int64_t y = around(i * a % count * size.height, std::int64_t{count} * size.height);
    least = std::min(least, x * x + y * y);
  }
  return least;
}

}  // namespace

std::vector<Offset> sample_shifts(int count, Extent size) {
  constexpr int kMaxCount = 4096, kMaxSide = 16384;
  check_range("count", count, kMaxCount);
  check_range("size", size.width, kMaxSide);
  check_range("size", size.height, kMaxSide);
  int best = 1;
  std::int64_t farthest = -1;
  for (int a = 1; a < count; ++a) {
    if (const std::int64_t distance = least_distance(count, a, size); distance > farthest) {
      farthest = distance;
      best = a;
    }
  }
  std::vector<Offset> shifts;
  for (std::int64_t i = 0; i < count; ++i) {
    shifts.push_back(
        {static_cast<int>(i * size.width / count), static_cast<int>(i * best % count * size.height / count)});
  }
  return shifts;
}

int coprime_depth(int depth, int period) {
  constexpr int kMost = 65536;
  check_range("depth", depth, kMost);
  check_range("period", period, kMost);
  while (std::gcd(depth, period) > 1) --depth;
  return depth;
}

Grid<std::uint8_t> sampled_pixels(const Grid<std::uint32_t>& ranks, const Grid<float>& importance,
                                  std::uint32_t frame) {
  if (std::any_of(importance.begin(), importance.end(), [](float share) { return std::isnan(share); })) {
    refuse("importance", "a map with values that are no numbers", "0..1");
  }
  const Shape shape = ranks.shape();
  const Offset shift = cycle_shift(frame, shape);
  const auto slice = static_cast<int>(frame % static_cast<std::uint32_t>(shape.depth));
  const auto levels = static_cast<double>(shape.slice().area());
  const std::span<const std::uint32_t> in_slice = ranks.slice(slice);
  Grid<std::uint8_t> sampled(Extent{importance.width(), importance.height()});
  for (int y = 0; y < importance.height(); ++y) {
    const std::int64_t row = std::int64_t{wrap(y + shift.y, shape.height)} * shape.width;
    for (int x = 0; x < importance.width(); ++x) {
      const std::uint32_t rank = in_slice[static_cast<std::size_t>(row + wrap(x + shift.x, shape.width))];
      sampled(x, y) = rank + 0.5 < levels * importance(x, y);
    }
  }
  return sampled;
}

std::int64_t distinct_pixels(const Grid<std::uint32_t>& ranks, const Grid<float>& importance,
                             std::uint32_t frames) {
  Grid<std::uint8_t> visited(Extent{importance.width(), importance.height()});
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    const Grid<std::uint8_t> sampled = sampled_pixels(ranks, importance, frame);
    std::transform(visited.begin(), visited.end(), sampled.begin(), visited.begin(),
                   [](std::uint8_t a, std::uint8_t b) { return a | b; });
  }
  return std::count(visited.begin(), visited.end(), 1);
}

}  // namespace bn
