// Placeholder of the fast path: the definition, executed plainly in O(N²).

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "bn/noise.h"
#include "core/progress.h"
#include "noise/gaussian_kernel.h"

namespace bn {
namespace {

constexpr int kMaxSide = 16384;
constexpr std::uint32_t kStartStream = 1;

[[noreturn]] void refuse(const char* where, std::string what, std::string limit, std::string remedy = "") {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = where,
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

void check(const VoidAndClusterOptions& options) {
  const auto [width, height] = options.size;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    refuse("size", fmt::format("a mask of {}x{} pixels", width, height),
           fmt::format("1x1..{0}x{0}", kMaxSide));
  }
  // Written so that NaN fails.
  if (!(options.sigma_px >= 0.3 && options.sigma_px <= 16.0)) {
    refuse("sigma_px", fmt::format("a standard deviation of {} pixels", options.sigma_px), "0.3..16",
           "1.9 suits most uses");
  }
  if (!(options.initial_density >= 0.0 && options.initial_density <= 0.5)) {
    refuse("initial_density", fmt::format("an initial density of {}", options.initial_density), "0..0.5");
  }
  if (options.cutoff_px < 0 || options.cutoff_px > kMaxKernelRadius) {
    refuse("cutoff_px", fmt::format("a kernel cut-off of {} pixels", options.cutoff_px),
           fmt::format("1..{}, 0 for where the weight rounds to zero", kMaxKernelRadius));
  }
}

class Field {
 public:
  Field(Extent size, const GaussianKernel& kernel) : energy(size), set(size), kernel_(&kernel) {}
  Grid<std::int32_t> energy;
  Grid<char> set;
  void add(std::size_t pixel, int sign) {
    const int px = static_cast<int>(pixel % static_cast<std::size_t>(energy.width()));
    const int py = static_cast<int>(pixel / static_cast<std::size_t>(energy.width()));
    for (int y = -kernel_->radius(); y <= kernel_->radius(); ++y) {
      for (int x = -kernel_->radius(); x <= kernel_->radius(); ++x) {
        energy(wrap(px + x, energy.width()), wrap(py + y, energy.height())) += sign * kernel_->weight(x, y);
      }
    }
  }

 private:
  const GaussianKernel* kernel_;
};

}  // namespace

Grid<std::uint32_t> void_and_cluster(const VoidAndClusterOptions& options, const Execution& execution) {
  check(options);
  thread_count(execution);
  const auto count = static_cast<std::size_t>(options.size.area());
  check_memory(execution, 16 * count, "void-and-cluster mask");
  const GaussianKernel kernel(options.sigma_px, options.cutoff_px);
  ProgressMeter meter(execution, count);
  Field field(options.size, kernel);
  for (std::size_t i = 0; i < count; ++i) {
    field.energy[i] = static_cast<std::int32_t>(
        (random_bits(options.seed, kStartStream, i / 4) >> (16 * (i % 4))) % kStartEnergyLimit);
  }
  Grid<std::uint32_t> ranks(options.size);
  const auto initial = static_cast<std::size_t>(std::floor(options.initial_density * static_cast<double>(count) + 0.5));
  Field pattern = field;
  for (std::size_t rank = 0; rank < count; ++rank) {
    throw_if_stopped(execution);
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (!field.set[i] && (best == count || field.energy[i] < field.energy[best])) best = i;
    }
    field.set[best] = 1;
    field.add(best, 1);
    ranks[best] = static_cast<std::uint32_t>(rank);
    if (rank + 1 == initial) pattern = field;
    meter.advance(1);
  }
  for (std::size_t rank = initial; rank-- > 0;) {
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (pattern.set[i] && (best == count || pattern.energy[i] > pattern.energy[best])) best = i;
    }
    pattern.set[best] = 0;
    pattern.add(best, -1);
    ranks[best] = static_cast<std::uint32_t>(rank);
  }
  meter.finish();
  return ranks;
}

}  // namespace bn
