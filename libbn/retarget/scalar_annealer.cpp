// The scalar annealer: the specification of the method, one swap at a time.
//
// A proposal draws a position p and a displacement s, both uniformly, and swaps the seeds at p and p + s if
// both stay within reach of their origins and the Metropolis rule takes the change of energy. Drawing is
// symmetric, so the chain's distribution at a constant temperature is Boltzmann's over the permutations
// within reach (N. Metropolis et al. 1953). The energy is a policy, a type with energy(), change(p, q) and
// swap(p, q), so no virtual call is made per proposal.
//
// Randomness: proposal i of sweep s of round r draws the Philox block of counter (r low, r high and s, stream
// and chain, i) under the seed.

#include <numeric>

#include "anneal/metropolis.h"
#include "bn/random.h"
#include "retarget/anneal_engine.h"
#include "retarget/filtered_energy.h"

namespace bn::retarget {
namespace {

using anneal::metropolis_threshold;
using anneal::single_temperature;

/// Stream of random numbers; chains count up from it.
constexpr std::uint32_t kScalarStream = 0x53000000u;
/// Of the pairs that rises are sampled from.
constexpr std::uint32_t kRiseStream = 0x54000000u;

/// The sum over pixels, level by level.
class PixelSumEnergy {
 public:
  explicit PixelSumEnergy(const AnnealInstance& instance)
      : instance_(&instance), level_(instance.seed_level) {}

  void place(const std::vector<std::int32_t>& origin) {
    for (std::size_t c = 0; c < level_.size(); ++c) {
      for (std::size_t w = 0; w < origin.size(); ++w) {
        level_[c][w] = instance_->seed_level[c][static_cast<std::size_t>(origin[w])];
      }
    }
  }
  std::int64_t energy() const {
    std::int64_t sum = 0;
    for (std::size_t w = 0; w < level_[0].count(); ++w) {
      for (std::size_t c = 0; c < level_.size(); ++c) sum += cost(c, w, w);
    }
    return sum;
  }
  std::int64_t change(std::size_t p, std::size_t q) const {
    std::int64_t sum = 0;
    for (std::size_t c = 0; c < level_.size(); ++c)
      sum += cost(c, p, q) + cost(c, q, p) - cost(c, p, p) - cost(c, q, q);
    return sum;
  }
  void swap(std::size_t p, std::size_t q) {
    for (auto& channel : level_) std::swap(channel[p], channel[q]);
  }

 private:
  /// Of the seed now at `from`, at position `at`.
  std::int64_t cost(std::size_t c, std::size_t from, std::size_t at) const {
    return instance_->weight[c] *
           level_cost(level_[c][from], instance_->landing_level[c][at], instance_->options.metric);
  }
  const AnnealInstance* instance_;
  std::vector<Grid<std::int32_t>> level_;  ///< of the seed at each position
};

/// The blurred residual.
class FilteredEnergy {
 public:
  explicit FilteredEnergy(const AnnealInstance& instance)
      : instance_(&instance),
        kernel_(instance.size, instance.residual_sigma_px, largest_residual(instance)),
        level_(instance.seed_level) {}

  void place(const std::vector<std::int32_t>& origin) {
    fields_.clear();
    for (std::size_t c = 0; c < level_.size(); ++c) {
      Grid<std::int64_t> residual(instance_->size);
      for (std::size_t w = 0; w < origin.size(); ++w) {
        level_[c][w] = instance_->seed_level[c][static_cast<std::size_t>(origin[w])];
        residual[w] = level_[c][w] - instance_->landing_level[c][w];
      }
      fields_.emplace_back(kernel_, std::move(residual));
    }
  }
  std::int64_t energy() const {
    std::int64_t sum = 0;
    for (std::size_t c = 0; c < fields_.size(); ++c) sum += instance_->weight[c] * fields_[c].energy();
    return sum;
  }
  std::int64_t change(std::size_t p, std::size_t q) const {
    std::int64_t sum = 0;
    for (std::size_t c = 0; c < fields_.size(); ++c) {
      sum += instance_->weight[c] * fields_[c].change(p, q, level_[c][q] - level_[c][p]);
    }
    return sum;
  }
  void swap(std::size_t p, std::size_t q) {
    for (std::size_t c = 0; c < fields_.size(); ++c) {
      const std::int64_t amount = level_[c][q] - level_[c][p];
      if (amount != 0) fields_[c].apply(p, q, amount);
      std::swap(level_[c][p], level_[c][q]);
    }
  }

 private:
  /// Weights count as part of it, so that their sum stays within bounds too.
  static std::int64_t largest_residual(const AnnealInstance& instance) {
    std::int64_t sum = 0;
    for (std::size_t c = 0; c < instance.weight.size(); ++c) {
      std::int32_t most = 0;
      for (const std::int32_t level : instance.seed_level[c]) most = std::max(most, level);
      for (const std::int32_t level : instance.landing_level[c]) most = std::max(most, level);
      sum += instance.weight[c] * most;
    }
    return sum;
  }
  const AnnealInstance* instance_;
  ResidualKernel kernel_;
  std::vector<Grid<std::int32_t>> level_;
  std::vector<ResidualField> fields_;
};

template <class Energy>
class ScalarEngine final : public RetargetEngine {
 public:
  ScalarEngine(const AnnealInstance& instance, std::uint64_t seed, std::uint32_t chain)
      : RetargetEngine(instance), seed_(seed), chain_(chain), model_(instance) {
    place(instance.identity());
  }

  RoundCounts sweeps(std::int64_t round, int first, int end, double temperature, const Execution&,
                     WorseningCounts* worsenings) override {
    RoundCounts counts;
    if (instance_.displacements.empty()) return counts;
    const float t = single_temperature(temperature);
    const auto pixels = static_cast<std::uint32_t>(instance_.size.area());
    for (int sweep = first; sweep < end; ++sweep) {
      const bool watched = worsenings != nullptr && sweep >= end - worsenings->sweeps;
      // A sweep proposes half as many swaps as there are pixels, like a sweep of the other engine.
      const std::uint32_t proposals = std::max(1u, pixels / 2);
      for (std::uint32_t i = 0; i < proposals; ++i) {
        const auto draw =
            philox({static_cast<std::uint32_t>(round),
                    static_cast<std::uint32_t>(round >> 32) ^ static_cast<std::uint32_t>(sweep) << 24,
                    kScalarStream + chain_, i},
                   {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
        propose(draw, t, counts, watched ? worsenings : nullptr);
      }
    }
    return counts;
  }

  std::int64_t energy() const override { return energy_; }

  Placement displacements() const override { return displacements_of(origin_); }
  void keep() override { kept_ = origin_; }
  Placement kept() const override { return displacements_of(kept_); }

  void place(const Placement& displacement_at) override {
    origin_.resize(displacement_at.xy.count());
    for (std::size_t w = 0; w < origin_.size(); ++w) {
      const Shift at = instance_.position(w), k = displacement_at.at(w);
      origin_[w] = static_cast<std::int32_t>(instance_.index(at.x - k.x, at.y - k.y, at.z - k.z));
    }
    model_.place(origin_);
    energy_ = model_.energy();
  }

 private:
  void propose(const std::array<std::uint32_t, 4>& draw, float temperature, RoundCounts& counts,
               WorseningCounts* worsenings) {
    const std::size_t p = random_below(draw[0], static_cast<std::uint32_t>(origin_.size()));
    const Shift s =
        instance_
            .displacements[random_below(draw[1], static_cast<std::uint32_t>(instance_.displacements.size()))];
    ++counts.proposals;

    const Shift at = position(p);
    int x = at.x + s.x, y = at.y + s.y, z = at.z + s.z;
    const auto [width, height] = instance_.slice;
    const int depth = instance_.depth;
    if (!instance_.options.wrap && (x >= width || y < 0 || y >= height || z < 0 || z >= depth)) return;
    // No s is longer than a side.
    if (x >= width) x -= width;
    if (y >= height) y -= height;
    if (y < 0) y += height;
    if (z >= depth) z -= depth;
    if (z < 0) z += depth;
    const std::size_t q = (static_cast<std::size_t>(z) * height + static_cast<std::size_t>(y)) * width +
                          static_cast<std::size_t>(x);
    const Shift to{x, y, z};
    if (!within_reach(displacement(at, origin_[q]), instance_.options)) return;
    if (!within_reach(displacement(to, origin_[p]), instance_.options)) return;

    const std::int64_t change = model_.change(p, q);
    const bool taken = change <= metropolis_threshold(draw[2], temperature);
    if (worsenings != nullptr) worsenings->count(change, taken);
    if (!taken) return;
    model_.swap(p, q);
    std::swap(origin_[p], origin_[q]);
    energy_ += change;
    ++counts.accepted;
    counts.changed += change != 0;
  }

  Placement displacements_of(const std::vector<std::int32_t>& origin) const {
    Placement result = instance_.identity();
    for (std::size_t w = 0; w < origin.size(); ++w) result.set(w, displacement(position(w), origin[w]));
    return result;
  }

  /// AnnealInstance's, in 32 bits: divisions are half of a proposal's cost.
  Shift position(std::size_t index) const {
    const auto [width, height] = instance_.slice;
    const auto at = static_cast<std::uint32_t>(index), row = at / static_cast<std::uint32_t>(width);
    const int x = static_cast<int>(at - row * static_cast<std::uint32_t>(width));
    if (instance_.depth == 1) return {x, static_cast<int>(row), 0};
    const std::uint32_t z = row / static_cast<std::uint32_t>(height);
    return {x, static_cast<int>(row - z * static_cast<std::uint32_t>(height)), static_cast<int>(z)};
  }

  /// k of a seed from `origin` at a position: the nearest of those that name the same pixel.
  Shift displacement(Shift at, std::int32_t origin) const {
    const Shift from = position(static_cast<std::size_t>(origin));
    const Shift k{at.x - from.x, at.y - from.y, at.z - from.z};
    if (!instance_.options.wrap) return k;
    const auto [width, height] = instance_.slice;
    return {centred(k.x, width), centred(k.y, height), centred(k.z, instance_.depth)};
  }
  /// wrap_centred() of what lies within one period of 0.
  static int centred(int k, int period) {
    if (k < -(period / 2)) return k + period;
    return k >= period - period / 2 ? k - period : k;
  }

  std::uint64_t seed_;
  std::uint32_t chain_;
  Energy model_;
  std::vector<std::int32_t> origin_;  ///< of the seed at each position
  std::vector<std::int32_t> kept_;
  std::int64_t energy_ = 0;
};

template <class Energy>
std::vector<std::int64_t> rises_of(const AnnealInstance& instance) {
  std::vector<Shift> within;  // the identity lets seeds move by these
  for (const Shift s : instance.displacements) {
    if (within_reach(s, instance.options)) within.push_back(s);
  }
  std::vector<std::int64_t> rises;
  if (within.empty()) return rises;
  Energy model(instance);
  std::vector<std::int32_t> origin(static_cast<std::size_t>(instance.size.area()));
  std::iota(origin.begin(), origin.end(), 0);
  model.place(origin);
  constexpr std::uint32_t kPairs = 16384;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    const auto draw = philox({i, 0, kRiseStream, 0}, {0, 0});
    const std::size_t p = random_below(draw[0], static_cast<std::uint32_t>(origin.size()));
    const Shift s = within[random_below(draw[1], static_cast<std::uint32_t>(within.size()))];
    const Shift at = instance.position(p), to{at.x + s.x, at.y + s.y, at.z + s.z};
    const bool inside = to.x < instance.slice.width && to.y >= 0 && to.y < instance.slice.height &&
                        to.z >= 0 && to.z < instance.depth;
    if (!instance.options.wrap && !inside) continue;
    const std::int64_t change = model.change(p, instance.index(to.x, to.y, to.z));
    if (change > 0) rises.push_back(change);
  }
  return rises;
}

}  // namespace

std::vector<std::int64_t> sample_rises(const AnnealInstance& instance) {
  return instance.residual_sigma_px > 0.0 ? rises_of<FilteredEnergy>(instance)
                                          : rises_of<PixelSumEnergy>(instance);
}

std::unique_ptr<RetargetEngine> make_scalar_engine(const AnnealInstance& instance, std::uint64_t seed,
                                                   std::uint32_t chain) {
  if (instance.residual_sigma_px > 0.0)
    return std::make_unique<ScalarEngine<FilteredEnergy>>(instance, seed, chain);
  return std::make_unique<ScalarEngine<PixelSumEnergy>>(instance, seed, chain);
}

}  // namespace bn::retarget
