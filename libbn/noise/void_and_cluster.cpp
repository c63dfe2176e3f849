// Void-and-cluster (R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE
// 1913, 1993) on a torus, with integer energies.
//
// Definition. Every set pixel adds a Gaussian (gaussian_kernel.h) to the energies around it, itself
// included. Every pixel starts with a random energy of a few low bits, far below the Gaussian's peak,
// which decides where nothing else does. Of equal energies the lowest index y * width + x comes first.
//   1. Initial pattern: on an empty torus, `initial_density` of the pixels are set, always the largest
//      void (the unset pixel of least energy).
//   2. From a copy of that pattern the tightest cluster (the set pixel of greatest energy) is taken
//      away until none is left; the pixel taken away last has rank 0.
//   3. The pattern itself goes on as in 1 until all pixels are set; they get the ranks that follow.
// With an initial density of 0 phase 3 goes on from the first points of first_points.h, the last holes are
// filled in the order of last_holes.h, and masks of small_mask.h are made as the paper has it.
//
// What differs from the paper. Ulichney starts phase 1 from random points and swaps the tightest
// cluster with the largest void until that changes nothing. A pattern made of largest voids only is
// such a fixed point but for a swap or two (tests/noise/quality_test.cpp), so the swaps are left out.
// Ulichney's phases 2 and 3 beyond half the pixels speak of clusters of unset pixels; as the kernel's
// sum is the same everywhere, the tightest of those is the largest void.
//
// Method. Phases 1 and 3 are one run of largest voids. Phase 2 is such a run too: the energy that the
// unset pixels give is a constant minus that of the set ones, so the tightest cluster is the least of
// that. void_order.h finds the order of such a run.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bn/noise.h"
#include "bn/random.h"
#include "core/progress.h"
#include "core/refuse.h"
#include "noise/fill_tile.h"
#include "noise/filling_order.h"
#include "noise/first_points.h"
#include "noise/last_holes.h"
#include "noise/small_mask.h"
#include "noise/start_energies.h"
#include "noise/void_order.h"

namespace bn {
using namespace noise;
namespace {

constexpr int kMaxSide = 16384;
constexpr std::uint32_t kStartStream = 1;  // of random_bits

void check(const VoidAndClusterOptions& options) {
  const auto [width, height] = options.size;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    refuse("size", fmt::format("a mask of {}x{} pixels", width, height),
           fmt::format("1x1..{0}x{0}", kMaxSide));
  }
  // Written so that NaN fails.
  if (!(options.sigma_px >= 0.3 && options.sigma_px <= 16.0)) {
    refuse("sigma_px", fmt::format("a standard deviation of {} pixels", options.sigma_px), "0.3..16");
  }
  if (!(options.initial_density >= 0.0 && options.initial_density <= 0.5)) {
    refuse("initial_density", fmt::format("an initial density of {}", options.initial_density), "0..0.5");
  }
  if (options.cutoff_px < 0 || options.cutoff_px > kMaxKernelRadius) {
    refuse("cutoff_px", fmt::format("a kernel cut-off of {} pixels", options.cutoff_px),
           fmt::format("1..{}, or 0 for where the weight rounds to zero", kMaxKernelRadius));
  }
}

/// Phase 2: gives the pixels whose rank is below `initial` the ranks in which clusters leave them last.
void rank_by_removal(const VoidAndClusterOptions& options, const GaussianKernel& kernel,
                     std::uint32_t initial, Grid<std::uint32_t>& ranks, const Execution& execution,
                     ProgressMeter& meter) {
  // The energy from the unset pixels: all there can be, minus that from the set ones. Unset pixels
  // carry the mark.
  const std::int32_t all = kernel.sum() + kStartEnergyLimit - 1;
  EnergyField field(options.size, kernel.radius(), kSetMark + all);
  for_each_pixel(options.size, options.seed, kStartStream, execution,
                 [&](int x, int y, std::size_t index, std::int32_t start) {
                   field.at(x, y) -= start + (ranks[index] < initial ? kSetMark : 0);
                 });
  const BlockKernel negative(kernel, -1);
  for (int y = 0; y < options.size.height; ++y) {
    throw_if_stopped(execution);
    for (int x = 0; x < options.size.width; ++x) {
      if (ranks(x, y) < initial) add_kernel(field, negative, x, y);
    }
  }
  const Grid<std::uint32_t> removed =
      void_order(std::move(field), BlockKernel(kernel, 1), initial, execution, meter);
  for (std::size_t index = 0; index < ranks.count(); ++index) {
    if (ranks[index] < initial) ranks[index] = initial - 1 - removed[index];
  }
}

/// Phases 1 and 3 on a torus where `first` points are set, which have the lowest ranks.
Grid<std::uint32_t> fill_voids(Extent size, const PixelKernel& kernel, const std::vector<Pixel>& first,
                               std::uint64_t seed, const Execution& execution, ProgressMeter& meter) {
  EnergyField field(size, kernel.radius(), kSetMark);
  write_start_energies(field, seed, kStartStream, execution);
  const BlockKernel blocks(kernel, 1);
  set_points(field, blocks, first);
  const std::int64_t left = size.area() - std::ssize(first);
  Grid<std::uint32_t> ranks = void_order(std::move(field), blocks, left, execution, meter);
  if (!first.empty()) {
    for (std::uint32_t& rank : ranks) rank += static_cast<std::uint32_t>(first.size());
    for (std::uint32_t rank = 0; rank < first.size(); ++rank) ranks(first[rank].x, first[rank].y) = rank;
  }
  return ranks;
}

}  // namespace

Grid<std::uint32_t> noise::filling_order(Extent size, const PixelKernel& kernel, std::uint64_t seed,
                                         const Execution& execution, ProgressMeter& meter) {
  if (size.area() <= kSmallArea) return small_mask(size, kernel, seed);
  const std::vector<Pixel> first = first_points(size, kernel, seed, execution);
  Grid<std::uint32_t> ranks = fill_voids(size, kernel, first, seed, execution, meter);
  reorder_last_holes(ranks, kernel, execution);
  return ranks;
}

std::uint64_t noise::filling_order_bytes(Extent size) {
  // Energies and ranks, 4 bytes for each that is ranked, and what does not grow with the mask.
  constexpr std::uint64_t kConstantBytes = std::uint64_t{1} << 20;
  return EnergyField::bytes(size) + 8 * static_cast<std::uint64_t>(size.area()) + kConstantBytes;
}

Grid<std::uint32_t> void_and_cluster(const VoidAndClusterOptions& options, const Execution& execution) {
  check(options);
  thread_count(execution);
  const auto count = static_cast<std::uint64_t>(options.size.area());
  const auto initial =
      static_cast<std::uint32_t>(std::floor(options.initial_density * static_cast<double>(count) + 0.5));
  // Phase 2 keeps the ranks of phase 1, and needs as much for each that is ranked anew.
  check_memory(execution, filling_order_bytes(options.size) + std::uint64_t{4} * initial,
               "void-and-cluster mask");

  ProgressMeter meter(execution, count + initial);
  const GaussianKernel kernel(options.sigma_px, options.cutoff_px);
  Grid<std::uint32_t> ranks;
  if (initial == 0) {
    ranks = filling_order(options.size, kernel, options.seed, execution, meter);
  } else {
    ranks = fill_voids(options.size, kernel, {}, options.seed, execution, meter);
    rank_by_removal(options, kernel, initial, ranks, execution, meter);
  }
  meter.finish();
  return ranks;
}

}  // namespace bn
