// What the passes of the temporal algorithm cost at 1920 x 1080: the plain functions, and the shaders
// on lavapipe by the device's own time stamps. The first dispatch compiles and is never timed.
//   LP_NUM_THREADS=2 build/release/tests/bench/bench_render
#include <benchmark/benchmark.h>

#include <algorithm>

#include "bn/random.h"
#include "bn/render.h"
#include "render/temporal_passes.h"

namespace bn {
using namespace render;
using namespace gpu;
namespace {

constexpr Extent kScreen{1920, 1080};

struct Input {
  TemporalTextures textures;
  Seeds seeds;
  Grid<float> luminance{kScreen};
};

const Input& input() {
  static const Input made = [] {
    Input input;
    input.textures = {.masks = {Grid<std::int32_t>({64, 64})}, .step = {49, 37}};
    Grid<Offset> move({64, 64});
    for (std::size_t i = 0; i < move.count(); ++i) {
      input.textures.masks[0][i] = static_cast<std::int32_t>(random_bits(5, 1, i) & 255);
      move[i] = {static_cast<int>(i % 2 == 0) * 2 - 1, 0};  // neighbours change places
    }
    input.textures.moves = {move};
    input.seeds = initial_seeds(padded_extent(kScreen, {64, 64}), 1);
    for (std::size_t i = 0; i < input.luminance.count(); ++i) {
      input.luminance[i] = sample(static_cast<std::uint32_t>(i), 0);
    }
    return input;
  }();
  return made;
}

void plain_sort(benchmark::State& state) {
  Seeds seeds = input().seeds;
  for (auto _ : state) {
    sort_seeds(seeds, input().luminance, input().textures.mask(0), {0, 0},
               sort_blocks(static_cast<int>(state.range(0)), false, 0, 0), {.threads = 1});
  }
}
BENCHMARK(plain_sort)->Arg(8)->Unit(benchmark::kMillisecond);

void plain_retarget(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        retarget_seeds(input().seeds, input().textures.moves[0], {13, 31}, {.threads = 1}));
  }
}
BENCHMARK(plain_retarget)->Unit(benchmark::kMillisecond);

enum { kSort, kMotion, kRetarget };

/// Wall time by the device's time stamps (manual_time); CPU is that of the whole process, all threads.
void device_pass(benchmark::State& state) {
  static VulkanDevice device("lavapipe", false);
  const auto pass = state.range(0);
  TemporalPasses temporal(device, input().textures, kScreen, input().seeds, static_cast<int>(state.range(1)));
  device.upload(temporal.luminance(),
                std::as_bytes(std::span(input().luminance.data(), input().luminance.count())));
  PassTimer timer(device);
  const auto frame = [&] {
    device.run([&](const vk::raii::CommandBuffer& commands) {
      timer.start(commands);
      if (pass == kSort) temporal.record_sort(commands, 5, {0, 0});
      if (pass == kMotion) temporal.record_motion_choice(commands);
      if (pass == kRetarget) temporal.record_retarget(commands, 5);
      timer.mark(commands, "pass");
    });
    return timer.read().front().milliseconds;
  };
  frame();  // compiles
  double least = 1e30;
  for (auto _ : state) {
    const double milliseconds = frame();
    least = std::min(least, milliseconds);
    state.SetIterationTime(milliseconds * 1e-3);
  }
  state.counters["least_ms"] = least;  // what the machine can do when nobody else uses it
}
BENCHMARK(device_pass)
    ->ArgNames({"pass", "block"})
    ->Args({kSort, 2})
    ->Args({kSort, 4})
    ->Args({kSort, 8})
    ->Args({kSort, 16})
    ->Args({kMotion, 8})
    ->Args({kRetarget, 8})
    ->UseManualTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bn
