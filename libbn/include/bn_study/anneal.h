// bn_study/anneal.h - floor 4 (study): the measurements behind docs/annealing.md. Not installed.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bn/retarget_anneal.h"

namespace bn {

struct AnnealStudyRun {
  std::string schedule;
  int radius = 0;
  std::int64_t proposals = 0;
  std::uint64_t seed = 0;
  double cpu_seconds = 0.0;  ///< one thread
  std::int64_t energy = 0;
};
/// A line a run under a line of names: schedule,radius,proposals,seed,seconds,energy.
std::string runs_csv(const std::vector<AnnealStudyRun>& runs);
/// The inverse. Errors: invalid_input, naming the line.
std::vector<AnnealStudyRun> runs_from_csv(std::string_view csv);

/// What study_anneal() crosses with each other.
struct AnnealStudyOptions {
  RetargetOptions retarget = {};  ///< its radius is not used
  std::vector<std::string> schedules;
  std::vector<std::int64_t> budgets;  ///< proposals
  std::vector<int> radii;
  int seeds = 1;  ///< 1..seeds
  StartTemperature start = {};
  double end_temperature = 0.0;
  std::vector<AnnealStudyRun> known = {};  ///< made before, of this problem: these are not made again
  /// Called with known and new runs after each group of seeds, and when a stop was requested.
  std::function<void(const std::vector<AnnealStudyRun>&)> save = {};
};

struct AnnealStudyExact {
  int radius = 0;
  double cpu_seconds = 0.0;  ///< one thread, median of five
  std::int64_t start_energy = 0;
  std::int64_t energy = 0;  ///< proven optimal
};
struct AnnealStudy {
  std::vector<AnnealStudyExact> exact;  ///< one a radius
  std::vector<AnnealStudyRun> runs;     ///< known ones first
};

/// Anneals `levels` under every combination and solves each radius exactly. Energies are reproducible, times
/// are those of this machine. Errors: as anneal_retarget() and solve_retarget().
AnnealStudy study_anneal(const Grid<std::int32_t>& levels, const AnnealStudyOptions& options,
                         const Execution& execution = {});

struct AnnealThroughput {
  std::string engine;  ///< an instruction set of the data-parallel sweep, or "swap by swap"
  int side = 0;
  int threads = 1;
  double temperature = 0.0;
  double proposals_per_second = 0.0;  ///< of wall time
};
/// At constant temperatures, in equilibrium, on square tiles of random 8 bit levels, radius 6; medians over
/// eleven stretches. Every engine at 256x256 and T = 30, 3 and 0.5 on one thread; 512x512 at T = 3 and 0.5 on
/// 1, 2, 4 .. execution.threads, taking turns, so that what else the machine does hits them alike.
std::vector<AnnealThroughput> study_anneal_throughput(const Execution& execution = {});

/// What watching and saving cost, as shares of a run's time.
struct AnnealCosts {
  /// Of a trace (readers take no lock): median over 101 ratios of processor times, each of two runs with
  /// a trace and two without, of 1e8 proposals.
  double trace = 0.0;
  double trace_low = 0.0, trace_high = 0.0;  ///< 95 % confidence interval of that median
  double save_seconds = 0.0;                 ///< one checkpoint, encoded and handed to `save`; median
  double checkpoints = 0.0;                  ///< save_seconds over the default interval
  std::size_t checkpoint_bytes = 0;
};
AnnealCosts study_anneal_costs(const AnnealProblem& problem,
                               const std::function<void(std::string_view)>& save,
                               const Execution& execution = {});

// --- tables of a study ---------------------------------------------------------------------------

/// One schedule at one radius and budget, over the seeds.
struct AnnealStudySummary {
  std::string schedule;
  int radius = 0;
  std::int64_t proposals = 0;
  double seconds = 0.0;                        ///< median
  double low = 0.0, median = 0.0, high = 0.0;  ///< energies
  /// In percent of the proven optimum, above it.
  double excess_low = 0.0, excess_median = 0.0, excess_high = 0.0;
};
/// By radius, then by schedule as they stand in `schedules`, then by budget. Runs of other schedules or of
/// radii without an exact solution are left out.
std::vector<AnnealStudySummary> summarise(const AnnealStudy& study,
                                          const std::vector<std::string>& schedules);

/// schedule,radius,proposals,seconds,excess_low,excess_median,excess_high
std::string medians_csv(const std::vector<AnnealStudySummary>& summaries);
/// The same for people: the largest budget first, of each the best schedule first. Markdown.
std::string medians_md(const std::vector<AnnealStudySummary>& summaries);
/// Published figures where they are of this instance, one schedule (the default one, or the first of those
/// chosen) by budgets, of many the whole decades, the proven optimum; of the first radius. Markdown.
std::string results_md(const AnnealStudy& study, const std::vector<AnnealStudySummary>& summaries);

/// The accepted share of worsening swaps over a grid of proposals and classes, each the mean over a stretch
/// of the run; NaN where too few were tried to say.
std::string surface_csv(const AnnealTrace& trace, std::int64_t proposals);

}  // namespace bn
