// The driver of an annealing: chains advance in slices; between slices they meet, exchange states, write the
// trace and take checkpoints. One driver serves one chain, independent restarts and parallel tempering, of
// any state that an Engine can hold.
//
// Units of time, each inside the next: a proposal; a sweep, about half as many proposals as the state has
// elements; a round, some sweeps at one temperature; a slice, some rounds, a 512th of the budget; the run.
// Their lengths depend on the problem and the budget alone. Whatever threads, clocks and readers do, each
// chain makes the same rounds in the same order.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "anneal/chain.h"
#include "anneal/tempering.h"
#include "anneal/trace_recorder.h"
#include "bn/execution.h"

namespace bn::anneal {

/// What is annealed.
struct Task {
  /// Makes the engine of a chain, in the state that runs start from. Engines are made once each.
  std::function<std::unique_ptr<Engine>(std::uint32_t chain)> make_engine;
  TemperatureRange temperatures;
  std::int64_t proposals_per_sweep = 1;  ///< about; decides the lengths of rounds and slices
  bool slow = false;   ///< a proposal takes microseconds, not nanoseconds: slices are shorter
  bool inert = false;  ///< no proposal can change the state: the run is over before it begins
  /// Of all that the result depends on; a checkpoint of another one is refused.
  std::uint64_t fingerprint = 0;
};

/// What came out, of the best state of all chains.
struct RunResult {
  std::string state;  ///< as Engine::save_kept() gives it
  std::int64_t start_energy = 0;
  std::int64_t energy = 0;
  std::int64_t proposals = 0;  ///< made, by all chains
  std::int64_t accepted = 0;
  TemperatureRange temperatures;
  bool frozen = false;  ///< the schedule ended the run before the budget did
};

class Run {
 public:
  /// `options` are in range (check_anneal_options()). Goes on from options.checkpoint.resume if there is one.
  /// `options`, `execution` and `trace`, which may be null, must outlive the run.
  Run(const Task& task, const AnnealOptions& options, const Execution& execution, AnnealTrace* trace);

  /// Advances to the end; reports progress, saves checkpoints, and throws cancelled when a stop is requested.
  RunResult to_end();

  bool done() const;
  /// Goes on to the end of the slice.
  void advance();
  /// Makes one sweep of each chain that has not come to the end of the slice, watched.
  void sweep();

  AnnealState state() const;
  /// The traced chain, the first.
  const Engine& engine() const { return *chains_.front().engine; }
  /// Of a chain. Chains of tempering hold the temperature of their place on the ladder.
  CoolingSchedule schedule(int chain) const;
  /// Throws invalid_input in the middle of a slice.
  std::string checkpoint() const;
  RunResult result() const;

 private:
  bool tempering() const { return options_.chains.coupling == ChainOptions::Coupling::tempering; }
  TemperatureLadder ladder() const { return {task_.temperatures, options_.chains.count}; }
  TemperatureRange temperatures() const;
  std::int64_t best_energy() const;
  void begin_slice();
  void end_slice();
  void record_trace();
  void save() const;
  void resume();

  Task task_;
  const AnnealOptions& options_;
  const Execution& execution_;
  RoundPlan plan_;
  std::int64_t slice_proposals_ = 1;
  TraceRecorder trace_;
  std::vector<Chain> chains_;
  std::int64_t start_energy_ = 0;
  std::int64_t slices_ = 0;
  bool in_slice_ = false;
  double seconds_ = 0.0;  ///< spent annealing
};

}  // namespace bn::anneal
