#include "noise/sparse_ends.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bn/random.h"
#include "core/reproducible_math.h"
#include "noise/energy_field.h"
#include "noise/fill_tile.h"
#include "noise/rank_order.h"
#include "noise/start_energies.h"

namespace bn::noise {
namespace {

/// Of the masks of half, a quarter ... of the size.
constexpr double kCoarseSigma = 1.9;
constexpr int kCoarseSight = 11;
/// Start energies are so many times those of the mask, 1/480 of the peak at most: with less chance in them,
/// the few points of the coarsest levels settle into lattices, the same for every seed.
constexpr std::int32_t kCoarseStartFactor = 24;

// Of random_bits; the level is added, 1 for half the size.
constexpr std::uint32_t kCoarseStream = 32;
constexpr std::uint32_t kPlaceStream = 48;

/// How far pixels see each other through the kernel, above the start energies.
int sight(const PixelKernel& kernel) {
  int d = 0;
  while (kernel.weight(d + 1, 0) >= kStartEnergyLimit && kernel.weight(0, d + 1) >= kStartEnergyLimit) ++d;
  return d;
}

/// How many points are so far apart that they do not see each other.
std::int64_t count_beyond(int sight, Extent size) { return size.area() / (sight * sight); }

/// The first `count` largest voids of a field on which `points` are set, in their order. There may be fewer.
void append_largest_voids(EnergyField& field, const PixelKernel& kernel, const BlockKernel& blocks,
                          std::int64_t count, std::vector<Pixel>& points) {
  const Extent size = field.size;
  // Until so many pixels are set, the mean energy of all is below this, so the largest void is too.
  const auto limit = static_cast<std::int32_t>(
      kCoarseStartFactor * kStartEnergyLimit +
      (std::int64_t{kernel.sum()} * (std::ssize(points) + count) + size.area() - 1) / size.area());
  Grid<std::uint32_t> when_set(size, kUnranked);
  constexpr int kRounds = 8;
  const BlockRect all{0, 0, field.blocks_x, field.blocks_y};
  while (*std::min_element(field.minimum.begin(), field.minimum.end()) < limit) {
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

/// Moves points from a torus of half the size, in the order of their ranks, each to that of its pixels which
/// sees the least of those before it.
std::vector<Pixel> spread(const std::vector<Pixel>& points, Extent half, Extent size, std::uint64_t seed,
                          int level) {
  constexpr int kReach = 2 * kCoarseSight;
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
  const std::int64_t from_deeper = std::min(count, count_beyond(kCoarseSight, half));
  if (from_deeper > 0) points = points_by_half(half, from_deeper, kernel, blocks, seed, level + 1, execution);
  if (const std::int64_t left = std::min(count, half.area()) - std::ssize(points); left > 0) {
    EnergyField field(half, kernel.radius(), kSetMark);
    for_each_pixel(
        half, seed, kCoarseStream + static_cast<std::uint32_t>(level), execution,
        [&](int x, int y, std::size_t, std::int32_t start) { field.at(x, y) = kCoarseStartFactor * start; });
    set_points(field, blocks, points);
    append_largest_voids(field, kernel, blocks, left, points);
  }
  return spread(points, half, size, seed, level);
}

/// Holes that see each other through a Gaussian of half their mean distance.
class Holes {
 public:
  Holes(Extent size, const std::vector<Pixel>& holes) : energy_(holes.size()), next_(holes.size()) {
    // The Gaussian of half the mean distance, sqrt(area / holes), is exp(-t) at t = 2 holes d^2 / area.
    const double steps =
        2.0 * static_cast<double>(holes.size()) * kStepsOfT / static_cast<double>(size.area());
    const double reach_squared = kMostT * kStepsOfT / steps;
    PointGrid grid(size, static_cast<int>(std::sqrt(reach_squared)) + 1);
    for (const Pixel& hole : holes) grid.add(hole);
    const auto most_squared = static_cast<std::int64_t>(reach_squared) + 1;
    const std::vector<std::int32_t>& weights = falloff();
    seen_.reserve(24 * holes.size());
    int most = 0;
    for (std::size_t i = 0; i < holes.size(); ++i) {
      first_.push_back(seen_.size());
      grid.near(holes[i], [&](int other, std::int64_t squared) {
        if (squared > most_squared) return;
        const auto step = static_cast<std::size_t>(static_cast<double>(squared) * steps);
        if (step >= weights.size()) return;
        seen_.push_back({other, weights[step]});
        energy_[i] += weights[step];
      });
      most = std::max(most, energy_[i]);
    }
    first_.push_back(seen_.size());
    last_of_.assign(static_cast<std::size_t>(most) + 1, kNone);
    for (int i = static_cast<int>(holes.size()) - 1; i >= 0; --i) enlist(i);
    greatest_ = most;
  }

  /// Fills the hole of greatest energy, the first of equal ones, and returns its number.
  std::size_t fill_tightest() {
    int tightest = kNone;
    while (tightest == kNone) {
      while (last_of_[static_cast<std::size_t>(greatest_)] == kNone) --greatest_;
      // Energies fall, so those in the list may belong into others by now.
      for (int i = std::exchange(last_of_[static_cast<std::size_t>(greatest_)], kNone); i != kNone;) {
        const int next = next_[static_cast<std::size_t>(i)];
        if (energy_[static_cast<std::size_t>(i)] < greatest_ || (tightest != kNone && tightest < i)) {
          enlist(i);
        } else {
          if (tightest != kNone) enlist(tightest);
          tightest = i;
        }
        i = next;
      }
    }
    const auto filled = static_cast<std::size_t>(tightest);
    for (std::size_t i = first_[filled]; i < first_[filled + 1]; ++i) {
      energy_[static_cast<std::size_t>(seen_[i].hole)] -= seen_[i].weight;
    }
    energy_[filled] = kFilled;
    return filled;
  }

  bool is_filled(std::size_t hole) const { return energy_[hole] < 0; }

 private:
  static constexpr int kNone = -1;
  static constexpr std::int32_t kFilled = INT32_MIN / 2;  // and stays negative when more is taken away
  static constexpr int kStepsOfT = 32;
  static constexpr int kMostT = 8;
  static constexpr int kPeak = 256;

  struct Seen {
    int hole;
    std::int32_t weight;
  };

  static const std::vector<std::int32_t>& falloff() {
    static const std::vector<std::int32_t> values = [] {
      std::vector<std::int32_t> of_step;
      for (int i = 0; i < kStepsOfT * kMostT; ++i) {
        of_step.push_back(static_cast<std::int32_t>(kPeak * reproducible_exp(-(i + 0.5) / kStepsOfT)));
      }
      return of_step;
    }();
    return values;
  }

  void enlist(int hole) {
    const auto energy = static_cast<std::size_t>(energy_[static_cast<std::size_t>(hole)]);
    next_[static_cast<std::size_t>(hole)] = std::exchange(last_of_[energy], hole);
  }

  std::vector<std::int32_t> energy_;
  std::vector<std::size_t> first_;  // of what each hole sees, in seen_
  std::vector<Seen> seen_;
  std::vector<int> last_of_;  // lists of the unfilled holes by energy, or by one that they had
  std::vector<int> next_;
  int greatest_ = 0;
};

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
  const int seen = sight(kernel);
  const std::int64_t count = count_beyond(2 * std::max(seen, kLeastSight), size);
  if (seen == 0 || count == 0) return {};
  static const GaussianKernel coarse(kCoarseSigma, 0);
  static const BlockKernel blocks(coarse, 1);
  return points_by_half(size, count, coarse, blocks, seed, 1, execution);
}

void reorder_last_holes(Grid<std::uint32_t>& ranks, const PixelKernel& kernel, const Execution& execution) {
  constexpr int kLeastSightOfHoles = 7;
  const Extent size{ranks.width(), ranks.height()};
  const int seen = sight(kernel);
  if (seen == 0) return;
  const std::int64_t count = count_beyond(std::max(seen, kLeastSightOfHoles), size);
  auto rank = static_cast<std::uint32_t>(size.area() - count);
  std::vector<Pixel> holes;
  holes.reserve(static_cast<std::size_t>(count));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (ranks(x, y) >= rank) holes.push_back({x, y});
    }
  }
  while (!holes.empty()) {
    throw_if_stopped(execution);
    Holes pattern(size, holes);
    const std::size_t half = holes.size() / 2;
    for (std::size_t left = holes.size(); left > half; --left) {
      const Pixel filled = holes[pattern.fill_tightest()];
      ranks(filled.x, filled.y) = rank++;
    }
    std::vector<Pixel> still;
    for (std::size_t i = 0; i < holes.size(); ++i) {
      if (!pattern.is_filled(i)) still.push_back(holes[i]);
    }
    holes = std::move(still);
  }
}

}  // namespace bn::noise
