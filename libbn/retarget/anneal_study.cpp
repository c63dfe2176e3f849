// The measurements behind docs/annealing.md: schedules, budgets, seeds and radii against the proven optimum;
// throughput against threads; what watching and saving cost. Runs are made one after another on one thread
// each, so that their times compare.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <iterator>
#include <memory>

#include "bn/anneal.h"
#include "retarget/anneal_engine.h"

namespace bn {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

std::string runs_csv(const std::vector<AnnealStudyRun>& runs) {
  std::string text = "schedule,radius,proposals,seed,seconds,energy\n";
  for (const AnnealStudyRun& r : runs) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.4f},{}\n", r.schedule, r.radius, r.proposals,
                   r.seed, r.cpu_seconds, r.energy);
  }
  return text;
}

AnnealStudy study_anneal(const Grid<std::int32_t>& levels, const AnnealStudyOptions& options,
                         const Execution& execution) {
  AnnealStudy study;
  AnnealProblem problem;
  problem.channels = {{levels}};
  problem.retarget = options.retarget;
  const auto report = [&](std::size_t done) {
    const std::size_t all = options.radii.size() * options.schedules.size() * options.budgets.size() *
                            static_cast<std::size_t>(options.seeds);
    if (execution.progress)
      execution.progress(static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(1, all)));
  };
  const Execution alone{
      .threads = 1, .stop = execution.stop, .memory_limit_bytes = execution.memory_limit_bytes};
  std::size_t done = 0;
  for (const int radius : options.radii) {
    problem.retarget.radius = radius;
    const double exact_start = cpu_seconds();
    const RetargetTile exact = solve_retarget(levels, problem.retarget, alone);
    study.exact.push_back({.radius = radius,
                           .cpu_seconds = cpu_seconds() - exact_start,
                           .start_energy = exact.start_energy,
                           .energy = exact.energy});
    for (const std::string& schedule : options.schedules) {
      for (const std::int64_t budget : options.budgets) {
        for (int seed = 1; seed <= options.seeds; ++seed) {
          AnnealOptions run;
          run.schedule = schedule;
          run.proposals = budget;
          run.seed = static_cast<std::uint64_t>(seed);
          run.start = options.start;
          run.end_temperature = options.end_temperature;
          run.lower_bound = exact.lower_bound;
          const double start = cpu_seconds();
          const AnnealResult result = anneal_retarget(problem, run, alone);
          study.runs.push_back({.schedule = schedule,
                                .radius = radius,
                                .proposals = budget,
                                .seed = run.seed,
                                .cpu_seconds = cpu_seconds() - start,
                                .energy = result.tile.energy});
          report(++done);
        }
      }
    }
  }
  return study;
}

namespace {

using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Structureless grey levels: annealing does not care for more.
AnnealProblem grey_problem(int side) {
  Grid<std::int32_t> levels({side, side});
  for (std::size_t i = 0; i < levels.count(); ++i)
    levels[i] = static_cast<std::int32_t>(random_bits(1, 1, i) & 255);
  AnnealProblem problem;
  problem.channels = {{std::move(levels)}};
  problem.retarget.step = {side * 3 / 4, side * 9 / 16};
  return problem;
}

/// An engine at one temperature, in equilibrium from a warm-up on.
class Stretch {
 public:
  Stretch(std::unique_ptr<AnnealEngine> engine, double temperature, int threads)
      : engine_(std::move(engine)), temperature_(temperature), execution_{.threads = threads} {
    for (int i = 0; i < 10; ++i) engine_->round(round_++, kSweeps, 4.0 * temperature, execution_);
    for (int i = 0; i < 10; ++i) engine_->round(round_++, kSweeps, temperature, execution_);
  }
  /// Proposals a second over some rounds.
  double run(int rounds) {
    std::int64_t proposals = 0;
    const auto start = Clock::now();
    for (int i = 0; i < rounds; ++i)
      proposals += engine_->round(round_++, kSweeps, temperature_, execution_).proposals;
    return static_cast<double>(proposals) / std::chrono::duration<double>(Clock::now() - start).count();
  }

 private:
  static constexpr int kSweeps = 64;
  std::unique_ptr<AnnealEngine> engine_;
  double temperature_;
  Execution execution_;
  std::int64_t round_ = 0;
};

constexpr int kStretches = 11;
/// Of processor times with and without a trace, each of four runs of 1e8 proposals.
constexpr int kTraceRatios = 101;

}  // namespace

std::vector<AnnealThroughput> study_anneal_throughput(const Execution& execution) {
  std::vector<AnnealThroughput> rows;
  const auto add = [&](Stretch& stretch, std::string engine, double temperature, int rounds) {
    std::vector<double> speeds;
    for (int i = 0; i < kStretches; ++i) {
      throw_if_stopped(execution);
      speeds.push_back(stretch.run(rounds));
    }
    rows.push_back({std::move(engine), 256, 1, temperature, median(speeds)});
  };
  const AnnealProblem problem = grey_problem(256);
  const AnnealInstance instance(problem, 0);
  for (const double temperature : {30.0, 3.0, 0.5}) {
    for (const std::string& name : instruction_sets()) {
      use_instruction_set(name);
      Stretch stretch(make_sweep_engine(instance, 1, 0), temperature, 1);
      add(stretch, name, temperature, name == "SCALAR" ? 1 : 16);
      use_instruction_set("");
    }
    Stretch stretch(make_scalar_engine(instance, 1, 0), temperature, 1);
    add(stretch, "swap by swap", temperature, 1);
  }
  const AnnealProblem large = grey_problem(512);
  const AnnealInstance large_instance(large, 0);
  for (const double temperature : {3.0, 0.5}) {
    std::vector<int> threads;
    std::vector<Stretch> stretches;
    for (int count = 1; count <= thread_count(execution); count *= 2) {
      threads.push_back(count);
      stretches.emplace_back(make_sweep_engine(large_instance, 1, 0), temperature, count);
    }
    std::vector<std::vector<double>> speeds(threads.size());
    for (int i = 0; i < kStretches; ++i) {
      throw_if_stopped(execution);
      for (std::size_t t = 0; t < threads.size(); ++t) speeds[t].push_back(stretches[t].run(8));
    }
    for (std::size_t t = 0; t < threads.size(); ++t)
      rows.push_back({instruction_sets().front(), 512, threads[t], temperature, median(speeds[t])});
  }
  return rows;
}

AnnealCosts study_anneal_costs(const AnnealProblem& problem,
                               const std::function<void(std::string_view)>& save,
                               const Execution& execution) {
  const Execution alone{
      .threads = 1, .stop = execution.stop, .memory_limit_bytes = execution.memory_limit_bytes};
  AnnealCosts costs;
  AnnealOptions run;
  run.proposals = 100'000'000;
  const auto seconds_of = [&](AnnealTrace* trace) {
    const double start = cpu_seconds();
    anneal_retarget(problem, run, alone, trace);
    return cpu_seconds() - start;
  };
  // With, without, without, with: what drifts evenly over four runs, a clock rate above all, cancels.
  std::vector<double> ratios;
  for (int i = 0; i < kTraceRatios; ++i) {
    throw_if_stopped(execution);
    AnnealTrace first, last;
    const double first_with = seconds_of(&first);
    const double without = seconds_of(nullptr) + seconds_of(nullptr);
    ratios.push_back((first_with + seconds_of(&last)) / without - 1.0);
  }
  std::sort(ratios.begin(), ratios.end());
  // The true median lies between these two with 95 % confidence, whatever the distribution: how many of n
  // values lie below it is binomial, n / 2 give or take sqrt(n) / 2.
  const auto outside = static_cast<std::size_t>((kTraceRatios - 1.96 * std::sqrt(kTraceRatios)) / 2.0);
  costs.trace = ratios[ratios.size() / 2];
  costs.trace_low = ratios[outside];
  costs.trace_high = ratios[ratios.size() - 1 - outside];

  std::vector<double> saves;
  run.proposals = 200'000'000;
  Annealing stepped(problem, run, alone);
  for (int i = 0; i < kStretches; ++i) {
    stepped.beat();
    const auto start = Clock::now();
    const std::string bytes = stepped.checkpoint();
    save(bytes);
    saves.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    costs.checkpoint_bytes = bytes.size();
  }
  costs.save_seconds = median(saves);
  costs.checkpoints = costs.save_seconds / Checkpointing{}.interval_s;
  return costs;
}

}  // namespace bn
