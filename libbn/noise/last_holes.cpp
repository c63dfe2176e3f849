#include "noise/last_holes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/reproducible_math.h"
#include "noise/point_grid.h"

namespace bn::noise {
namespace {

/// Holes that see each other through a Gaussian of half their mean distance.
class Holes {
 public:
  Holes(Extent size, const std::vector<Pixel>& holes, const Execution& execution)
      : energy_(holes.size()), next_(holes.size()) {
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
      if (i % 4096 == 0) throw_if_stopped(execution);
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
  while (!holes.empty()) {
    Holes pattern(size, holes, execution);
    const std::size_t half = holes.size() / 2;
    for (std::size_t left = holes.size(); left > half; --left) {
      if (left % 4096 == 0) throw_if_stopped(execution);
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
