#include "noise/volume_order.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

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

/// How many threads can work without getting into each other's way all the time.
int useful_threads(const VolumeWeights& weights, const Execution& execution) {
  const int rows_a_thread = 4 * weights.reach_y() + 2 * RowLocks::kRows;
  return std::clamp(weights.sides().y / rows_a_thread, 1, thread_count(execution));
}

/// Nothing if a voxel was too far above its column to be represented.
template <class Lane>
std::optional<VolumeOrder> fill(const VolumeWeights& weights, std::span<const Voxel> first,
                                std::uint64_t seed, const Execution& execution, ProgressMeter& meter) {
  const TorusSides& sides = weights.sides();
  ColumnField<Lane> field({sides.x, sides.y}, weights.slices());
  write_start_energies(field, seed, execution);
  const ColumnKernel<Lane> kernel(weights);
  std::vector<Voxel> places = set_voxels(field, kernel, first);
  Grid<std::uint32_t> energies({sides.x, sides.y, weights.slices()});
  const int threads = useful_threads(weights, execution);
  RowLocks locks(sides.y, weights.reach_y(), threads == 1);
  // Small steps keep the ways of threads short, so that they seldom meet; alone, large ones are better.
  const double voxels_a_step = threads == 1 ? 4.0 : 1.0 / 16.0;
  const auto step = static_cast<std::int32_t>(
      std::min(static_cast<double>(weights.sum()) * voxels_a_step / weights.slices(), 1e9) + 1.0);
  std::atomic<std::int64_t> left = static_cast<std::int64_t>(energies.count()) - std::ssize(first);
  parallel_for(execution, threads, [&](std::int64_t i) {
    const int begin = static_cast<int>(sides.y * i / threads);
    const int end = static_cast<int>(sides.y * (i + 1) / threads);
    fill_columns(ColumnJob<Lane>{.field = field,
                                 .kernel = kernel,
                                 .rows = {begin, end - begin},
                                 .step = step,
                                 .locks = locks,
                                 .energy_when_set = energies.data(),
                                 .progress = [&](std::int64_t now) {
                                   throw_if_stopped(execution);
                                   left -= now;
                                   meter.advance(static_cast<std::uint64_t>(now));
                                 }});
  });
  if (left > 0) return std::nullopt;
  return VolumeOrder{std::move(energies), std::move(places)};
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

VolumeOrder volume_order(const VolumeWeights& weights, std::span<const Voxel> first, std::uint64_t seed,
                         const Execution& execution, ProgressMeter& meter) {
  if (auto order = fill<std::uint16_t>(weights, first, seed, execution, meter)) return *std::move(order);
  return volume_order_32_bits(weights, first, seed, execution, meter);
}

VolumeOrder volume_order_32_bits(const VolumeWeights& weights, std::span<const Voxel> first,
                                 std::uint64_t seed, const Execution& execution, ProgressMeter& meter) {
  return *fill<std::int32_t>(weights, first, seed, execution, meter);
}

void append_first_voxels(const VolumeWeights& weights, std::uint64_t seed, std::int64_t count,
                         const Execution& execution, std::vector<Voxel>& voxels) {
  const auto [width, height, z, w] = weights.sides();
  ColumnField<std::int32_t> field({width, height}, weights.slices());
  write_start_energies(field, seed, execution);
  const ColumnKernel<std::int32_t> kernel(weights);
  voxels = set_voxels(field, kernel, voxels);
  // Until so many are set the mean energy of all is below this, so the largest void is too.
  constexpr std::uint32_t kUnset = UINT32_MAX;
  Grid<std::uint32_t> energies({width, height, weights.slices()}, kUnset);
  const auto all = static_cast<std::int64_t>(energies.count());
  const auto end = static_cast<std::int32_t>(kVolumeStartLimit + weights.sum() * count / all + 1);
  RowLocks locks(height, weights.reach_y(), true);
  fill_columns(ColumnJob<std::int32_t>{.field = field,
                                       .kernel = kernel,
                                       .rows = {0, height},
                                       .step = end,
                                       .end = end,
                                       .locks = locks,
                                       .energy_when_set = energies.data(),
                                       .progress = [&](std::int64_t) { throw_if_stopped(execution); }});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> voids;  // energy, index
  for (std::uint32_t i = 0; i < energies.count(); ++i) {
    if (energies[i] != kUnset) voids.push_back({energies[i], i});
  }
  std::sort(voids.begin(), voids.end());
  voids.resize(std::min(voids.size(), static_cast<std::size_t>(count - std::ssize(voxels))));
  for (const auto& [energy, index] : voids) {
    const auto i = static_cast<std::int64_t>(index);
    voxels.push_back({static_cast<int>(i % width), static_cast<int>(i / width % height),
                      static_cast<int>(i / width / height)});
  }
}

}  // namespace bn::noise
