#include "noise/small_mask.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "bn/random.h"
#include "noise/spectral_unevenness.h"
#include "noise/start_energies.h"

namespace bn::noise {
namespace {

constexpr std::uint32_t kStartStream = 1;   // of random_bits
constexpr std::uint32_t kRandomStream = 5;  // the initial points

constexpr std::uint64_t kMasks = 16;  // the best is taken

/// Pixels that are set, and what they add to the energies of all.
class Pattern {
 public:
  Pattern(Extent size, const PixelKernel& kernel, std::uint64_t seed)
      : size_(size), weights_({2 * size.width, size.height}), energy_(size), is_set_(size) {
    for (int y = -kernel.radius(); y <= kernel.radius(); ++y) {
      for (int x = -kernel.radius(); x <= kernel.radius(); ++x) {
        const int at = wrap(x, size.width), row = wrap(y, size.height);
        weights_(at, row) += kernel.weight(x, y);
        weights_(at + size.width, row) += kernel.weight(x, y);
      }
    }
    StartEnergies start(seed, kStartStream, 0);
    for (std::int32_t& energy : energy_) energy = start.next();
  }

  void set(std::size_t pixel) { change(pixel, 1); }
  void unset(std::size_t pixel) { change(pixel, -1); }
  /// The unset pixel of least energy; the lowest index of equal ones.
  std::size_t largest_void() const {
    return first_of(false, [](auto a, auto b) { return a < b; });
  }
  /// The set pixel of greatest energy; the lowest index of equal ones.
  std::size_t tightest_cluster() const {
    return first_of(true, [](auto a, auto b) { return a > b; });
  }

 private:
  template <class Before>
  std::size_t first_of(bool set, const Before& before) const {
    std::size_t best = energy_.count();
    for (std::size_t i = 0; i < energy_.count(); ++i) {
      if ((is_set_[i] != 0) == set && (best == energy_.count() || before(energy_[i], energy_[best])))
        best = i;
    }
    return best;
  }

  void change(std::size_t pixel, int sign) {
    const int x = static_cast<int>(pixel) % size_.width;
    const int y = static_cast<int>(pixel) / size_.width;
    std::int32_t* energy = energy_.data();
    for (int row = 0; row < size_.height; ++row, energy += size_.width) {
      const std::int32_t* weights = &weights_(size_.width - x, wrap(row - y, size_.height));
      for (int column = 0; column < size_.width; ++column) energy[column] += sign * weights[column];
    }
    is_set_[pixel] = sign > 0;
  }

  Extent size_;
  Grid<std::int32_t> weights_;  // by distance around the torus, twice along x
  Grid<std::int32_t> energy_;
  Grid<char> is_set_;
};

/// The first pixels in the number-th random order.
std::vector<std::size_t> random_pixels(std::size_t count, std::size_t of, std::uint64_t seed,
                                       std::uint64_t number) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < of; ++i)
    order.push_back({random_bits(seed, kRandomStream, number * of + i), i});
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < count; ++i) pixels.push_back(order[i].second);
  return pixels;
}

/// Void-and-cluster from the number-th random points.
Grid<std::uint32_t> textbook_mask(Extent size, const PixelKernel& kernel, std::uint64_t seed,
                                  std::uint64_t number) {
  const auto count = static_cast<std::size_t>(size.area());
  const std::size_t initial = std::max<std::size_t>(count / 5, 1);
  Pattern pattern(size, kernel, seed);
  for (const std::size_t pixel : random_pixels(initial, count, seed, number)) pattern.set(pixel);
  // Every swap lessens the energy of the pattern, but among equal ones it could go around.
  for (std::size_t swaps = 0; swaps < 10 * initial; ++swaps) {
    const std::size_t cluster = pattern.tightest_cluster();
    pattern.unset(cluster);
    const std::size_t hole = pattern.largest_void();
    pattern.set(hole);
    if (hole == cluster) break;
  }

  Grid<std::uint32_t> ranks(size);
  Pattern shrinking = pattern;
  for (std::size_t rank = initial; rank-- > 0;) {
    const std::size_t pixel = shrinking.tightest_cluster();
    shrinking.unset(pixel);
    ranks[pixel] = static_cast<std::uint32_t>(rank);
  }
  for (std::size_t rank = initial; rank < count; ++rank) {
    const std::size_t pixel = pattern.largest_void();
    pattern.set(pixel);
    ranks[pixel] = static_cast<std::uint32_t>(rank);
  }
  return ranks;
}

}  // namespace

Grid<std::uint32_t> small_mask(Extent size, const PixelKernel& kernel, std::uint64_t seed) {
  Grid<std::uint32_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t number = 0; number < kMasks; ++number) {
    Grid<std::uint32_t> mask = textbook_mask(size, kernel, seed, number);
    const double unevenness = spectral_unevenness(mask);
    if (unevenness >= least) continue;
    least = unevenness;
    best = std::move(mask);
  }
  return best;
}

}  // namespace bn::noise
