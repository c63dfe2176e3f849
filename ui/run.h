// One annealing run in a thread of its own: started, paused, stepped and stopped from a window that never
// waits for it.
//
// clang-format off
//   window      --start, pause, sweep, stop-->      wishes  -->  the run's thread: slice, slice, ... (Annealing)
//   window  <--standing(), placement(), trace()--   what was published between two slices
// clang-format on
//
// The run's thread looks at the wishes between slices, so they come true within a slice (a 512th of the run,
// a tenth of a second at most at common speeds). Watching costs it a short lock a slice, and, where a
// placement is asked for, a copy of it, made so seldom that it stays below a hundredth of the time. Nothing
// that is watched changes a byte of the result.

#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "bn/error.h"
#include "bn/retarget_anneal.h"

namespace bn::ui {

/// Whether two options state one problem.
bool same(const RetargetOptions& a, const RetargetOptions& b);

/// What decides a run.
struct RunSetup {
  AnnealProblem problem;
  AnnealOptions options;
  int threads = 1;  ///< as Execution::threads; useful from 128 rows or two chains on
};

enum class Phase {
  preparing,  ///< finds its temperatures
  running,
  paused,
  finished,  ///< the budget is spent, or the schedule has frozen
  stopped,   ///< before its end
  failed,
};

struct Standing {
  Phase phase = Phase::preparing;
  AnnealState state;
  std::int64_t start_energy = 0;
  TemperatureRange temperatures;
  double proposals_per_second = 0.0;   ///< lately; 0 until there is something to say
  std::optional<double> seconds_left;  ///< while running, if the speed is known
  std::optional<ErrorInfo> error;      ///< failed: why
};

/// A permutation and its energy, at one moment.
struct Placement {
  Grid<Offset> move;
  std::int64_t energy = 0;
  std::int64_t proposals = 0;
};

/// All functions are for one thread, the window's, and return at once.
class Run {
 public:
  /// Starts; `paused`: only prepares, and waits for start() or sweep().
  explicit Run(RunSetup setup, bool paused = false);
  /// Stops, and waits for the end of the slice: let has_ended() be true before, and the window will not.
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void start();
  void pause();
  /// Pauses, if it runs, and makes one sweep. Clicks add up.
  void sweep();
  /// For good; what was found so far stays.
  void stop();
  bool has_ended() const;  ///< finished, stopped or failed

  const RunSetup& setup() const { return setup_; }
  const AnnealTrace& trace() const { return trace_; }
  Standing standing() const;
  /// The latest placement: the traced chain's of some moment while it runs, exactly that of now when it is
  /// paused, the best when it has ended. Asks for the next one. Null: none yet.
  std::shared_ptr<const Placement> placement();
  /// The best so far: of a paused run, or one that has finished or was stopped. Null: none.
  std::shared_ptr<const AnnealResult> result() const;

 private:
  using Clock = std::chrono::steady_clock;

  void work(const std::stop_token& stop);
  void anneal(const std::stop_token& stop);
  /// What is done next: nothing (a stop), a sweep or a slice. Waits while the run is paused.
  enum class Next { nothing, sweep, slice };
  Next next(const std::stop_token& stop, const Annealing& annealing);
  void publish(const AnnealState& state);
  void publish_placement(const Annealing& annealing);

  const RunSetup setup_;
  AnnealTrace trace_;

  mutable std::mutex mutex_;  ///< of all below, held for moments only
  std::condition_variable_any wished_;
  bool wants_running_;
  int wanted_sweeps_ = 0;
  bool wants_placement_ = true;
  Standing standing_;
  std::shared_ptr<const Placement> placement_;
  std::shared_ptr<const AnnealResult> result_;

  // For the run's thread alone.
  double speed_from_s_ = 0.0;
  std::int64_t speed_from_proposals_ = 0;
  Clock::time_point placed_{};
  double placement_cost_s_ = 0.0;

  std::jthread thread_;  ///< last, so that it ends before what it uses
};

}  // namespace bn::ui
