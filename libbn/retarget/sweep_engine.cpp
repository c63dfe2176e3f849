// The data-parallel engine: rounds of sweeps over bands (sweep.h).

#include "retarget/sweep.h"

#include <algorithm>

#include "bn/random.h"

namespace bn::retarget {
namespace {

/// Streams of random numbers; chains count up from them, so they lie far apart.
constexpr std::uint32_t kSweepStream = 0x5A000000u;
constexpr std::uint32_t kPairStream = 0x5B000000u;
constexpr std::uint32_t kBandStream = 0x5C000000u;

std::array<std::uint32_t, 4> draw(std::uint64_t seed, std::uint32_t stream, std::int64_t round,
                                  std::uint32_t low, std::uint32_t high) {
  return philox(
      {static_cast<std::uint32_t>(round), static_cast<std::uint32_t>(round >> 32) ^ high << 24, stream, low},
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
}

int longest_s_x(const AnnealInstance& instance) {
  int longest = 0;
  for (const Shift s : instance.displacements) longest = std::max(longest, s.x);
  return longest;
}

constexpr std::size_t round_up(std::size_t value, std::size_t unit) {
  return (value + unit - 1) / unit * unit;
}

}  // namespace

ReachBytes::ReachBytes(const AnnealInstance& instance) {
  const RetargetOptions& options = instance.options;
  euclidean = options.reach == Reach::euclidean;
  bias = euclidean ? 0 : options.radius;
  limit = euclidean ? options.radius * options.radius : 2 * options.radius;
  // Bytes of seeds within reach and swaps of at most 2 radii reach from -3 to 4 radii: below 256 in all, and
  // no other name of a displacement comes near if the side is above 4 radii.
  if (!options.wrap) return;
  if (instance.slice.width <= 4 * options.radius) period_x = instance.slice.width;
  if (instance.slice.height <= 4 * options.radius) period_y = instance.slice.height;
  if (instance.depth <= 4 * options.radius) period_z = instance.depth;
}

Sweep sweep_of(const AnnealInstance& instance, std::uint64_t seed, std::uint32_t chain, std::int64_t round,
               int sweep, const Band& band, float temperature) {
  const auto choice = draw(seed, kSweepStream + chain, round, band.number, static_cast<std::uint32_t>(sweep));
  const auto keys = draw(seed, kPairStream + chain, round, band.number, static_cast<std::uint32_t>(sweep));
  Sweep result;
  result.s =
      instance
          .displacements[random_below(choice[0], static_cast<std::uint32_t>(instance.displacements.size()))];
  const int a = result.s.z != 0 ? std::abs(result.s.z) : result.s.y != 0 ? std::abs(result.s.y) : result.s.x;
  result.phase = static_cast<int>(random_below(choice[1], static_cast<std::uint32_t>(2 * a)));
  if (instance.options.wrap) {
    result.cut_x = static_cast<int>(random_below(choice[2], static_cast<std::uint32_t>(instance.size.width)));
    result.cut_y =
        static_cast<int>(random_below(choice[3], static_cast<std::uint32_t>(instance.slice.height)));
  }
  result.key_even = keys[0];
  result.key_odd = keys[1];
  result.temperature = temperature;
  return result;
}

std::vector<Band> bands_of(const AnnealInstance& instance, std::uint64_t seed, std::uint32_t chain,
                           std::int64_t round) {
  const bool volume = instance.depth > 1;
  const int height = volume ? instance.depth : instance.size.height;
  // High enough that few rows miss their partner at the edge; slices have many rows, so fewer of them do.
  const int least = std::max(volume ? 16 : 64, 4 * instance.options.radius);
  const int count = std::max(1, height / least);
  const bool wraps = instance.options.wrap;
  int cut = 0;
  if (wraps || count > 1) {
    const auto bits = draw(seed, kBandStream + chain, round, 0, 0);
    cut = static_cast<int>(random_below(bits[0], static_cast<std::uint32_t>(height)));
  }
  std::vector<Band> bands;
  for (int b = 0; b < count; ++b) {
    const int first = static_cast<int>(std::int64_t{height} * b / count);
    const int end = static_cast<int>(std::int64_t{height} * (b + 1) / count);
    Band band{(cut + first) % height, end - first, static_cast<std::uint32_t>(bands.size())};
    const int rest = band.first + band.count - height;
    if (!wraps && rest > 0) {
      band.count -= rest;
      bands.push_back({0, rest, static_cast<std::uint32_t>(bands.size() + 1)});
    }
    bands.push_back(band);
  }
  return bands;
}

template <class Lane>
SweepState<Lane>::SweepState(const AnnealInstance& instance, int longest_s_x)
    : width(instance.size.width),
      height(instance.size.height),
      slice_height(instance.slice.height),
      depth(instance.depth),
      repeated(longest_s_x),
      stride(round_up(static_cast<std::size_t>(std::max(width, kMaxLanes)), kMaxLanes) +
             round_up(static_cast<std::size_t>(longest_s_x) + 1, kMaxLanes)),
      channels(static_cast<int>(instance.weight.size())),
      reach(instance) {
  const std::size_t lanes = stride * static_cast<std::size_t>(height);
  const auto plane = [&] {
    auto result = hwy::AllocateAligned<Lane>(lanes);
    std::fill(result.get(), result.get() + lanes, Lane{0});
    return result;
  };
  for (int c = 0; c < channels; ++c) {
    weight.push_back(static_cast<Lane>(instance.weight[c]));
    level.push_back(plane());
    landing.push_back(plane());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x)
        row(landing[c], y)[x] = static_cast<Lane>(instance.landing_level[c](x, y));
      repeat_row(row(landing[c], y));
    }
  }
  bytes = plane();
  if (depth > 1) bytes_z = plane();
}

namespace {

template <Metric metric, class Lane>
class SweepEngine final : public RetargetEngine {
 public:
  using Kernel = void (*)(SweepState<Lane>&, const AnnealInstance&, const Sweep&, const Band&, SweepCounts&);

  /// Without a kernel sweeps are made plainly.
  SweepEngine(const AnnealInstance& instance, std::uint64_t seed, std::uint32_t chain, Kernel kernel)
      : RetargetEngine(instance),
        seed_(seed),
        chain_(chain),
        kernel_(kernel),
        state_(instance, longest_s_x(instance)) {
    place(instance.identity());
  }

  RoundCounts sweeps(std::int64_t round, int first, int end, double temperature, const Execution& execution,
                     WorseningCounts* worsenings) override {
    RoundCounts counts;
    if (instance_.displacements.empty()) return counts;
    const float t = single_temperature(temperature);
    const auto bands = bands_of(instance_, seed_, chain_, round);
    std::vector<SweepCounts> results(bands.size());
    std::vector<WorseningCounts> watched(bands.size());
    // Waking threads costs some ten microseconds.
    constexpr std::int64_t kWorthWaking = 200'000;
    const bool short_round = instance_.size.area() / 2 * (end - first) < kWorthWaking;
    parallel_for(short_round ? Execution{.threads = 1} : execution, static_cast<std::int64_t>(bands.size()),
                 [&](std::int64_t b) {
                   for (int i = first; i < end; ++i) {
                     const Sweep sweep = sweep_of(instance_, seed_, chain_, round, i, bands[b], t);
                     const bool watch = worsenings != nullptr && i >= end - worsenings->sweeps;
                     if (watch || kernel_ == nullptr) {
                       const auto plainly = state_.depth > 1 ? sweep_plainly<metric, true, Lane>
                                                             : sweep_plainly<metric, false, Lane>;
                       plainly(state_, instance_, sweep, bands[b], results[b], watch ? &watched[b] : nullptr);
                     } else {
                       kernel_(state_, instance_, sweep, bands[b], results[b]);
                     }
                   }
                 });
    for (const SweepCounts& result : results) {
      counts += result.counts;
      energy_ += result.change;
    }
    if (worsenings != nullptr) {
      for (const WorseningCounts& one : watched) *worsenings += one;
    }
    return counts;
  }

  std::int64_t energy() const override { return energy_; }

  Placement displacements() const override {
    return displacements_of(state_.bytes.get(), state_.bytes_z.get());
  }
  void keep() override {
    const std::size_t lanes = state_.stride * static_cast<std::size_t>(state_.height);
    kept_.assign(state_.bytes.get(), state_.bytes.get() + lanes);
    if (state_.bytes_z) kept_z_.assign(state_.bytes_z.get(), state_.bytes_z.get() + lanes);
  }
  Placement kept() const override { return displacements_of(kept_.data(), kept_z_.data()); }

  void place(const Placement& displacement_at) override {
    energy_ = 0;
    for (int y = 0; y < state_.height; ++y) {
      Lane* bytes = state_.row(state_.bytes, y);
      for (int x = 0; x < state_.width; ++x) {
        const std::size_t w = static_cast<std::size_t>(y) * static_cast<std::size_t>(state_.width) +
                              static_cast<std::size_t>(x);
        const Shift at = instance_.position(w), k = displacement_at.at(w);
        const std::size_t from = instance_.index(at.x - k.x, at.y - k.y, at.z - k.z);
        if (state_.bytes_z) state_.row(state_.bytes_z, y)[x] = static_cast<Lane>(state_.reach.z_byte(k.z));
        bytes[x] = static_cast<Lane>(state_.reach.x_byte(k.x) | state_.reach.y_byte(k.y) << 8);
        for (int c = 0; c < state_.channels; ++c) {
          const std::int32_t level = instance_.seed_level[c][from];
          state_.row(state_.level[c], y)[x] = static_cast<Lane>(level);
          energy_ += instance_.weight[c] * level_cost(level, instance_.landing_level[c](x, y), metric);
        }
      }
      state_.repeat(y);
    }
  }

 private:
  Placement displacements_of(const Lane* bytes, const Lane* bytes_z) const {
    Placement result = instance_.identity();
    std::size_t w = 0;
    for (int y = 0; y < state_.height; ++y) {
      for (int x = 0; x < state_.width; ++x) {
        const std::size_t lane = static_cast<std::size_t>(y) * state_.stride + static_cast<std::size_t>(x);
        const auto both = static_cast<int>(bytes[lane]);
        const int z = instance_.depth > 1 ? static_cast<int>(bytes_z[lane]) : state_.reach.bias;
        result.set(w++, state_.reach.offset(both & 255, both >> 8 & 255, z));
      }
    }
    return result;
  }

  std::uint64_t seed_;
  std::uint32_t chain_;
  Kernel kernel_;
  SweepState<Lane> state_;
  std::vector<Lane> kept_;
  std::vector<Lane> kept_z_;
  std::int64_t energy_ = 0;
};

template <Metric metric, class Lane>
std::unique_ptr<RetargetEngine> make(const AnnealInstance& instance, std::uint64_t seed, std::uint32_t chain,
                                     typename SweepEngine<metric, Lane>::Kernel kernel) {
  return std::make_unique<SweepEngine<metric, Lane>>(instance, seed, chain, kernel);
}

}  // namespace

std::unique_ptr<RetargetEngine> make_sweep_engine(const AnnealInstance& instance, std::uint64_t seed,
                                                  std::uint32_t chain) {
  // A change of energy and the terms it is added from must fit the lane.
  const bool fits_16 = instance.largest_change < (1 << 15), fits_32 = instance.largest_change < (1 << 30);
  if (instance.depth > 1) {
    if (instance.options.metric == Metric::l2) {
      return fits_32 ? make<Metric::l2, std::int32_t>(instance, seed, chain, sweep_volume_l2)
                     : make<Metric::l2, std::int64_t>(instance, seed, chain, nullptr);
    }
    if (fits_16) return make<Metric::l1, std::int16_t>(instance, seed, chain, sweep_volume_l1);
    if (fits_32) return make<Metric::l1, std::int32_t>(instance, seed, chain, sweep_volume_l1);
    return make<Metric::l1, std::int64_t>(instance, seed, chain, nullptr);
  }
  if (instance.options.metric == Metric::l2) {
    if (fits_32) return make<Metric::l2, std::int32_t>(instance, seed, chain, sweep_l2);
    return make<Metric::l2, std::int64_t>(instance, seed, chain, nullptr);
  }
  if (fits_16 && instance.weight.size() == 1 && instance.weight[0] == 1) {
    return make<Metric::l1, std::int16_t>(instance, seed, chain, sweep_l1_single);
  }
  if (fits_16) return make<Metric::l1, std::int16_t>(instance, seed, chain, sweep_l1);
  if (fits_32) return make<Metric::l1, std::int32_t>(instance, seed, chain, sweep_l1);
  return make<Metric::l1, std::int64_t>(instance, seed, chain, nullptr);
}

std::unique_ptr<RetargetEngine> make_engine(const AnnealInstance& instance, std::uint64_t seed,
                                            std::uint32_t chain) {
  return instance.residual_sigma_px > 0.0 ? make_scalar_engine(instance, seed, chain)
                                          : make_sweep_engine(instance, seed, chain);
}

}  // namespace bn::retarget
