#include "retarget/anneal_instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/refuse.h"
#include "retarget/filtered_energy.h"

namespace bn::retarget {
namespace {

/// Large moves are useful while hot, near ones throughout; 5/3 of the radius was the best compromise
/// measured (docs/annealing.md).
int default_swap_distance(int radius) { return (5 * radius + 2) / 3; }

std::vector<Shift> swap_displacements(Extent slice, int depth, const RetargetOptions& options, int distance) {
  // Two seeds whose origins reach both positions are at most two radii apart.
  const int x_limit = std::min(distance, slice.width - 1), y_limit = std::min(distance, slice.height - 1),
            z_limit = std::min(distance, depth - 1);
  RetargetOptions diameter = options;
  diameter.radius = 2 * options.radius;
  std::vector<Shift> result;
  for (int x = 0; x <= x_limit; ++x) {
    for (int y = -y_limit; y <= y_limit; ++y) {
      for (int z = -z_limit; z <= z_limit; ++z) {
        if (x == 0 && (y < 0 || (y == 0 && z <= 0))) continue;
        // Along a row of the torus, x and width - x pair the same seeds; kernels count on the shorter one.
        if (y == 0 && z == 0 && options.wrap && 2 * x > slice.width) continue;
        if (!within_reach(Shift{x, y, z}, diameter)) continue;
        result.push_back({x, y, z});
      }
    }
  }
  return result;
}

/// result(q) = levels(q + offset), on the torus of the instance.
Grid<std::int32_t> shifted(const AnnealInstance& instance, const Grid<std::int32_t>& levels, Shift offset) {
  Grid<std::int32_t> result(levels.size());
  for (std::size_t q = 0; q < levels.count(); ++q) {
    const Shift at = instance.position(q);
    result[q] = levels[instance.index(std::int64_t{at.x} + offset.x, std::int64_t{at.y} + offset.y,
                                      std::int64_t{at.z} + offset.z)];
  }
  return result;
}

}  // namespace

AnnealInstance::AnnealInstance(const AnnealProblem& problem, int swap_distance_px)
    : depth(problem.depth), options(problem.retarget), residual_sigma_px(problem.residual_sigma_px) {
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
  if (depth < 1 || depth > kMaxSide || size.height % depth != 0) {
    refuse("depth", fmt::format("{} slices in {} rows", depth, size.height),
           fmt::format("1..{}, a divisor of the levels' height", kMaxSide));
  }
  slice = {size.width, size.height / depth};
  step_z = wrap(problem.step_z, depth);
  if (swap_distance_px < 0 || swap_distance_px > 2 * options.radius) {
    refuse("swap_distance", fmt::format("{} pixels", swap_distance_px),
           fmt::format("1..{}, twice the radius; 0 for the default", 2 * options.radius));
  }
  const bool filtered = residual_sigma_px != 0.0;
  if (filtered && !(residual_sigma_px >= 0.3 && residual_sigma_px <= 8.0)) {
    refuse("residual_sigma", fmt::format("{} pixels", residual_sigma_px),
           "0 for no filter, or 0.3..8 pixels");
  }
  if (filtered && depth > 1)
    refuse("residual_sigma", "a filtered residual of a volume", "only of flat tiles");
  if (filtered && options.metric != Metric::l2) {
    refuse("metric", "a filtered residual with the metric l1", "l2", "set the metric to l2");
  }
  for (const AnnealChannel& channel : problem.channels) {
    const MaskLevels masks = channel.masks();
    if (masks.size() != size) {
      refuse("channels",
             fmt::format("one of {}x{}, one of {}x{}", size.width, size.height, masks.size().width,
                         masks.size().height),
             "all of one size");
    }
    constexpr int kMaxWeight = 1000;
    if (channel.weight < 1 || channel.weight > kMaxWeight) {
      refuse("weights", fmt::format("{}", channel.weight), fmt::format("1..{}", kMaxWeight));
    }
    // Two pixels change, each between 0 and the largest cost; and the sum over channels stays in 2^62.
    const std::int64_t largest_cost = check_levels(masks, options.metric) * channel.weight;
    largest_change += 2 * largest_cost;
    if (largest_change > kMaxAnnealEnergy / std::max<std::int64_t>(2, size.area())) {
      throw Error({.code = ErrorCode::over_limit,
                   .what = "the energy could pass 2^62",
                   .where = "channels",
                   .limit = "pixels * weights * largest costs <= 2^61",
                   .remedy = "use smaller weights, or the metric l1"});
    }
    const std::int32_t least = level_range(masks).first;
    const auto above_least = [least](Grid<std::int32_t> levels) {
      for (std::int32_t& level : levels) level -= least;
      return levels;
    };
    const Shift step{wrap(options.step.x, slice.width), wrap(options.step.y, slice.height), step_z};
    seed_level.push_back(shifted(*this, above_least(masks.from), {-step.x, -step.y, -step.z}));
    landing_level.push_back(shifted(*this, above_least(masks.to), {options.motion.x, options.motion.y, 0}));
    weight.push_back(channel.weight);
  }
  const int distance = swap_distance_px == 0 ? default_swap_distance(options.radius) : swap_distance_px;
  displacements = swap_displacements(slice, depth, options, distance);
}

Placement AnnealInstance::identity() const {
  return {Grid<Offset>(size), depth > 1 ? Grid<std::int8_t>(size) : Grid<std::int8_t>()};
}

Placement AnnealInstance::moves_of(const Placement& displacement_at) const {
  Placement move = identity();
  for (std::size_t w = 0; w < displacement_at.xy.count(); ++w) {
    const Shift at = position(w), k = displacement_at.at(w);
    const std::size_t u = index(std::int64_t{at.x} - k.x - options.step.x,
                                std::int64_t{at.y} - k.y - options.step.y, at.z - k.z - step_z);
    move.set(u, {k.x + options.motion.x, k.y + options.motion.y, k.z});
  }
  return move;
}

Placement AnnealInstance::displacements_of(const Placement& move) const {
  Placement displacement_at = identity();
  for (std::size_t u = 0; u < move.xy.count(); ++u) {
    const Shift at = position(u), r = move.at(u);
    const Shift k{r.x - options.motion.x, r.y - options.motion.y, r.z};
    displacement_at.set(index(std::int64_t{at.x} + options.step.x + k.x,
                              std::int64_t{at.y} + options.step.y + k.y, at.z + step_z + k.z),
                        k);
  }
  return displacement_at;
}

void AnnealInstance::check_moves(const Placement& move) const {
  if (depth == 1) return check_permutation(move.xy, options);
  const auto fail = [&](std::size_t u, const std::string& what) {
    const Shift at = position(u), r = move.at(u);
    throw Error({.code = ErrorCode::verification_failed,
                 .what = fmt::format("moves by ({}, {}, {}), {}", r.x, r.y, r.z, what),
                 .where = fmt::format("pixel ({}, {}) of slice {}", at.x, at.y, at.z),
                 .limit = fmt::format("a bijection, radius {}, {}", options.radius,
                                      options.reach == Reach::euclidean ? "euclidean" : "chebyshev"),
                 .remedy = ""});
  };
  std::vector<bool> taken(move.xy.count(), false);
  for (std::size_t u = 0; u < move.xy.count(); ++u) {
    const Shift at = position(u), r = move.at(u);
    const Shift k{r.x - options.motion.x, r.y - options.motion.y, r.z};
    if (!within_reach(k, options)) fail(u, "out of reach");
    const int x = wrap(std::int64_t{at.x} + options.step.x, slice.width) + k.x,
              y = wrap(std::int64_t{at.y} + options.step.y, slice.height) + k.y,
              z = wrap(at.z + step_z, depth) + k.z;
    const bool inside = x >= 0 && x < slice.width && y >= 0 && y < slice.height && z >= 0 && z < depth;
    if (!options.wrap && !inside) fail(u, "across the border");
    const std::size_t to =
        index(std::int64_t{at.x} + r.x, std::int64_t{at.y} + r.y, std::int64_t{at.z} + r.z);
    if (taken[to]) fail(u, "to where another seed goes");
    taken[to] = true;
  }
}

}  // namespace bn::retarget
