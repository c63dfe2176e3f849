// What options of an annealing are out of range whatever the problem. It stands apart from the driver, so
// that a program that only reads recipes links no driver.

#include <fmt/format.h>

#include <cmath>

#include "bn/anneal.h"
#include "core/refuse.h"

namespace bn {

void check_anneal_options(const AnnealOptions& options) {
  const bool tempering = options.chains.coupling == ChainOptions::Coupling::tempering;
  constexpr int kMaxChains = 256;
  const int least = tempering ? 2 : 1;
  if (options.chains.count < least || options.chains.count > kMaxChains) {
    refuse("chains", fmt::format("{}", options.chains.count), fmt::format("{}..{}", least, kMaxChains));
  }
  if (options.proposals < 1 || options.proposals > (std::int64_t{1} << 62)) {
    refuse("proposals", fmt::format("a budget of {}", options.proposals), "1..2^62 proposals");
  }
  if (options.stop_after < 0 || options.stop_after > options.proposals) {
    refuse("stop_after", fmt::format("{}", options.stop_after),
           fmt::format("0..{}, the proposals; 0 for all of them", options.proposals));
  }
  if (options.start.rule == StartTemperature::Rule::acceptance &&
      !(options.start.value >= 0.001 && options.start.value <= 0.999)) {
    refuse("initial_acceptance", fmt::format("{}", options.start.value), "0.001..0.999");
  }
  if (options.start.rule == StartTemperature::Rule::given &&
      !(options.start.value > 0.0 && std::isfinite(options.start.value))) {
    refuse("start_temperature", fmt::format("{}", options.start.value), "above 0, finite");
  }
  if (!(options.end_temperature >= 0.0 && std::isfinite(options.end_temperature))) {
    refuse("end_temperature", fmt::format("{}", options.end_temperature),
           "above 0, at most the start; 0 for automatic");
  }
  if (!(options.checkpoint.interval_s >= 0.0 && options.checkpoint.interval_s <= 3600.0)) {
    refuse("checkpoint interval", fmt::format("{} s", options.checkpoint.interval_s), "0..3600 s");
  }
  make_schedule(options.schedule, 1.0, 1.0, 1, options.parameters);  // for names and parameters
  const bool decided = options.schedule != "kirkpatrick" && options.parameters.factor;
  if ((decided || options.parameters.hajek_c) && options.end_temperature > 0.0) {
    refuse("end_temperature",
           fmt::format("{} beside {}", options.end_temperature, decided ? "a factor" : "Hajek's constant"),
           "one of the two, as each decides where the schedule ends");
  }
}

}  // namespace bn
