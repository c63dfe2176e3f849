#include "noise/volume_order.h"

#include <atomic>
#include <cstdlib>
#include <optional>

#include "bn/random.h"
#include "noise/column_field.h"
#include "noise/fill_columns.h"

namespace bn::noise {
namespace {

constexpr std::uint32_t kStartStream = 2;  // of random_bits
constexpr int kVoxelsADraw = 8;

template <class Lane>
void write_start_energies(ColumnField<Lane>& field, std::uint64_t seed, const Execution& execution) {
  const auto [width, height] = field.columns();
  parallel_for(execution, height, [&](std::int64_t y) {
    for (int slice = 0; slice < field.slices(); ++slice) {
      VolumeStartEnergies start(seed, static_cast<std::uint64_t>((std::int64_t{slice} * height + y) * width));
      for (int x = 0; x < width; ++x) field.column(y * width + x)[slice] = static_cast<Lane>(start.next());
    }
    for (int x = 0; x < width; ++x) field.update_least(y * width + x);
  });
}

/// Nothing if a voxel was too far above its column to be represented.
template <class Lane>
std::optional<Grid<std::uint32_t>> fill(const VolumeWeights& weights, std::uint64_t seed,
                                        const Execution& execution, ProgressMeter& meter) {
  const TorusSides& sides = weights.sides();
  const Extent columns{sides.x, sides.y};
  ColumnField<Lane> field(columns, weights.slices());
  write_start_energies(field, seed, execution);
  const ColumnKernel<Lane> kernel(weights);
  Grid<std::uint32_t> energies({sides.x, sides.y, weights.slices()});
  std::int64_t left = static_cast<std::int64_t>(energies.count());
  int fruitless = 0;
  for (int visit = 0; left > 0; ++visit) {
    throw_if_stopped(execution);
    const std::int64_t now = fill_columns(
        field, kernel, {.region = {0, 0, sides.x, sides.y}, .passes = 1, .moves = 0, .phase = visit},
        energies.data());
    left -= now;
    meter.advance(static_cast<std::uint64_t>(now));
    fruitless = now == 0 ? fruitless + 1 : 0;
    if (fruitless == 16) return std::nullopt;
  }
  return energies;
}

}  // namespace

VolumeStartEnergies::VolumeStartEnergies(std::uint64_t seed, std::uint64_t first)
    : seed_(seed), index_(first), eight_(bits() >> 8 * (first % kVoxelsADraw)) {}

std::uint64_t VolumeStartEnergies::bits() const {
  return random_bits(seed_, kStartStream, index_ / kVoxelsADraw);
}

std::int32_t VolumeStartEnergies::next() {
  const auto energy = static_cast<std::int32_t>(eight_ % kVolumeStartLimit);
  eight_ >>= 8;
  if (++index_ % kVoxelsADraw == 0) eight_ = bits();
  return energy;
}

std::uint64_t volume_order_bytes(const TorusSides& sides) {
  const int slices = sides.z * sides.w;
  const auto voxels = static_cast<std::uint64_t>(Shape{sides.x, sides.y, slices}.count());
  return ColumnField<std::uint16_t>::bytes({sides.x, sides.y}, slices) + voxels * sizeof(std::uint32_t);
}

Grid<std::uint32_t> volume_order(const VolumeWeights& weights, std::uint64_t seed, const Execution& execution,
                                 ProgressMeter& meter) {
  if (auto energies = fill<std::uint16_t>(weights, seed, execution, meter)) return *std::move(energies);
  return volume_order_32_bits(weights, seed, execution, meter);
}

Grid<std::uint32_t> volume_order_32_bits(const VolumeWeights& weights, std::uint64_t seed,
                                         const Execution& execution, ProgressMeter& meter) {
  return *fill<std::int32_t>(weights, seed, execution, meter);
}

}  // namespace bn::noise
