// Exact retarget tiles with proof, of masks made by void_and_cluster() and encoded to 8 bits, step auto,
// radius 6. Counters: energy, and 1 for proven. bench_retarget --benchmark_time_unit=ms
#include <benchmark/benchmark.h>

#include <map>

#include "bn/noise.h"
#include "bn/retarget.h"

namespace bn {
namespace {

const Grid<std::int32_t>& mask_levels(int side, int bits) {
  static std::map<std::pair<int, int>, Grid<std::int32_t>> made;
  auto& levels = made[{side, bits}];
  if (levels.count() == 0) {
    const auto rank = void_and_cluster({.size = {side, side}});
    levels = Grid<std::int32_t>(rank.size());
    for (std::size_t i = 0; i < rank.count(); ++i) {
      levels[i] = static_cast<std::int32_t>((std::uint64_t{rank[i]} << bits) / rank.count());
    }
  }
  return levels;
}

void solve(benchmark::State& state, int side, int bits, RetargetOptions options) {
  const auto& levels = mask_levels(side, bits);
  options.step = auto_step(levels.size()).step;
  RetargetTile tile;
  for (auto _ : state) tile = solve_retarget(levels, options, {.threads = 1});
  state.counters["energy"] = static_cast<double>(tile.energy);
  state.counters["proven"] = tile.optimal();
}

void exact_8bit(benchmark::State& state) { solve(state, static_cast<int>(state.range(0)), 8, {}); }
BENCHMARK(exact_8bit)->RangeMultiplier(2)->Range(64, 1024)->Unit(benchmark::kMillisecond);

void exact_16bit(benchmark::State& state) { solve(state, static_cast<int>(state.range(0)), 16, {}); }
BENCHMARK(exact_16bit)->RangeMultiplier(2)->Range(64, 512)->Unit(benchmark::kMillisecond);

void exact_radius_128(benchmark::State& state) {
  solve(state, 128, 8, {.radius = static_cast<int>(state.range(0))});
}
BENCHMARK(exact_radius_128)->Arg(1)->Arg(3)->Arg(6)->Arg(10)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);

void exact_l2_128(benchmark::State& state) {
  solve(state, 128, static_cast<int>(state.range(0)), {.metric = Metric::l2});
}
BENCHMARK(exact_l2_128)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);

/// Gap in 1/1000.
void gap_512(benchmark::State& state) {
  solve(state, 512, 8, {.gap = static_cast<double>(state.range(0)) / 1000});
}
BENCHMARK(gap_512)->Arg(50)->Arg(5)->Unit(benchmark::kMillisecond);

/// The 81 variants; arguments: side, threads.
void motion_set(benchmark::State& state) {
  const auto& levels = mask_levels(static_cast<int>(state.range(0)), 8);
  const RetargetOptions options{.step = auto_step(levels.size()).step};
  bool proven = true;
  for (auto _ : state) {
    for (const auto& tile :
         solve_motion_set(levels, options, 4, {.threads = static_cast<int>(state.range(1))})) {
      proven = proven && tile.optimal();
    }
  }
  state.counters["proven"] = proven;
}
BENCHMARK(motion_set)
    ->Args({64, 1})
    ->Args({64, 2})
    ->Args({128, 1})
    ->Args({128, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace bn
