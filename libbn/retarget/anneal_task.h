// A retarget problem as a task for the driver of annealings (anneal/run.h).

#pragma once

#include "anneal/run.h"
#include "retarget/anneal_engine.h"

namespace bn::retarget {

/// Over everything that a run's bytes depend on: the levels, the problem's and the run's options.
std::uint64_t fingerprint_of(const AnnealProblem& problem, const AnnealOptions& options);

/// One annealing of a retarget tile: the instance and the run that refers to it.
class RetargetRun {
 public:
  /// Throws what anneal_retarget() does. `options`, `execution` and `trace` must outlive the object.
  RetargetRun(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution,
              AnnealTrace* trace);
  RetargetRun(const RetargetRun&) = delete;
  RetargetRun& operator=(const RetargetRun&) = delete;

  anneal::Run& run() { return run_; }
  const anneal::Run& run() const { return run_; }
  /// Moves of the traced chain, now.
  Placement moves() const;
  /// What the run's result stands for, checked.
  AnnealResult result(const anneal::RunResult& made) const;

 private:
  AnnealInstance instance_;
  anneal::Run run_;
};

}  // namespace bn::retarget
