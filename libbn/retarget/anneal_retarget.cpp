// What bn/retarget_anneal.h offers of one tile: the run in one go, the run in parts, and the budget that a
// time allows.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/refuse.h"
#include "retarget/anneal_task.h"

namespace bn {

AnnealResult anneal_retarget(const AnnealProblem& problem, const AnnealOptions& options,
                             const Execution& execution, AnnealTrace* trace) {
  check_anneal_options(options);
  thread_count(execution);
  retarget::RetargetRun run(problem, options, execution, trace);
  return run.result(run.run().to_end());
}

/// The run, and what it refers to.
struct Annealing::Held {
  AnnealOptions options;
  Execution execution;
  retarget::RetargetRun tile;
  Held(const AnnealProblem& problem, const AnnealOptions& given, const Execution& how, AnnealTrace* trace)
      : options(given), execution(how), tile(problem, options, execution, trace) {}
  anneal::Run& run() { return tile.run(); }
};

Annealing::Annealing(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution,
                     AnnealTrace* trace) {
  check_anneal_options(options);
  thread_count(execution);
  held_ = std::make_unique<Held>(problem, options, execution, trace);
}
Annealing::~Annealing() = default;

void Annealing::advance() {
  if (!held_->run().done()) held_->run().advance();
}
void Annealing::sweep() {
  if (!held_->run().done()) held_->run().sweep();
}
AnnealState Annealing::state() const { return held_->run().state(); }
std::string Annealing::checkpoint() const { return held_->run().checkpoint(); }
Grid<Offset> Annealing::move() const { return held_->tile.moves().xy; }
Grid<std::int8_t> Annealing::move_z() const { return held_->tile.moves().z; }
AnnealResult Annealing::result() const { return held_->tile.result(held_->run().result()); }
CoolingSchedule Annealing::schedule() const { return held_->run().schedule(0); }

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
      run.advance();
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
