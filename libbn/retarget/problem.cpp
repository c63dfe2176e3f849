#include "retarget/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/refuse.h"

namespace bn::retarget {
namespace {

constexpr int kMaxRadius = 32;
constexpr int kMaxMove = 127;
constexpr std::int32_t kMaxLevel = (1 << 24) - 1;
constexpr std::int64_t kMaxEnergy = std::int64_t{1} << 62;

}  // namespace

void check_options(const RetargetOptions& options) {
  if (options.radius < 1 || options.radius > kMaxRadius) {
    refuse("radius", fmt::format("radius {}", options.radius), fmt::format("1..{} pixels", kMaxRadius));
  }
  const int reachable = kMaxMove - options.radius;
  for (const int m : {options.motion.x, options.motion.y}) {
    if (m < -reachable || m > reachable) {
      refuse(
          "motion",
          fmt::format("motion ({}, {}) with radius {}", options.motion.x, options.motion.y, options.radius),
          fmt::format("-{0}..{0} on each axis, so that |motion| + radius <= {1}", reachable, kMaxMove),
          "a move is stored in 8 bits; use a smaller motion or radius");
    }
  }
  if (options.reach != Reach::chebyshev && options.reach != Reach::euclidean) {
    refuse("reach", "unknown reach", "chebyshev or euclidean");
  }
  if (options.metric != Metric::l1 && options.metric != Metric::l2)
    refuse("metric", "unknown metric", "l1 or l2");
  if (!(options.gap >= 0.0 && options.gap < 1.0)) {
    refuse("gap", fmt::format("gap {}", options.gap), "0 <= gap < 1; 0.005 means half a percent");
  }
}

std::pair<std::int32_t, std::int32_t> level_range(const MaskLevels& levels) {
  const auto [from_low, from_high] = std::minmax_element(levels.from.begin(), levels.from.end());
  const auto [to_low, to_high] = std::minmax_element(levels.to.begin(), levels.to.end());
  return {std::min(*from_low, *to_low), std::max(*from_high, *to_high)};
}

std::int64_t check_levels(const MaskLevels& levels, Metric metric) {
  if (levels.from.count() == 0) refuse("levels", "the image has no pixels", "at least 1x1");
  if (levels.from.size() != levels.to.size()) {
    refuse("levels",
           fmt::format("a mask of {}x{} and one of {}x{}", levels.from.width(), levels.from.height(),
                       levels.to.width(), levels.to.height()),
           "both of one size");
  }
  for (const Grid<std::int32_t>* grid : {&levels.from, &levels.to}) {
    const auto [low, high] = std::minmax_element(grid->begin(), grid->end());
    for (const auto* extreme : {&*low, &*high}) {
      if (*extreme >= 0 && *extreme <= kMaxLevel) continue;
      const auto at = static_cast<std::int64_t>(extreme - grid->data());
      refuse("levels",
             fmt::format("level {} at pixel ({}, {})", *extreme, at % grid->width(), at / grid->width()),
             fmt::format("0..{}", kMaxLevel));
    }
  }
  const auto [low, high] = level_range(levels);
  const std::int64_t largest = level_cost(low, high, metric);
  if (largest > kMaxEnergy / levels.size().area()) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = fmt::format("{} pixels at up to {} each: the energy could pass 2^62",
                                     levels.size().area(), largest),
                 .where = "levels",
                 .limit = "pixels * largest cost <= 2^62",
                 .remedy = "use fewer levels, or the metric l1"});
  }
  return largest;
}

std::vector<ReachRow> reach_rows(Extent size, const RetargetOptions& options) {
  // The representatives that wrap_centred() gives are each axis's nearest; without wrap a pixel of the
  // far border is its own.
  const int x_low = options.wrap ? -(size.width / 2) : 1 - size.width;
  const int x_high = options.wrap ? (size.width - 1) / 2 : size.width - 1;
  const int y_low = options.wrap ? -(size.height / 2) : 1 - size.height;
  const int y_high = options.wrap ? (size.height - 1) / 2 : size.height - 1;
  std::vector<ReachRow> rows;
  for (int y = std::max(y_low, -options.radius); y <= std::min(y_high, options.radius); ++y) {
    int half = options.radius;
    while (!within_reach({half, y}, options)) --half;
    rows.push_back({y, std::max(x_low, -half), std::min(x_high, half)});
  }
  return rows;
}

std::uint64_t exact_memory_bytes(Extent size, const RetargetOptions& options) {
  const auto padded = [&](int length) {
    const std::int64_t border =
        std::min<std::int64_t>(options.radius, options.wrap ? (length + 1) / 2 : length - 1);
    return static_cast<std::uint64_t>(length + 2 * border);
  };
  return padded(size.width) * padded(size.height) * 64;
}

Grid<std::int32_t> shifted(const Grid<std::int32_t>& levels, std::int64_t x, std::int64_t y) {
  const auto [width, height] = levels.size();
  Grid<std::int32_t> result(levels.size());
  for (int to_y = 0; to_y < height; ++to_y) {
    for (int to_x = 0; to_x < width; ++to_x) result(to_x, to_y) = levels.torus(to_x + x, to_y + y);
  }
  return result;
}

}  // namespace bn::retarget
