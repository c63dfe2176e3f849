// What watching costs a run: the same annealing by the library alone, and behind a window that looks at it
// sixty times a second. docs/inspector.md quotes it.
//   taskset -c 1 bench_inspector --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <thread>

#include "bn/noise.h"
#include "bn/texture.h"
#include "ui/run.h"

namespace bn::ui {
namespace {

constexpr std::int64_t kProposals = 1'000'000'000;

RunSetup setup() {
  RunSetup setup;
  const Image mask = encode_mask(void_and_cluster({.size = {64, 64}}), SampleType::u8);
  setup.problem.channels = {{levels_of_channel(mask, 0).value}};
  setup.problem.retarget.step = auto_step({64, 64}).step;
  setup.options.proposals = kProposals;
  return setup;
}

void count(benchmark::State& state) {
  state.counters["proposals/s"] =
      benchmark::Counter(static_cast<double>(kProposals * state.iterations()), benchmark::Counter::kIsRate);
}

void by_the_library(benchmark::State& state) {
  const RunSetup given = setup();
  for (auto _ : state)
    benchmark::DoNotOptimize(anneal_retarget(given.problem, given.options, {.threads = 1}));
  count(state);
}
BENCHMARK(by_the_library)->Unit(benchmark::kMillisecond)->UseRealTime();

void behind_a_window(benchmark::State& state) {
  const RunSetup given = setup();
  for (auto _ : state) {
    Run run(given);
    while (!run.has_ended()) {
      benchmark::DoNotOptimize(run.placement());
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    state.SetIterationTime(run.standing().state.seconds);
  }
  count(state);
}
BENCHMARK(behind_a_window)->Unit(benchmark::kMillisecond)->UseManualTime();

}  // namespace
}  // namespace bn::ui
