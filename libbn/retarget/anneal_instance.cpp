#include "retarget/anneal_instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "retarget/filtered_energy.h"
#include "retarget/refuse.h"

namespace bn {
namespace {

/// Large moves are useful while hot, near ones throughout; 5/3 of the radius was the best compromise
/// measured (docs/annealing.md).
int default_swap_distance(int radius) { return (5 * radius + 2) / 3; }

std::vector<Offset> swap_displacements(Extent size, const RetargetOptions& options, int distance) {
  // Two seeds whose origins reach both positions are at most two radii apart.
  const int x_limit = std::min(distance, size.width - 1), y_limit = std::min(distance, size.height - 1);
  const int diameter = 2 * options.radius;
  std::vector<Offset> result;
  for (int x = 0; x <= x_limit; ++x) {
    for (int y = -y_limit; y <= y_limit; ++y) {
      if (x == 0 && y <= 0) continue;
      // Along a row of the torus, x and width - x pair the same seeds; kernels count on the shorter one.
      if (y == 0 && options.wrap && 2 * x > size.width) continue;
      if (options.reach == Reach::euclidean && x * x + y * y > diameter * diameter) continue;
      result.push_back({x, y});
    }
  }
  return result;
}

}  // namespace

AnnealInstance::AnnealInstance(const AnnealProblem& problem, int swap_distance_px)
    : options(problem.retarget), residual_sigma_px(problem.residual_sigma_px) {
  check_options(options);
  constexpr std::size_t kMaxChannels = 16;
  if (problem.channels.empty() || problem.channels.size() > kMaxChannels) {
    refuse("channels", fmt::format("{} channels", problem.channels.size()),
           fmt::format("1..{}", kMaxChannels));
  }
  size = problem.channels.front().levels.size();
  constexpr int kMaxSide = 16384;
  if (size.width > kMaxSide || size.height > kMaxSide) {
    refuse("size", fmt::format("{}x{}", size.width, size.height),
           fmt::format("sides of 1..{} pixels", kMaxSide));
  }
  if (swap_distance_px < 0 || swap_distance_px > 2 * options.radius) {
    refuse("swap_distance", fmt::format("{} pixels", swap_distance_px),
           fmt::format("1..{}, twice the radius; 0 for the default", 2 * options.radius));
  }
  const bool filtered = residual_sigma_px != 0.0;
  if (filtered && !(residual_sigma_px >= 0.3 && residual_sigma_px <= 8.0)) {
    refuse("residual_sigma", fmt::format("{} pixels", residual_sigma_px),
           "0 for no filter, or 0.3..8 pixels");
  }
  if (filtered && options.metric != Metric::l2) {
    refuse("metric", "a filtered residual with the metric l1", "l2", "set the metric to l2");
  }
  for (const AnnealChannel& channel : problem.channels) {
    if (channel.levels.size() != size) {
      refuse("channels",
             fmt::format("one of {}x{}, one of {}x{}", size.width, size.height, channel.levels.width(),
                         channel.levels.height()),
             "all of one size");
    }
    constexpr int kMaxWeight = 1000;
    if (channel.weight < 1 || channel.weight > kMaxWeight) {
      refuse("weights", fmt::format("{}", channel.weight), fmt::format("1..{}", kMaxWeight));
    }
    // Two pixels change, each between 0 and the largest cost; and the sum over channels stays in 2^62.
    const std::int64_t largest_cost = check_levels(channel.levels, options.metric) * channel.weight;
    largest_change += 2 * largest_cost;
    if (largest_change > kMaxAnnealEnergy / std::max<std::int64_t>(2, size.area())) {
      throw Error({.code = ErrorCode::over_limit,
                   .what = "the energy could pass 2^62",
                   .where = "channels",
                   .limit = "pixels * weights * largest costs <= 2^61",
                   .remedy = "use smaller weights, or the metric l1"});
    }
    Grid<std::int32_t> levels = channel.levels;
    const std::int32_t least = *std::min_element(levels.begin(), levels.end());
    for (std::int32_t& level : levels) level -= least;
    seed_level.push_back(shifted(levels, -std::int64_t{options.step.x}, -std::int64_t{options.step.y}));
    landing_level.push_back(shifted(levels, options.motion.x, options.motion.y));
    weight.push_back(channel.weight);
  }
  const int distance = swap_distance_px == 0 ? default_swap_distance(options.radius) : swap_distance_px;
  displacements = swap_displacements(size, options, distance);
}

Grid<Offset> AnnealInstance::moves_of(const Grid<Offset>& displacement_at) const {
  Grid<Offset> move(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Offset k = displacement_at(x, y);
      move(wrap(std::int64_t{x} - k.x - options.step.x, size.width),
           wrap(std::int64_t{y} - k.y - options.step.y, size.height)) = {k.x + options.motion.x,
                                                                         k.y + options.motion.y};
    }
  }
  return move;
}

Grid<Offset> AnnealInstance::displacements_of(const Grid<Offset>& move) const {
  Grid<Offset> displacement_at(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Offset k{move(x, y).x - options.motion.x, move(x, y).y - options.motion.y};
      displacement_at(wrap(std::int64_t{x} + options.step.x + k.x, size.width),
                      wrap(std::int64_t{y} + options.step.y + k.y, size.height)) = k;
    }
  }
  return displacement_at;
}

}  // namespace bn
