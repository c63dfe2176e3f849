// Void-and-cluster: time a mask and a pixel, by size and threads, beside the plain O(N²) reference.
// Vector masks: pair terms a second, and the time that each voxel takes for each time it looks for a better
// value.
//   build/release/tests/bench/bench_noise
#include <benchmark/benchmark.h>

#include "../noise/reference_void_and_cluster.h"
#include "bn/noise.h"
#include "noise/vector_swaps.h"

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

VectorMaskOptions vector_options(VectorValues values, int side, int depth) {
  VectorMaskOptions options;
  options.values = values;
  options.mask.size = {side, side, depth};
  options.mask.preset = SpatiotemporalPreset::filtered;
  return options;
}

void BM_VectorGain(benchmark::State& state) {
  using namespace noise;
  const auto values = static_cast<VectorValues>(state.range(0));
  const VectorMaskOptions options = vector_options(values, 64, 32);
  const VectorKernel kernel(VolumeWeights({64, 64, 32, 1}, spatiotemporal_kernel(options.mask)));
  const VectorField field(values, options.energy, curve_mask(options));
  const ScaledVector from = scaled_value(values, 123456789);
  const ScaledVector to = scaled_value(values, 3123456789);
  int at = 0;
  for (auto _ : state) {
    at = (at + 7) % 64;
    benchmark::DoNotOptimize(gain(field, kernel, {at, at, at % 32}, from, to));
  }
  // Each voxel that is seen is at a distance from both values.
  const double terms = 2.0 * 32.0 * static_cast<double>(kernel.columns().size());
  state.counters["terms"] = benchmark::Counter(terms, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_VectorGain)->ArgName("values")->DenseRange(0, 2);

void BM_VectorMask(benchmark::State& state) {
  VectorMaskOptions options = vector_options(VectorValues::vec2, static_cast<int>(state.range(0)), 32);
  options.budget = 2;
  const Execution execution{.threads = static_cast<int>(state.range(1))};
  for (auto _ : state) benchmark::DoNotOptimize(vector_mask(options, execution));
  state.counters["per_visit"] =
      benchmark::Counter(static_cast<double>(2 * options.mask.size.count()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_VectorMask)
    ->ArgNames({"side", "threads"})
    ->ArgsProduct({{64, 128}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bn
