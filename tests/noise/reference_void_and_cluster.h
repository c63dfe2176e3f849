// Void-and-cluster written down as plainly as it can be: the specification that the fast path must
// equal.

#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "bn/noise.h"
#include "bn/random.h"
#include "core/reproducible_math.h"
#include "noise/first_points.h"
#include "noise/gaussian_kernel.h"
#include "noise/last_holes.h"
#include "noise/spectral_unevenness.h"

namespace bn {

class PlainPattern {
 public:
  explicit PlainPattern(const VoidAndClusterOptions& options, std::uint32_t stream = 1)
      : energy(options.size), is_set(options.size, 0), kernel_(options.sigma_px, options.cutoff_px) {
    for (std::size_t i = 0; i < energy.count(); ++i) {
      energy[i] =
          static_cast<std::int32_t>(random_bits(options.seed, stream, i / 4) >> (16 * (i % 4)) & 0xFFF);
    }
  }

  void set(std::size_t pixel) { change(pixel, 1); }
  void unset(std::size_t pixel) { change(pixel, -1); }

  /// The unset pixel of least energy; the lowest index of equal ones.
  std::size_t largest_void() const {
    std::size_t best = energy.count();
    for (std::size_t i = 0; i < energy.count(); ++i) {
      if (!is_set[i] && (best == energy.count() || energy[i] < energy[best])) best = i;
    }
    return best;
  }

  /// The set pixel of greatest energy; the lowest index of equal ones.
  std::size_t tightest_cluster() const {
    std::size_t best = energy.count();
    for (std::size_t i = 0; i < energy.count(); ++i) {
      if (is_set[i] && (best == energy.count() || energy[i] > energy[best])) best = i;
    }
    return best;
  }

  Grid<std::int32_t> energy;
  Grid<char> is_set;

  /// How far pixels see each other above the start energies.
  std::int64_t sight() const {
    int d = 0;
    while (kernel_.weight(d + 1, 0) >= 1 << 12) ++d;
    return d;
  }

 private:
  void change(std::size_t pixel, int sign) {
    const auto width = static_cast<std::size_t>(energy.width());
    const int x = static_cast<int>(pixel % width);
    const int y = static_cast<int>(pixel / width);
    for (int dy = -kernel_.radius(); dy <= kernel_.radius(); ++dy) {
      for (int dx = -kernel_.radius(); dx <= kernel_.radius(); ++dx) {
        energy(wrap(x + dx, energy.width()), wrap(y + dy, energy.height())) += sign * kernel_.weight(dx, dy);
      }
    }
    is_set[pixel] = sign > 0;
  }

  noise::GaussianKernel kernel_;
};

inline std::int64_t squared_distance(Extent size, std::size_t a, std::size_t b) {
  const auto width = static_cast<std::size_t>(size.width);
  const std::int64_t dx = wrap_centred(static_cast<int>(a % width) - static_cast<int>(b % width), size.width);
  const std::int64_t dy =
      wrap_centred(static_cast<int>(a / width) - static_cast<int>(b / width), size.height);
  return dx * dx + dy * dy;
}

/// The first `count` points, those of a mask of half the size moved to its pixels (first_points.h).
inline std::vector<std::size_t> reference_first_points(Extent size, std::int64_t count, std::uint64_t seed,
                                                       std::uint32_t level = 1) {
  const Extent half{std::max(size.width / 2, 1), std::max(size.height / 2, 1)};
  count = std::min(count, half.area());
  std::vector<std::size_t> points;
  if (const std::int64_t deeper = std::min(count, half.area() / 121); deeper > 0) {
    points = reference_first_points(half, deeper, seed, level + 1);
  }
  PlainPattern pattern({.size = half, .seed = seed}, 32 + level);
  for (std::int32_t& energy : pattern.energy) energy *= 24;
  for (const std::size_t point : points) pattern.set(point);
  while (std::ssize(points) < count) {
    points.push_back(pattern.largest_void());
    pattern.set(points.back());
  }

  std::vector<std::size_t> moved;
  for (const std::size_t point : points) {
    const std::uint64_t chance = random_bits(seed, 48 + level, moved.size());
    std::pair<std::int64_t, std::size_t> best{INT64_MAX, 0};
    for (int tried = 0; tried < (level == 1 ? 1 : 4); ++tried) {
      const auto place = (static_cast<std::size_t>(chance >> 62) + static_cast<std::size_t>(tried)) % 4;
      const auto along = [](std::size_t at, std::size_t right, int coarse, int fine) {
        return (2 * at + right) * static_cast<std::size_t>(fine) / static_cast<std::size_t>(2 * coarse);
      };
      const auto half_width = static_cast<std::size_t>(half.width);
      const std::size_t to = along(point / half_width, place / 2, half.height, size.height) *
                                 static_cast<std::size_t>(size.width) +
                             along(point % half_width, place % 2, half.width, size.width);
      auto energy = static_cast<std::int64_t>(chance >> (8 * tried) & 0xFF);
      for (const std::size_t other : moved) {
        const std::int64_t d = squared_distance(size, to, other);
        if (d <= 22 * 22) {
          energy += static_cast<std::int64_t>(
              std::floor(reproducible_exp(-static_cast<double>(d) / (8.0 * 1.9 * 1.9)) * (1 << 24)));
        }
      }
      best = std::min(best, {energy, to}, [](const auto& a, const auto& b) { return a.first < b.first; });
    }
    moved.push_back(best.second);
  }
  return moved;
}

/// The holes in the order in which they are filled: always the one that has the others nearest, seen through
/// a Gaussian of half their mean distance, which changes when half of them are filled.
inline std::vector<std::size_t> reference_last_holes(Extent size, std::vector<std::size_t> holes) {
  std::vector<std::size_t> order;
  while (!holes.empty()) {
    const double steps =
        2.0 * static_cast<double>(holes.size()) * 32 / static_cast<double>(size.area());  // of 1/32 of t
    const std::size_t half = holes.size() / 2;
    while (holes.size() > half) {
      std::pair<int, std::size_t> tightest{-1, 0};
      for (std::size_t i = 0; i < holes.size(); ++i) {
        int energy = 0;
        for (const std::size_t other : holes) {
          const auto step =
              static_cast<int>(static_cast<double>(squared_distance(size, holes[i], other)) * steps);
          if (step < 32 * 8) energy += static_cast<int>(256 * reproducible_exp(-(step + 0.5) / 32));
        }
        if (energy > tightest.first) tightest = {energy, i};
      }
      order.push_back(holes[tightest.second]);
      holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(tightest.second));
    }
  }
  return order;
}

/// Masks of 19 x 19 pixels and fewer: from a fifth of the pixels, at random, whose tightest cluster is moved
/// into the largest void until that changes nothing.
inline std::uint32_t reference_small_start(const VoidAndClusterOptions& options, std::size_t number,
                                           PlainPattern& pattern) {
  const std::size_t count = pattern.energy.count();
  std::vector<std::pair<std::uint64_t, std::size_t>> chance;
  for (std::size_t i = 0; i < count; ++i)
    chance.push_back({random_bits(options.seed, 5, number * count + i), i});
  std::sort(chance.begin(), chance.end());
  const std::size_t initial = std::max<std::size_t>(chance.size() / 5, 1);
  for (std::size_t i = 0; i < initial; ++i) pattern.set(chance[i].second);
  for (std::size_t swap = 0; swap < 10 * initial; ++swap) {
    const std::size_t cluster = pattern.tightest_cluster();
    pattern.unset(cluster);
    const std::size_t hole = pattern.largest_void();
    pattern.set(hole);
    if (hole == cluster) break;
  }
  return static_cast<std::uint32_t>(initial);
}

inline bool is_small(const VoidAndClusterOptions& options) {
  return options.initial_density == 0.0 && options.size.area() <= 19 * 19;
}

/// Of more than 19 x 19 pixels, without an initial pattern.
inline bool has_sparse_ends(const VoidAndClusterOptions& options, const PlainPattern& pattern) {
  return options.initial_density == 0.0 && options.size.area() > 19 * 19 && pattern.sight() > 0;
}

/// Sets the first points, gives them their ranks and returns their number.
inline std::uint32_t set_first_points(const std::vector<std::size_t>& points, PlainPattern& pattern,
                                      Grid<std::uint32_t>& ranks) {
  for (std::uint32_t rank = 0; rank < points.size(); ++rank) {
    pattern.set(points[rank]);
    ranks[points[rank]] = rank;
  }
  return static_cast<std::uint32_t>(points.size());
}

/// The number-th of the masks from which a small one is chosen; of others there is one.
inline Grid<std::uint32_t> reference_mask(const VoidAndClusterOptions& options, std::size_t number) {
  Grid<std::uint32_t> ranks(options.size);
  const auto count = static_cast<std::uint32_t>(ranks.count());
  PlainPattern pattern(options);
  const bool sparse_ends = has_sparse_ends(options, pattern);

  // Phase 1: the initial pattern.
  std::uint32_t first = 0;
  auto initial = static_cast<std::uint32_t>(std::floor(options.initial_density * count + 0.5));
  if (sparse_ends) {
    const std::int64_t apart = 2 * std::max<std::int64_t>(pattern.sight(), 4);
    first = set_first_points(reference_first_points(options.size, count / (apart * apart), options.seed),
                             pattern, ranks);
  } else if (is_small(options)) {
    initial = reference_small_start(options, number, pattern);
  } else {
    for (std::uint32_t rank = 0; rank < initial; ++rank) pattern.set(pattern.largest_void());
  }
  // Phase 2: clusters are taken away from a copy of it, the tightest first; the first gets the highest
  // rank.
  PlainPattern shrinking = pattern;
  for (std::uint32_t rank = initial; rank-- > 0;) {
    const std::size_t pixel = shrinking.tightest_cluster();
    shrinking.unset(pixel);
    ranks[pixel] = rank;
  }
  // Phase 3: the voids are filled, the largest first.
  for (std::uint32_t rank = std::max(initial, first); rank < count; ++rank) {
    const std::size_t pixel = pattern.largest_void();
    pattern.set(pixel);
    ranks[pixel] = rank;
  }
  // The last holes in another order.
  if (sparse_ends) {
    const std::int64_t apart = std::max<std::int64_t>(pattern.sight(), 7);
    const auto first_hole = static_cast<std::uint32_t>(count - count / (apart * apart));
    std::vector<std::size_t> holes;
    for (std::size_t i = 0; i < ranks.count(); ++i) {
      if (ranks[i] >= first_hole) holes.push_back(i);
    }
    std::uint32_t rank = first_hole;
    for (const std::size_t pixel : reference_last_holes(options.size, holes)) ranks[pixel] = rank++;
  }
  return ranks;
}

/// The same for masks too large for the above and an initial density of 0: a queue that holds every
/// unset pixel with an energy it once had, put back with the present one when it comes up too early. The
/// sparse ends are those of the product.
inline Grid<std::uint32_t> queue_void_and_cluster(const VoidAndClusterOptions& options) {
  PlainPattern pattern(options);
  Grid<std::uint32_t> ranks(options.size);
  const noise::GaussianKernel kernel(options.sigma_px, options.cutoff_px);
  std::vector<std::size_t> points;
  for (const auto& [x, y] : noise::first_points(options.size, kernel, options.seed, {})) {
    points.push_back(static_cast<std::size_t>(std::int64_t{y} * options.size.width + x));
  }
  std::uint32_t rank = set_first_points(points, pattern, ranks);
  using Entry = std::pair<std::int32_t, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = 0; i < pattern.energy.count(); ++i) {
    if (!pattern.is_set[i]) queue.push({pattern.energy[i], i});
  }
  while (!queue.empty()) {
    const auto [energy, pixel] = queue.top();
    queue.pop();
    if (energy != pattern.energy[pixel]) {
      queue.push({pattern.energy[pixel], pixel});
    } else {
      pattern.set(pixel);
      ranks[pixel] = rank++;
    }
  }
  noise::reorder_last_holes(ranks, kernel, {});
  return ranks;
}

inline Grid<std::uint32_t> reference_void_and_cluster(const VoidAndClusterOptions& options) {
  Grid<std::uint32_t> best = reference_mask(options, 0);
  for (std::size_t number = 1; is_small(options) && number < 16; ++number) {
    Grid<std::uint32_t> mask = reference_mask(options, number);
    if (noise::spectral_unevenness(mask) < noise::spectral_unevenness(best)) best = std::move(mask);
  }
  return best;
}

}  // namespace bn
