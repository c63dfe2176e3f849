// The measurements behind docs/annealing.md: schedules, budgets, seeds and radii against the proven optimum;
// throughput against threads; what watching and saving cost. Runs are made one after another on one thread
// each, so that their times compare.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <iterator>
#include <memory>
#include <tuple>

#include "bn/random.h"
#include "bn_study/anneal.h"
#include "core/progress.h"
#include "core/refuse.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
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

std::vector<AnnealStudyRun> runs_from_csv(std::string_view csv) {
  const std::string names = runs_csv({});
  std::vector<AnnealStudyRun> runs;
  int line_number = 1;
  const auto refuse_line = [&] {
    refuse("runs.csv", fmt::format("line {} is no run", line_number), "as runs_csv() writes them");
  };
  if (!csv.starts_with(names)) refuse_line();
  csv.remove_prefix(names.size());
  while (!csv.empty()) {
    ++line_number;
    const auto end = csv.find('\n');
    if (end == std::string_view::npos) refuse_line();
    std::string_view line = csv.substr(0, end);
    csv.remove_prefix(end + 1);
    AnnealStudyRun run;
    const auto comma = std::min(line.find(','), line.size());
    run.schedule = line.substr(0, comma);
    line.remove_prefix(comma);
    const auto number = [&](auto& value) {
      if (!line.starts_with(',')) refuse_line();
      const auto [rest, error] = std::from_chars(line.data() + 1, line.data() + line.size(), value);
      if (error != std::errc{}) refuse_line();
      line.remove_prefix(static_cast<std::size_t>(rest - line.data()));
    };
    number(run.radius);
    number(run.proposals);
    number(run.seed);
    number(run.cpu_seconds);
    number(run.energy);
    if (!line.empty()) refuse_line();
    runs.push_back(std::move(run));
  }
  return runs;
}

AnnealStudy study_anneal(const Grid<std::int32_t>& levels, const AnnealStudyOptions& options,
                         const Execution& execution) {
  AnnealStudy study;
  study.runs = options.known;
  AnnealProblem problem;
  problem.channels = {{levels}};
  problem.retarget = options.retarget;
  const Execution alone{
      .threads = 1, .stop = execution.stop, .memory_limit_bytes = execution.memory_limit_bytes};
  ProgressMeter progress(execution, options.radii.size() * options.schedules.size() * options.budgets.size() *
                                        static_cast<std::size_t>(options.seeds));
  const auto save = [&] {
    if (options.save) options.save(study.runs);
  };
  const auto is_known = [&](const AnnealStudyRun& run) {
    return std::any_of(options.known.begin(), options.known.end(), [&](const AnnealStudyRun& known) {
      return std::tie(known.schedule, known.radius, known.proposals, known.seed) ==
             std::tie(run.schedule, run.radius, run.proposals, run.seed);
    });
  };
  const auto make = [&](AnnealStudyRun run) {
    AnnealOptions one;
    one.schedule = run.schedule;
    one.proposals = run.proposals;
    one.seed = run.seed;
    one.start = options.start;
    one.end_temperature = options.end_temperature;
    const double start = cpu_seconds();
    run.energy = anneal_retarget(problem, one, alone).tile.energy;
    run.cpu_seconds = cpu_seconds() - start;
    study.runs.push_back(std::move(run));
  };
  try {
    for (const int radius : options.radii) {
      problem.retarget.radius = radius;
      constexpr int kSolves = 5;
      std::vector<double> seconds;
      RetargetTile exact;
      for (int i = 0; i < kSolves; ++i) {
        const double start = cpu_seconds();
        exact = solve_retarget(levels, problem.retarget, alone);
        seconds.push_back(cpu_seconds() - start);
      }
      study.exact.push_back({.radius = radius,
                             .cpu_seconds = median(seconds),
                             .start_energy = exact.start_energy,
                             .energy = exact.energy});
      for (const std::string& schedule : options.schedules) {
        for (const std::int64_t budget : options.budgets) {
          for (int seed = 1; seed <= options.seeds; ++seed) {
            AnnealStudyRun run{.schedule = schedule,
                               .radius = radius,
                               .proposals = budget,
                               .seed = static_cast<std::uint64_t>(seed)};
            if (!is_known(run)) make(std::move(run));
            progress.advance(1);
          }
          save();
        }
      }
    }
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) save();
    throw;
  }
  progress.finish();
  return study;
}

namespace {

using Clock = std::chrono::steady_clock;

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
  Stretch(std::unique_ptr<RetargetEngine> engine, double temperature, int threads)
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
  std::unique_ptr<RetargetEngine> engine_;
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
    stepped.advance();
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
