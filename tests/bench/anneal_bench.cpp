// Throughput of annealing: proposals a second by size, temperature, instruction set and threads, and of the
// scalar engine. docs/annealing.md quotes it.
//   bench_anneal --benchmark_filter=Sweep/256
#include <benchmark/benchmark.h>

#include "bn/random.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;
namespace {

/// A permutation of grey levels without structure: annealing does not care for more.
AnnealProblem grey_problem(int side) {
  Grid<std::int32_t> levels({side, side});
  for (std::size_t i = 0; i < levels.count(); ++i)
    levels[i] = static_cast<std::int32_t>(random_bits(1, 1, i) & 255);
  AnnealProblem problem;
  problem.channels = {{levels}};
  problem.retarget.step = {side * 3 / 4, side * 9 / 16};
  return problem;
}

/// Rounds at a constant temperature, in equilibrium from a warm-up on.
void run(benchmark::State& state, RetargetEngine& engine, double temperature, int threads) {
  constexpr int kSweeps = 64;
  std::int64_t round = 0, proposals = 0;
  for (; round < 10; ++round) engine.round(round, kSweeps, 4.0 * temperature, {.threads = threads});
  for (; round < 20; ++round) engine.round(round, kSweeps, temperature, {.threads = threads});
  for (auto _ : state)
    proposals += engine.round(round++, kSweeps, temperature, {.threads = threads}).proposals;
  state.counters["proposals/s"] =
      benchmark::Counter(static_cast<double>(proposals), benchmark::Counter::kIsRate);
}

void sweep(benchmark::State& state, const std::string& instruction_set, int side, double temperature,
           int threads) {
  use_instruction_set(instruction_set);
  const AnnealProblem problem = grey_problem(side);
  const AnnealInstance instance(problem, 0);
  const auto engine = make_sweep_engine(instance, 1, 0);
  run(state, *engine, temperature, threads);
  use_instruction_set("");
}

void scalar(benchmark::State& state, int side, double temperature) {
  const AnnealProblem problem = grey_problem(side);
  const AnnealInstance instance(problem, 0);
  const auto engine = make_scalar_engine(instance, 1, 0);
  run(state, *engine, temperature, 1);
}

const bool registered = [] {
  for (const int side : {64, 128, 256, 512}) {
    for (const double temperature : {30.0, 3.0, 0.5}) {
      for (const std::string& name : instruction_sets()) {
        benchmark::RegisterBenchmark(
            ("Sweep/" + std::to_string(side) + "/T:" + std::to_string(temperature).substr(0, 4) + "/" + name)
                .c_str(),
            [=](benchmark::State& state) { sweep(state, name, side, temperature, 1); });
      }
    }
  }
  for (const int threads : {1, 2}) {
    benchmark::RegisterBenchmark(("SweepThreads/512/T:3/threads:" + std::to_string(threads)).c_str(),
                                 [=](benchmark::State& state) { sweep(state, "", 512, 3.0, threads); })
        ->UseRealTime();
  }
  benchmark::RegisterBenchmark("ScalarEngine/256/T:3",
                               [](benchmark::State& state) { scalar(state, 256, 3.0); });
  return true;
}();

}  // namespace
}  // namespace bn
