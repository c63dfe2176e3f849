// Void-and-cluster written down as plainly as it can be: the specification that the fast path must
// equal.

#pragma once

#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "bn/noise.h"
#include "bn/random.h"
#include "noise/gaussian_kernel.h"

namespace bn {

class PlainPattern {
 public:
  explicit PlainPattern(const VoidAndClusterOptions& options)
      : energy(options.size), is_set(options.size, 0), kernel_(options.sigma_px, options.cutoff_px) {
    for (std::size_t i = 0; i < energy.count(); ++i) {
      energy[i] = static_cast<std::int32_t>(random_bits(options.seed, 1, i / 4) >> (16 * (i % 4)) & 0xFFF);
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

inline Grid<std::uint32_t> reference_void_and_cluster(const VoidAndClusterOptions& options) {
  Grid<std::uint32_t> ranks(options.size);
  const auto count = static_cast<std::uint32_t>(ranks.count());
  const auto initial = static_cast<std::uint32_t>(std::floor(options.initial_density * count + 0.5));

  // Phase 1: the initial pattern.
  PlainPattern pattern(options);
  for (std::uint32_t rank = 0; rank < initial; ++rank) {
    const std::size_t pixel = pattern.largest_void();
    pattern.set(pixel);
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
  for (std::uint32_t rank = initial; rank < count; ++rank) {
    const std::size_t pixel = pattern.largest_void();
    pattern.set(pixel);
    ranks[pixel] = rank;
  }
  return ranks;
}

/// The same for masks too large for the above and an initial density of 0: a queue that holds every
/// unset pixel with an energy it once had, put back with the present one when it comes up too early.
inline Grid<std::uint32_t> queue_void_and_cluster(const VoidAndClusterOptions& options) {
  PlainPattern pattern(options);
  using Entry = std::pair<std::int32_t, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = 0; i < pattern.energy.count(); ++i) queue.push({pattern.energy[i], i});
  Grid<std::uint32_t> ranks(options.size);
  for (std::uint32_t rank = 0; !queue.empty();) {
    const auto [energy, pixel] = queue.top();
    queue.pop();
    if (energy != pattern.energy[pixel]) {
      queue.push({pattern.energy[pixel], pixel});
    } else {
      pattern.set(pixel);
      ranks[pixel] = rank++;
    }
  }
  return ranks;
}

}  // namespace bn
