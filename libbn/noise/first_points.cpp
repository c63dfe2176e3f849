#include "noise/first_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bn/random.h"
#include "core/reproducible_math.h"
#include "noise/fill_tile.h"
#include "noise/rank_order.h"
#include "noise/start_energies.h"

namespace bn::noise {
namespace {

/// Of the masks of half, a quarter ... of the size: their kernel, and how far it reaches. Points that are
/// farther apart come from the next one.
constexpr double kCoarseSigma = 1.9;
constexpr int kCoarseRadius = 11;
/// Start energies are so many times those of the mask, 1/480 of the peak at most: with less chance in them,
/// the few points of the coarsest levels settle into lattices, the same for every seed.
constexpr std::int32_t kCoarseStartFactor = 24;

// Of random_bits; the level is added, 1 for half the size.
constexpr std::uint32_t kCoarseStream = 32;
constexpr std::uint32_t kPlaceStream = 48;

/// How many points are `distance` pixels apart, about.
std::int64_t count_apart(int distance, Extent size) { return size.area() / (distance * distance); }

/// The first `count` largest voids of a field on which `points` are set, in their order. There may be fewer.
void append_largest_voids(EnergyField& field, const PixelKernel& kernel, const BlockKernel& blocks,
                          std::int64_t count, const Execution& execution, std::vector<Pixel>& points) {
  const Extent size = field.size;
  // Until so many pixels are set, the mean energy of all is below this, so the largest void is too.
  const auto limit = static_cast<std::int32_t>(
      kCoarseStartFactor * kStartEnergyLimit +
      (std::int64_t{kernel.sum()} * (std::ssize(points) + count) + size.area() - 1) / size.area());
  Grid<std::uint32_t> when_set(size, kUnranked);
  constexpr int kRounds = 8;
  const BlockRect all{0, 0, field.blocks_x, field.blocks_y};
  while (*std::min_element(field.minimum.begin(), field.minimum.end()) < limit) {
    throw_if_stopped(execution);
    if (fill_tile(field, blocks, all, kRounds, when_set.data()) == 0) break;
  }
  using Void = std::pair<std::uint32_t, std::uint32_t>;  // energy, index
  std::vector<Void> voids;
  for (std::uint32_t i = 0; i < when_set.count(); ++i) {
    if (when_set[i] < static_cast<std::uint32_t>(limit)) voids.push_back({when_set[i], i});
  }
  std::sort(voids.begin(), voids.end());
  voids.resize(std::min(voids.size(), static_cast<std::size_t>(count)));
  for (const auto& [energy, index] : voids) {
    const int i = static_cast<int>(index);
    points.push_back({i % size.width, i / size.width});
  }
}

/// Moves points from a torus of half the size, in the order of their ranks, each to that of its four pixels
/// which sees the least of those before it; at level 1, after which the mask's own points come between them,
/// to any.
std::vector<Pixel> spread(const std::vector<Pixel>& points, Extent half, Extent size, std::uint64_t seed,
                          int level, const Execution& execution) {
  constexpr int kReach = 2 * kCoarseRadius;
  static const std::vector<std::int32_t> weights = [] {
    std::vector<std::int32_t> by_distance;  // squared
    for (int d = 0; d <= kReach * kReach; ++d) {
      const double gauss = reproducible_exp(-d / (8.0 * kCoarseSigma * kCoarseSigma));
      by_distance.push_back(static_cast<std::int32_t>(std::floor(gauss * (1 << 24))));
    }
    return by_distance;
  }();
  PointGrid grid(size, kReach);
  std::vector<Pixel> moved;
  moved.reserve(points.size());
  for (const Pixel& p : points) {
    if (moved.size() % 4096 == 0) throw_if_stopped(execution);
    // Where nothing is in sight, chance decides.
    std::uint64_t chance = random_bits(seed, kPlaceStream + static_cast<std::uint32_t>(level), moved.size());
    std::pair<std::int32_t, Pixel> best{INT32_MAX, {}};
    const auto first = static_cast<int>(chance >> 62);
    for (int tried = 0; tried < (level == 1 ? 1 : 4); ++tried, chance >>= 8) {
      const int i = (first + tried) % 4;
      const auto along = [](int at, int right, int coarse, int fine) {
        return static_cast<int>(std::int64_t{2 * at + right} * fine / (2 * coarse));
      };
      const Pixel to{along(p.x, i % 2, half.width, size.width), along(p.y, i / 2, half.height, size.height)};
      auto energy = static_cast<std::int32_t>(chance & 0xFF);
      grid.near(to, [&](int, std::int64_t squared) {
        if (squared <= kReach * kReach) energy += weights[static_cast<std::size_t>(squared)];
      });
      if (energy < best.first) best = {energy, to};
    }
    moved.push_back(best.second);
    grid.add(best.second);
  }
  return moved;
}

/// The first `count` points of a torus, by those of half its size.
std::vector<Pixel> points_by_half(Extent size, std::int64_t count, const PixelKernel& kernel,
                                  const BlockKernel& blocks, std::uint64_t seed, int level,
                                  const Execution& execution) {
  const Extent half{std::max(size.width / 2, 1), std::max(size.height / 2, 1)};
  std::vector<Pixel> points;
  const std::int64_t from_deeper = std::min(count, count_apart(kCoarseRadius, half));
  if (from_deeper > 0) points = points_by_half(half, from_deeper, kernel, blocks, seed, level + 1, execution);
  if (const std::int64_t left = std::min(count, half.area()) - std::ssize(points); left > 0) {
    EnergyField field(half, kernel.radius(), kSetMark);
    for_each_pixel(
        half, seed, kCoarseStream + static_cast<std::uint32_t>(level), execution,
        [&](int x, int y, std::size_t, std::int32_t start) { field.at(x, y) = kCoarseStartFactor * start; });
    set_points(field, blocks, points);
    append_largest_voids(field, kernel, blocks, left, execution, points);
  }
  return spread(points, half, size, seed, level, execution);
}

}  // namespace

void set_points(EnergyField& field, const BlockKernel& kernel, const std::vector<Pixel>& points) {
  field.update_minima();
  for (const Pixel& p : points) {
    field.at(p.x, p.y) += kSetMark;
    add_kernel(field, kernel, p.x, p.y);
  }
}

std::vector<Pixel> first_points(Extent size, const PixelKernel& kernel, std::uint64_t seed,
                                const Execution& execution) {
  constexpr int kLeastSight = 4;
  const int seen = kernel.sight();
  const std::int64_t count = count_apart(2 * std::max(seen, kLeastSight), size);
  if (seen == 0 || count == 0) return {};
  static const GaussianKernel coarse(kCoarseSigma, 0);
  static const BlockKernel blocks(coarse, 1);
  return points_by_half(size, count, coarse, blocks, seed, 1, execution);
}

}  // namespace bn::noise
