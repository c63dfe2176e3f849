#include "retarget/anneal_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/refuse.h"
#include "core/reproducible_math.h"
#include "retarget/anneal_engine.h"

namespace bn {
namespace retarget {
namespace {

/// By bisection of the exponent; IEEE operations in a written order give the same bits everywhere.
double temperature_for_acceptance(const AnnealInstance& instance, double wanted) {
  const std::vector<std::int64_t> rises = sample_rises(instance);
  if (rises.empty()) return 1.0;  // nothing to accept
  const auto share_at = [&](double temperature) {
    double sum = 0.0;
    for (const std::int64_t rise : rises) sum += reproducible_exp(-static_cast<double>(rise) / temperature);
    return sum / static_cast<double>(rises.size());
  };
  double low = 0x1p-10, high = 0x1p62;
  for (int i = 0; i < 24; ++i) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (share_at(middle) < wanted ? low : high) = middle;
  }
  return high;
}

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

/// The least cost above 0 of a pixel: of the two nearest levels of a channel. 1 if all are constant.
std::int64_t finest_cost(const AnnealInstance& instance) {
  std::int64_t finest = kMaxAnnealEnergy;
  for (std::size_t c = 0; c < instance.weight.size(); ++c) {
    const Grid<std::int32_t>& levels = instance.seed_level[c];
    std::vector<bool> present(static_cast<std::size_t>(*std::max_element(levels.begin(), levels.end())) + 1);
    for (const std::int32_t level : levels) present[static_cast<std::size_t>(level)] = true;
    std::int32_t below = 0;  // the least level of each channel
    for (std::int32_t level = 1; level < static_cast<std::int32_t>(present.size()); ++level) {
      if (!present[static_cast<std::size_t>(level)]) continue;
      finest = std::min(finest, instance.weight[c] * level_cost(level, below, instance.options.metric));
      below = level;
    }
  }
  return finest == kMaxAnnealEnergy ? 1 : finest;
}

TemperatureRange automatic_range(const AnnealInstance& instance) {
  if (instance.residual_sigma_px > 0.0) {
    const double start = temperature_for_acceptance(instance, 0.2);
    return {start, start / 4000.0};
  }
  const double scale = std::max(mean_least_cost(instance), 0.1 * static_cast<double>(finest_cost(instance)));
  return {6.0 * scale, 0.9 * scale};
}

}  // namespace

CoolingSchedule schedule_of(const AnnealOptions& options, const TemperatureRange& range,
                            std::int64_t proposals) {
  if (options.custom) return *options.custom;
  return make_schedule(options.schedule, range.start, range.end, proposals, options.parameters);
}

TemperatureRange temperatures_of(const AnnealInstance& instance, const AnnealOptions& options) {
  using Rule = StartTemperature::Rule;
  const bool automatic_start = options.start.rule == Rule::automatic,
             automatic_end = options.end_temperature == 0.0;
  TemperatureRange range;
  if (automatic_start || automatic_end) range = automatic_range(instance);
  if (options.start.rule == Rule::given) range.start = options.start.value;
  if (options.start.rule == Rule::acceptance)
    range.start = temperature_for_acceptance(instance, options.start.value);
  if (options.start.rule == Rule::everything) {
    if (instance.residual_sigma_px > 0.0) {
      refuse("start_temperature", "accept everything with a filtered residual",
             "automatic, given or an acceptance");
    }
    // A swap changes two costs.
    range.start = static_cast<double>(std::max<std::int64_t>(1, instance.largest_change));
  }
  if (!automatic_end) range.end = options.end_temperature;
  if (range.end > range.start) {
    if (automatic_end) {
      range.end = range.start;
    } else if (automatic_start) {
      range.start = range.end;
    } else {
      refuse("end_temperature", fmt::format("{}", range.end),
             fmt::format("at most {}, the start temperature", range.start));
    }
  }
  return range;
}

}  // namespace retarget

using namespace retarget;

TemperatureRange automatic_temperatures(const AnnealProblem& problem) {
  return automatic_range(AnnealInstance(problem, 0));
}

std::int64_t proposals_for(double seconds, const AnnealProblem& problem, const AnnealOptions& options,
                           const Execution& execution) {
  if (!(seconds > 0.0 && seconds <= 1e6))
    refuse("budget", fmt::format("{} s", seconds), "above 0, at most 1e6 s");
  AnnealOptions trial = options;
  trial.checkpoint = {};
  trial.stop_after = 0;
  const Execution inside{.threads = execution.threads,
                         .stop = execution.stop,
                         .memory_limit_bytes = execution.memory_limit_bytes};
  trial.proposals = 1 << 14;
  while (true) {
    const auto start = std::chrono::steady_clock::now();
    Annealing run(problem, trial, inside);
    while (!run.state().done) {
      throw_if_stopped(inside);
      run.beat();
    }
    const double made_s = std::max(1e-6, run.state().seconds);
    // What comes before the first proposal, an automatic temperature above all, comes once whatever the
    // budget.
    const double before_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() - run.state().seconds;
    const double left_s = std::max(0.1 * seconds, seconds - before_s);
    constexpr std::int64_t kMost = std::int64_t{1} << 50;
    if (made_s >= left_s / 40.0 || trial.proposals >= kMost) {
      return std::max<std::int64_t>(
          1, static_cast<std::int64_t>(static_cast<double>(trial.proposals) * (left_s / made_s)));
    }
    // Four times as long next, or what just reaches a fortieth.
    trial.proposals *= static_cast<std::int64_t>(std::clamp(left_s / 40.0 / made_s, 2.0, 8.0));
  }
}

}  // namespace bn
