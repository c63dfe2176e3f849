// Void-and-cluster on a torus of up to four axes, with a kernel that is a sum of separable terms.
//
// Definition. Every voxel that is set adds the kernel (volume_weights.h) to the energies of all voxels,
// itself included. Every voxel starts with a random energy of a few low bits. Voxels are set one after
// another, always the unset one of least energy, the lowest index (slice * height + y) * width + x of equal
// ones, until all are set.
//   Ranks are their places in the order of (energy when set, random number, index). That is the order in
//   which they
// were set, but for voxels that were set at equal energies: those do not see each other, so nothing decides
// between them, and the lowest index first would fill the volume from one corner in the sparsest patterns.
//   tests/noise/reference_volume_mask.h says the same in 60 lines of plain C++; the product equals it bit for
//   bit.
//
// A volume of one slice takes the path of void_and_cluster(), with the precision of that.
//
// Streams of random_bits: 2 start energies, 3 order among equals.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>
#include <string>
#include <vector>

#include "bn/noise.h"
#include "bn/random.h"
#include "bn/spatiotemporal.h"
#include "core/progress.h"
#include "core/refuse.h"
#include "noise/axis_function.h"
#include "noise/filling_order.h"
#include "noise/first_voxels.h"
#include "noise/last_voxels.h"
#include "noise/plane_kernel.h"
#include "noise/rank_order.h"
#include "noise/slice_ranks.h"
#include "noise/volume_order.h"

namespace bn {
using namespace noise;
namespace {

constexpr int kMaxSide = 16384;
constexpr std::int64_t kMaxSlices = 16384;
constexpr std::int64_t kMaxVoxels = std::int64_t{1} << 31;
constexpr std::size_t kMaxTerms = 16;
constexpr std::uint32_t kEqualsStream = 3;  // of random_bits

void check(const TorusSides& s) {
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxSide; };
  const bool sides = is_side(s.x) && is_side(s.y) && is_side(s.z) && is_side(s.w);
  if (!sides || std::int64_t{s.z} * s.w > kMaxSlices || std::int64_t{s.x} * s.y * s.z * s.w > kMaxVoxels) {
    refuse("size", fmt::format("a volume of {}x{}x{}x{} voxels", s.x, s.y, s.z, s.w),
           fmt::format("each side 1..{}, {} slices, {} voxels", kMaxSide, kMaxSlices, kMaxVoxels));
  }
}

void check(const VolumeKernel& kernel, const TorusSides& sides) {
  if (kernel.empty() || kernel.size() > kMaxTerms) {
    refuse("kernel", fmt::format("a kernel of {} terms", kernel.size()), fmt::format("1..{}", kMaxTerms));
  }
  for (const KernelTerm& term : kernel) {
    if (!(term.weight > 0.0 && term.weight <= 1e6)) {
      refuse("kernel", fmt::format("a term of weight {}", term.weight), "above 0, up to 1e6");
    }
    noise::check(term.x, "kernel along x");
    noise::check(term.y, "kernel along y");
    noise::check(term.z, "kernel along z");
    noise::check(term.w, "kernel along w");
    if ((term.x.form == AxisForm::one && sides.x > 1) || (term.y.form == AxisForm::one && sides.y > 1)) {
      refuse("kernel", "a term that is 1 at every distance in x or y",
             "along z and w, or where the side is 1");
    }
  }
}

/// Whether the mask is one of void_and_cluster().
bool is_gaussian_mask(const VolumeMaskOptions& options) {
  if (options.kernel.size() != 1) return false;
  const auto& [weight, x, y, z, w] = options.kernel.front();
  return x.form == AxisForm::gauss && y.form == AxisForm::gauss && x.width == y.width && x.width <= 16.0;
}

Grid<std::uint32_t> plane_mask(const VolumeMaskOptions& options, const Execution& execution) {
  const Extent size{options.size.x, options.size.y};
  if (is_gaussian_mask(options)) {
    return void_and_cluster({.size = size, .sigma_px = options.kernel.front().x.width, .seed = options.seed},
                            execution);
  }
  check_memory(execution, filling_order_bytes(size), "void-and-cluster mask");
  ProgressMeter meter(execution, static_cast<std::uint64_t>(size.area()));
  Grid<std::uint32_t> ranks =
      filling_order(size, PlaneKernel(options.kernel), options.seed, execution, meter);
  meter.finish();
  return ranks;
}

/// Makes energies into keys that put `first` before all others, in their order, and of equal energies the one
/// with the lower random bits: as many as are free below kSetMark, which no energy up to `most` reaches.
void replace_by_keys(Grid<std::uint32_t>& energies, std::span<const Voxel> first, std::int64_t most,
                     std::uint64_t seed, const Execution& execution) {
  const auto count = static_cast<std::uint64_t>(first.size());
  const int bits =
      std::min(16, std::countr_zero(static_cast<std::uint32_t>(kSetMark)) -
                       static_cast<int>(std::bit_width(static_cast<std::uint64_t>(most) + count + 1)));
  const std::uint32_t mask = (std::uint32_t{1} << bits) - 1;
  const auto after_first = static_cast<std::uint32_t>(count == 0 ? 0 : (count >> bits) + 1);
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  const auto chunks = static_cast<std::int64_t>((energies.count() + kChunk - 1) / kChunk);
  parallel_for(execution, chunks, [&](std::int64_t chunk) {
    const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
    std::uint64_t four = 0;
    for (std::size_t i = begin; i < std::min(begin + kChunk, energies.count()); ++i, four >>= 16) {
      if (i % 4 == 0) four = random_bits(seed, kEqualsStream, i / 4);
      energies[i] = (energies[i] + after_first) << bits | (static_cast<std::uint32_t>(four) & mask);
    }
  });
  const Extent slice{energies.width(), energies.height()};
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    const Voxel& v = first[i];
    energies[static_cast<std::size_t>(v.z * slice.area() + std::int64_t{v.y} * slice.width + v.x)] = i;
  }
}

}  // namespace

Grid<std::uint32_t> volume_mask(const VolumeMaskOptions& options, const Execution& execution) {
  check(options.size);
  check(options.kernel, options.size);
  thread_count(execution);
  if (options.size.z == 1 && options.size.w == 1) return plane_mask(options, execution);

  const auto [width, height, z, w] = options.size;
  const std::uint64_t voxels = static_cast<std::uint64_t>(std::int64_t{width} * height * z * w);
  const std::uint64_t ranking = options.ranks == RankScope::volume ? voxels * sizeof(std::uint32_t) : 0;
  constexpr std::uint64_t kConstantBytes = std::uint64_t{1} << 20;
  check_memory(execution,
               volume_order_bytes(options.size) + ranking +
                   VolumeWeights::bytes(options.size, options.kernel) + kConstantBytes,
               "void-and-cluster volume");

  ProgressMeter meter(execution, voxels);
  const VolumeWeights weights(options.size, options.kernel);
  auto [ranks, first] = volume_order(weights, first_voxels(weights, options.kernel, options.seed, execution),
                                     options.seed, execution, meter);
  replace_by_keys(ranks, first, weights.sum() + kVolumeStartLimit, options.seed, execution);
  if (options.ranks == RankScope::slice) {
    replace_by_ranks_in_slices(ranks, execution);
    reorder_last_voxels(ranks, weights, options.kernel, execution);
  } else {
    std::vector<std::uint32_t> room(ranks.count());
    replace_by_ranks(ranks, room, execution);
  }
  meter.finish();
  return ranks;
}

}  // namespace bn
