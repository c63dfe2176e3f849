// Void-and-cluster: time per mask and per pixel.
#include <benchmark/benchmark.h>

#include "bn/noise.h"

namespace bn {
namespace {

void BM_VoidAndCluster(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const Execution execution{.threads = static_cast<int>(state.range(1))};
  for (auto _ : state) benchmark::DoNotOptimize(void_and_cluster({.size = {side, side}}, execution));
  state.counters["ns/pixel"] = benchmark::Counter(
      1e-9 * side * side, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_VoidAndCluster)
    ->ArgNames({"side", "threads"})
    ->ArgsProduct({{64, 128, 256, 512, 1024, 2048, 4096, 8192}, {1}})
    ->Args({1024, 2})
    ->Args({4096, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bn
