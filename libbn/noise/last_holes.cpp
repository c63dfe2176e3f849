#include "noise/last_holes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/reproducible_math.h"
#include "noise/point_grid.h"

namespace bn::noise {
namespace {

/// Holes that see each other through a Gaussian of half their mean distance.
//
// One after another the hole of greatest energy is filled, the first of equal ones, and its neighbours'
// energies fall. As in void_and_cluster.cpp a hole that comes first of all it sees may be filled at once, and
// the order of (energy when filled, number) is that of filling one at a time. So holes are filled where the
// last ones were, in the cache.
class Holes {
 public:
  Holes(Extent size, const std::vector<Pixel>& holes, const Execution& execution)
      : energy_(holes.size()), when_filled_(holes.size()) {
    // The Gaussian of half the mean distance, sqrt(area / holes), is exp(-t) at t = 2 holes d^2 / area.
    const double steps =
        2.0 * static_cast<double>(holes.size()) * kStepsOfT / static_cast<double>(size.area());
    const double reach_squared = kMostT * kStepsOfT / steps;
    PointGrid grid(size, static_cast<int>(std::sqrt(reach_squared)) + 1);
    for (const Pixel& hole : holes) grid.add(hole);
    const auto most_squared = static_cast<std::int64_t>(reach_squared) + 1;
    const std::vector<std::int32_t>& weights = falloff();
    seen_.reserve(16 * holes.size());
    for (std::size_t i = 0; i < holes.size(); ++i) {
      if (i % 4096 == 0) throw_if_stopped(execution);
      first_.push_back(seen_.size());
      grid.near(holes[i], [&](int other, std::int64_t squared) {
        if (squared > most_squared) return;
        const auto step = static_cast<std::size_t>(static_cast<double>(squared) * steps);
        if (step >= weights.size()) return;
        seen_.push_back({static_cast<std::uint32_t>(other), weights[step]});
        energy_[i] += weights[step];
      });
    }
    first_.push_back(seen_.size());
  }

  /// The numbers of all holes in the order in which they are filled.
  std::vector<std::uint32_t> fill(const Execution& execution) {
    std::vector<std::uint32_t> way;
    for (std::uint32_t start = 0; start < energy_.size(); ++start) {
      if (start % 4096 == 0) throw_if_stopped(execution);
      // To the hole that comes first of what is seen, and on from there; energies grow along the way.
      way.assign(1, start);
      while (!way.empty()) {
        const std::uint32_t first = first_seen(way.back());
        if (first != way.back()) {
          way.push_back(first);
          continue;
        }
        if (energy_[first] >= 0) fill(first);
        way.pop_back();
      }
    }
    return numbers_by_energy();
  }

 private:
  static constexpr std::int32_t kFilled = INT32_MIN / 2;  // and stays negative when more is taken away
  static constexpr int kStepsOfT = 32;
  static constexpr int kMostT = 8;
  static constexpr int kPeak = 256;

  struct Seen {
    std::uint32_t hole;
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

  std::span<const Seen> seen(std::uint32_t hole) const {
    return std::span(seen_).subspan(first_[hole], first_[hole + 1] - first_[hole]);
  }

  std::uint32_t first_seen(std::uint32_t hole) const {
    std::uint32_t first = hole;
    if (energy_[hole] < 0) return first;
    for (const auto& [other, weight] : seen(hole)) {
      if (energy_[other] > energy_[first] || (energy_[other] == energy_[first] && other < first))
        first = other;
    }
    return first;
  }

  void fill(std::uint32_t hole) {
    when_filled_[hole] = energy_[hole];
    for (const auto& [other, weight] : seen(hole)) energy_[other] -= weight;
    energy_[hole] = kFilled;
  }

  /// Greatest energy first, the lower number of equal ones; by counting.
  std::vector<std::uint32_t> numbers_by_energy() const {
    const std::int32_t most = *std::max_element(when_filled_.begin(), when_filled_.end());
    std::vector<std::uint32_t> place(static_cast<std::size_t>(most) + 1);
    const auto at = [&](std::int32_t energy) -> std::uint32_t& {
      return place[static_cast<std::size_t>(most - energy)];
    };
    for (const std::int32_t energy : when_filled_) ++at(energy);
    std::uint32_t sum = 0;
    for (std::uint32_t& count : place) sum += std::exchange(count, sum);
    std::vector<std::uint32_t> numbers(when_filled_.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[at(when_filled_[i])++] = i;
    return numbers;
  }

  std::vector<std::int32_t> energy_;
  std::vector<std::int32_t> when_filled_;
  std::vector<std::size_t> first_;  // of what each hole sees, in seen_
  std::vector<Seen> seen_;          // each hole sees itself too
};

}  // namespace

void reorder_last_holes(Grid<std::uint32_t>& ranks, const PixelKernel& kernel, const Execution& execution) {
  constexpr int kLeastDistance = 7;
  const Extent size{ranks.width(), ranks.height()};
  if (kernel.sight() == 0) return;
  const int apart = std::max(kernel.sight(), kLeastDistance);
  const std::int64_t count = size.area() / (apart * apart);
  auto rank = static_cast<std::uint32_t>(size.area() - count);
  std::vector<Pixel> holes;
  holes.reserve(static_cast<std::size_t>(count));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (ranks(x, y) >= rank) holes.push_back({x, y});
    }
  }
  // Until half of them are filled the kernel stays the same.
  while (!holes.empty()) {
    std::vector<std::uint32_t> order = Holes(size, holes, execution).fill(execution);
    const std::size_t half = (order.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i) ranks(holes[order[i]].x, holes[order[i]].y) = rank++;
    order.erase(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half));
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i) holes[i] = holes[order[i]];
    holes.resize(order.size());
  }
}

}  // namespace bn::noise
