// A vector mask: the curve's (vector_values.cpp), then values exchanged (vector_swaps.h).

#include "bn/vector_mask.h"

#include <fmt/format.h>

#include "core/progress.h"
#include "core/refuse.h"
#include "noise/vector_swaps.h"

namespace bn {
using namespace noise;

Grid<std::uint32_t> vector_mask(const VectorMaskOptions& options, const Execution& execution) {
  if (options.budget < 0 || options.budget > kMostVectorBudget) {
    refuse("budget", fmt::format("a budget of {}", options.budget), fmt::format("0..{}", kMostVectorBudget));
  }
  const Shape size = options.mask.size;
  const VolumeKernel kernel = spatiotemporal_kernel(options.mask);
  Execution silent = execution;
  silent.progress = {};
  Grid<std::uint32_t> places = curve_mask(options, silent);
  if (options.budget == 0) return places;

  const TorusSides sides{size.width, size.height, size.depth, 1};
  check_memory(execution,
               VectorField::bytes(options.values, size) + VectorKernel::bytes(sides, kernel) +
                   places.count() * sizeof(std::uint32_t),
               "vector mask");
  ProgressMeter meter(execution, static_cast<std::uint64_t>(options.budget * size.count()));
  VectorField field(options.values, options.energy, places);
  exchange_values(field, VectorKernel(VolumeWeights(sides, kernel)), options, execution, meter);
  meter.finish();
  return field.places();
}

}  // namespace bn
