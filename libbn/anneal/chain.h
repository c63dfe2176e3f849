// One chain of a run: its engine, its cooling, and the round it is in.
//
// A chain advances by sweeps. Some sweeps make a round, all at one temperature; only whole rounds cool the
// schedule, count, and may become the best state.

#pragma once

#include <cstdint>
#include <memory>

#include "anneal/cooling.h"
#include "anneal/engine.h"

namespace bn::anneal {

/// What all chains of a run have in common; it follows from the problem and the budget alone.
struct RoundPlan {
  int sweeps = 1;           ///< of a round
  std::int64_t cooled = 0;  ///< proposals of a chain before the last ones at temperature 0
  std::int64_t end = 0;     ///< proposals of a chain at which it is done
};

struct Chain {
  std::unique_ptr<Engine> engine;
  Cooling cooling;
  std::int64_t round = 0;
  std::int64_t proposals = 0;
  std::int64_t accepted = 0;
  std::int64_t best_energy = 0;
  WorseningCounts watched = {};
  bool watch = false;
  std::int64_t target = 0;  ///< proposals at which the slice ends
  // The round in hand: the sweeps made, what they did, and where they were made.
  int sweep = 0;
  RoundCounts counts = {};
  bool quench = false;
  double temperature = 0.0;

  bool done(const RoundPlan& plan) const { return proposals >= plan.end || cooling.frozen(); }
  bool arrived(const RoundPlan& plan) const { return sweep == 0 && (proposals >= target || done(plan)); }

  /// Makes up to `most` sweeps, not beyond the round.
  void advance(int most, const RoundPlan& plan, const Execution& execution);
};

}  // namespace bn::anneal
