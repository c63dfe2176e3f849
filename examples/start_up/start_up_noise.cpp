#include "start_up_noise.h"

#include <cstdint>
#include <cstdio>
#include <exception>

#include "bn/spatiotemporal.h"

// No exception crosses into C.
int start_up_noise(uint8_t* samples, size_t bytes, int width, int height, int depth, uint64_t seed,
                   char* problem, size_t problem_bytes) {
  try {
    bn::Execution one_thread;
    one_thread.threads = 1;  // starting others takes longer than they save
    const auto ranks = bn::spatiotemporal_mask({.size = {width, height, depth}, .seed = seed}, one_thread);
    if (samples == nullptr || bytes < ranks.count()) {
      std::snprintf(problem, problem_bytes, "room for %zu samples, where %zu are made", bytes, ranks.count());
      return 1;
    }
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    for (std::size_t i = 0; i < ranks.count(); ++i)
      samples[i] = static_cast<std::uint8_t>(ranks[i] * 256u / pixels);
    return 0;
  } catch (const std::exception& error) {
    std::snprintf(problem, problem_bytes, "%s", error.what());
    return 1;
  }
}
