#include "anneal/chain.h"

#include <algorithm>
#include <utility>

namespace bn::anneal {

void Chain::advance(int most, const RoundPlan& plan, const Execution& execution) {
  if (sweep == 0) {
    quench = proposals >= plan.cooled;
    temperature = quench ? 0.0 : cooling.temperature();
  }
  const int end = std::min(plan.sweeps, sweep + most);
  WorseningCounts* worsenings = std::exchange(watch, false) ? &watched : nullptr;
  counts += engine->sweeps(round, sweep, end, temperature, execution, worsenings);
  sweep = end;
  if (end < plan.sweeps) return;

  const RoundCounts made = std::exchange(counts, {});
  sweep = 0;
  ++round;
  proposals += made.proposals;
  accepted += made.accepted;
  if (!quench) cooling.advance(made.proposals, made.accepted, made.changed);
  if (engine->energy() >= best_energy) return;
  best_energy = engine->energy();
  engine->keep();
}

}  // namespace bn::anneal
