// How long transforms and analyses take; one thread, as docs/spectrum.md reports them.
#include <benchmark/benchmark.h>

#include <numeric>
#include <vector>

#include "bn/random.h"
#include "bn/spectrum.h"

namespace bn {
namespace {

const Execution kOneThread{.threads = 1};

std::vector<double> white_values(std::int64_t count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(random_bits(1, 0, i) >> 11) * 0x1p-53;
  return values;
}

/// What a mask is: a permutation of 0..N-1.
std::vector<double> white_ranks(std::int64_t count) { return midranks(white_values(count)); }

template <class T>
void transform_square(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const auto values = white_values(std::int64_t{side} * side);
  const std::vector<T> typed(values.begin(), values.end());
  for (auto _ : state) benchmark::DoNotOptimize(transform<T>(typed, {side, side}, kOneThread).values.data());
}
BENCHMARK(transform_square<double>)->Arg(256)->Arg(1000)->Arg(1021)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
BENCHMARK(transform_square<float>)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

void analyse_ranks(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const auto ranks = white_ranks(std::int64_t{side} * side);
  const double n = static_cast<double>(ranks.size());
  for (auto _ : state) benchmark::DoNotOptimize(analyse(ranks, {side, side}, 0.0, n, kOneThread).figures.peak);
}
BENCHMARK(analyse_ranks)->Arg(64)->Arg(256)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

void analyse_doubles(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const auto values = white_values(std::int64_t{side} * side);
  for (auto _ : state) benchmark::DoNotOptimize(analyse(values, {side, side}, 0.0, 1.0, kOneThread).figures.peak);
}
BENCHMARK(analyse_doubles)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

void analyse_volume(benchmark::State& state) {
  const Shape shape{128, 128, 64};
  const auto ranks = white_ranks(shape.count());
  for (auto _ : state) {
    benchmark::DoNotOptimize(analyse(ranks, shape, 0.0, static_cast<double>(shape.count()), kOneThread).figures.peak);
  }
}
BENCHMARK(analyse_volume)->Unit(benchmark::kMillisecond);

void line_power(benchmark::State& state) {
  const int length = static_cast<int>(state.range(0));
  const auto values = white_values(length);
  for (auto _ : state) benchmark::DoNotOptimize(transform<double>(values, {length}, kOneThread).values.data());
}
// Around the prime factor where Bluestein takes over (line_fft.cpp), and a large prime.
BENCHMARK(line_power)->Arg(29)->Arg(31)->Arg(37)->Arg(61)->Arg(65521)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace bn
