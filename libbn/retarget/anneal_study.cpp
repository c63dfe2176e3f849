// The measurements behind docs/annealing.md: schedules, budgets, seeds and radii against the proven optimum,
// and throughput against threads. Runs are made one after another on one thread each, so that their times
// compare.

#include <algorithm>
#include <chrono>
#include <ctime>

#include "bn/anneal.h"

namespace bn {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

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

std::vector<AnnealThroughput> study_anneal_throughput(const std::vector<int>& sides,
                                                      const std::vector<int>& threads,
                                                      const Execution& execution) {
  std::vector<AnnealThroughput> rows;
  for (const int side : sides) {
    AnnealProblem problem;
    Grid<std::int32_t> levels({side, side});
    for (std::size_t i = 0; i < levels.count(); ++i)
      levels[i] = static_cast<std::int32_t>(random_bits(1, 1, i) & 255);
    problem.channels = {{std::move(levels)}};
    problem.retarget.step = {side * 3 / 4, side * 9 / 16};
    for (const int count : threads) {
      AnnealOptions run;
      run.proposals = 2'000'000'000;
      const Execution inside{
          .threads = count, .stop = execution.stop, .memory_limit_bytes = execution.memory_limit_bytes};
      const double cpu = cpu_seconds();
      const auto start = std::chrono::steady_clock::now();
      const AnnealResult result = anneal_retarget(problem, run, inside);
      rows.push_back(
          {.side = side,
           .threads = count,
           .proposals = result.proposals,
           .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
           .cpu_seconds = cpu_seconds() - cpu});
    }
  }
  return rows;
}

}  // namespace bn
