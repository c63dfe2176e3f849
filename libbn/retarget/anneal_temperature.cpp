#include "retarget/anneal_temperature.h"

#include <algorithm>

#include "retarget/anneal_engine.h"

namespace bn {
namespace retarget {
namespace {

/// The mean over pixels (at most 1024 of them, evenly spread) of the least cost a seed could have there.
double mean_least_cost(const AnnealInstance& instance) {
  const auto window = reach_rows(instance.slice, instance.options);
  const auto deep = std::min(instance.depth - 1, instance.options.radius);
  const std::int64_t pixels = instance.size.area(), samples = std::min<std::int64_t>(pixels, 1024);
  std::int64_t sum = 0;
  for (std::int64_t i = 0; i < samples; ++i) {
    const std::int64_t w = pixels * i / samples;
    std::int64_t least = kMaxAnnealEnergy;
    const Shift at = instance.position(static_cast<std::size_t>(w));
    for (int z = -deep; z <= deep; ++z) {
      for (const ReachRow& row : window) {
        for (int x = row.x_low; x <= row.x_high; ++x) {
          if (!within_reach(Shift{x, row.y, z}, instance.options)) continue;
          const std::size_t from = instance.index(at.x - x, at.y - row.y, at.z - z);
          std::int64_t cost = 0;
          for (std::size_t c = 0; c < instance.weight.size(); ++c) {
            cost += instance.weight[c] * level_cost(instance.seed_level[c][from],
                                                    instance.landing_level[c][static_cast<std::size_t>(w)],
                                                    instance.options.metric);
          }
          least = std::min(least, cost);
        }
      }
    }
    sum += least;
  }
  return static_cast<double>(sum) / static_cast<double>(samples);
}

/// The least cost above 0 of a pixel: of the two nearest levels, one that leaves and one that lands, of a
/// channel. 1 if all are equal.
std::int64_t finest_cost(const AnnealInstance& instance) {
  constexpr std::uint8_t kLeaves = 1, kLands = 2;
  std::int64_t finest = kMaxAnnealEnergy;
  for (std::size_t c = 0; c < instance.weight.size(); ++c) {
    const auto [least, most] = level_range({instance.seed_level[c], instance.landing_level[c]});
    std::vector<std::uint8_t> present(static_cast<std::size_t>(most) + 1, 0);
    for (const std::int32_t level : instance.seed_level[c])
      present[static_cast<std::size_t>(level)] |= kLeaves;
    for (const std::int32_t level : instance.landing_level[c])
      present[static_cast<std::size_t>(level)] |= kLands;
    std::int32_t leaving = -1, landing = -1;  // the nearest ones below
    for (std::int32_t level = least; level <= most; ++level) {
      const std::uint8_t here = present[static_cast<std::size_t>(level)];
      const auto compare = [&](std::int32_t below) {
        if (below < 0) return;
        finest = std::min(finest, instance.weight[c] * level_cost(level, below, instance.options.metric));
      };
      if (here & kLeaves) compare(landing);
      if (here & kLands) compare(leaving);
      if (here & kLeaves) leaving = level;
      if (here & kLands) landing = level;
    }
  }
  return finest == kMaxAnnealEnergy ? 1 : finest;
}

TemperatureRange automatic_range(const AnnealInstance& instance) {
  if (instance.residual_sigma_px > 0.0) {
    const double start = anneal::temperature_for_acceptance(sample_rises(instance), 0.2);
    return {start, start / 4000.0};
  }
  const double scale = std::max(mean_least_cost(instance), 0.1 * static_cast<double>(finest_cost(instance)));
  return {6.0 * scale, 0.9 * scale};
}

}  // namespace

anneal::TemperatureSource temperature_source(const AnnealInstance& instance) {
  // A swap changes two costs.
  const bool residual = instance.residual_sigma_px > 0.0;
  return {.automatic = [&] { return automatic_range(instance); },
          .rises = [&] { return sample_rises(instance); },
          .largest_change = residual ? 0 : std::max<std::int64_t>(1, instance.largest_change)};
}

}  // namespace retarget

using namespace retarget;

TemperatureRange automatic_temperatures(const AnnealProblem& problem) {
  return automatic_range(AnnealInstance(problem, 0));
}

}  // namespace bn
