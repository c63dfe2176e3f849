// Void-and-cluster: time a mask and a pixel, by size and threads, beside the plain O(N²) reference.
//   build/release/tests/bench/bench_noise
#include <benchmark/benchmark.h>

#include "../noise/reference_void_and_cluster.h"
#include "bn/noise.h"

namespace bn {
namespace {

void per_pixel(benchmark::State& state, int side) {
  state.counters["per_pixel"] = benchmark::Counter(
      1.0 * side * side, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void BM_VoidAndCluster(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const Execution execution{.threads = static_cast<int>(state.range(1))};
  for (auto _ : state) benchmark::DoNotOptimize(void_and_cluster({.size = {side, side}}, execution));
  per_pixel(state, side);
}
BENCHMARK(BM_VoidAndCluster)
    ->ArgNames({"side", "threads"})
    ->ArgsProduct({{64, 128, 256, 512, 1024, 2048, 4096, 8192}, {1}})
    ->ArgsProduct({{1024, 4096}, {2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void BM_Reference(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(reference_void_and_cluster({.size = {side, side}}));
  per_pixel(state, side);
}
BENCHMARK(BM_Reference)->ArgName("side")->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bn
