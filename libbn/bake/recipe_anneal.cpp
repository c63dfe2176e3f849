// The keys of a retarget set that is annealed. What the library refuses it refuses in its own words, at the
// line of the key.

#include "bake/recipe_anneal.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "bn/error.h"

namespace bn {
namespace {

void parse_schedule_parameters(TableReader& table, ScheduleParameters& parameters) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  constexpr std::int64_t kMany = std::numeric_limits<std::int64_t>::max();
  const auto number = [&](const char* key, std::optional<double>& value) {
    if (table.has(key)) value = table.number(key, 1.0, -kAny, kAny);
  };
  const auto count = [&](const char* key, auto& value, std::int64_t most) {
    using Value = typename std::remove_reference_t<decltype(value)>::value_type;
    if (table.has(key)) value = static_cast<Value>(table.integer(key, 1, -most, most));
  };
  number("factor", parameters.factor);
  number("slope", parameters.slope);
  number("hajek_c", parameters.hajek_c);
  count("stages", parameters.stages, 1'000'000);
  count("accepted_per_stage", parameters.accepted_per_stage, kMany);
  count("tried_per_stage", parameters.tried_per_stage, kMany);
  count("frozen_stages", parameters.frozen_stages, 1'000'000);
}

void parse_channels(TableReader& table, const RetargetEntry& set, AnnealMethod& anneal) {
  constexpr std::size_t kMaxChannels = 16;
  anneal.channels = table.integers("channels", kMaxChannels, 0, 63);
  anneal.weights = table.integers("weights", kMaxChannels, 1, 1000);
  if (!anneal.channels.empty() && set.image.empty())
    table.mistake("channels", "needs an image", "only with image = \"path\"", "a mask has one channel");
  if (!anneal.channels.empty() && table.has("channel"))
    table.mistake("channels", "stands beside channel", "one of the two");
  const std::size_t count = std::max<std::size_t>(1, anneal.channels.size());
  if (!anneal.weights.empty() && anneal.weights.size() != count) {
    table.mistake("weights", fmt::format("has {} elements", anneal.weights.size()),
                  fmt::format("{}, one for each channel", count));
  }
}

}  // namespace

std::optional<AnnealMethod> parse_anneal(TableReader& table, const RetargetEntry& set) {
  const bool anneals = table.choice("method", 0, {"exact", "anneal"}) == 1;
  if (!anneals) {
    for (const char* key : {"schedule",
                            "proposals",
                            "seed",
                            "start_temperature",
                            "initial_acceptance",
                            "end_temperature",
                            "factor",
                            "slope",
                            "hajek_c",
                            "stages",
                            "accepted_per_stage",
                            "tried_per_stage",
                            "frozen_stages",
                            "chains",
                            "coupling",
                            "swap_distance",
                            "stop_after",
                            "channels",
                            "weights",
                            "residual_sigma"}) {
      if (table.has(key)) table.mistake(key, "needs annealing", "only with method = \"anneal\"");
    }
    return std::nullopt;
  }
  if (table.has("gap")) table.mistake("gap", "needs the exact solver", "only with method = \"exact\"");
  AnnealMethod anneal;
  AnnealOptions& options = anneal.options;
  std::vector<std::string> schedules;
  for (const auto name : schedule_names()) schedules.emplace_back(name);
  options.schedule = schedules[static_cast<std::size_t>(table.choice("schedule", 0, schedules))];
  parse_schedule_parameters(table, options.parameters);
  constexpr std::int64_t kMany = std::numeric_limits<std::int64_t>::max();
  options.proposals = table.integer("proposals", options.proposals, 1, std::int64_t{1} << 62);
  options.stop_after = table.integer("stop_after", 0, 0, std::int64_t{1} << 62);
  options.seed = static_cast<std::uint64_t>(table.integer("seed", 1, 0, kMany));
  constexpr double kHottest = 1e15;
  const double start = table.number("start_temperature", 0.0, 0.0, kHottest);
  const double acceptance = table.number("initial_acceptance", 0.0, 0.0, 1.0);
  options.end_temperature = table.number("end_temperature", 0.0, 0.0, kHottest);
  using Rule = StartTemperature::Rule;
  if (start > 0.0) options.start = {Rule::given, start};
  if (acceptance > 0.0) options.start = {acceptance == 1.0 ? Rule::everything : Rule::acceptance, acceptance};
  if (start > 0.0 && acceptance > 0.0) {
    table.mistake("initial_acceptance", "stands beside a start temperature", "one of the two");
  }
  if (start > 0.0 && options.end_temperature > start) {
    table.mistake("end_temperature", fmt::format("is {}, above the start", options.end_temperature),
                  fmt::format("at most {}", start));
  }
  options.chains.count = static_cast<int>(table.integer("chains", 1, 1, 256));
  options.chains.coupling =
      static_cast<ChainOptions::Coupling>(table.choice("coupling", 0, {"independent", "tempering"}));
  options.swap_distance_px = static_cast<int>(table.integer("swap_distance", 0, 0, 64));
  if (options.swap_distance_px > 2 * set.options.radius) {
    table.mistake("swap_distance", fmt::format("is {}", options.swap_distance_px),
                  fmt::format("0..{}, twice the radius", 2 * set.options.radius));
  }
  parse_channels(table, set, anneal);
  // 0 is no filter; what is above has a range of its own.
  anneal.residual_sigma_px = table.number("residual_sigma", 0.0, 0.0, 8.0);
  if (anneal.residual_sigma_px > 0.0 && anneal.residual_sigma_px < 0.3) {
    table.mistake("residual_sigma", fmt::format("is {}", anneal.residual_sigma_px), "0, or 0.3..8 pixels");
  }
  if (anneal.residual_sigma_px > 0.0 && set.options.metric != Metric::l2) {
    table.mistake("residual_sigma", "needs the squares of differences", "only with metric = \"l2\"");
  }
  // The library says what else is wrong, in the words of recipes.
  try {
    check_anneal_options(options);
  } catch (const Error& error) {
    const ErrorInfo& info = error.info();
    table.mistake(info.where, "is refused: " + info.what, info.limit, info.remedy);
  }
  return anneal;
}

}  // namespace bn
