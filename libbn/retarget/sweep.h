// The data-parallel sweep: its statement, and the state it works on.
//
// A sweep draws one displacement s and proposes to swap the seeds at p and p + s for many p at once. No
// position occurs in two pairs, the energy is a sum over pixels and the reach concerns each seed alone, so
// the decisions do not depend on each other: taking them all at once equals taking them one by one, in any
// order. Each pair obeys detailed balance, hence the sweep does, and so does the mixture over s and the
// phase, which are drawn without looking at the state. The chain samples Boltzmann's distribution, like the
// scalar one.
//
// Pairing. Rows are counted from a cut; with a = |s.y| > 0, blocks of a rows, starting at a phase drawn in
// 0..2a-1, alternate between lower and upper partners: row j pairs with row j + a, across all columns (on the
// torus; without wrap the columns whose partner would cross the border rest). With s.y = 0 the same is done
// with columns: column i, counted from a cut, pairs with i + s.x. Pairs never cross the cut, which moves.
//
// Volumes. Rows lie slice below slice. With s.z != 0 slices take the part that rows have in a flat tile:
// slice j pairs with slice j + |s.z|, row y with row y + s.y on the slice's own torus. With s.z = 0 each
// slice is a flat tile, all with one cut. Bands are of slices.
//
// Bands. A tall tile is cut into bands of rows; within a round each band runs its own sweeps on its own rows,
// so threads need to meet only between rounds. The number of bands depends on the tile alone, never on the
// threads.
//
// Randomness: sweep number i of band b in round r takes two Philox blocks (sweep_of()); each pair hashes its
// position with a key of its sweep (pair_bits()) into the bits of its Metropolis threshold.
//
// Displacements are kept in one byte per axis, biased so that "within reach" is one unsigned comparison
// (ReachBytes). Three statements of the sweep exist: sweep_plainly() here, which any Lane can use; and
// one kernel per instruction set (sweep_kernels.cpp), equal to it bit for bit.

#pragma once

#include <hwy/aligned_allocator.h>

#include <cstdint>
#include <cstring>

#include "anneal/metropolis.h"
#include "retarget/anneal_engine.h"

namespace bn::retarget {

using anneal::kLeastMinusLog;
using anneal::kLn2Single;
using anneal::kLogCoefficients;
using anneal::metropolis_threshold;
using anneal::single_temperature;

/// How a displacement k becomes a byte per axis. On a torus too small to tell k from its other names (up to
/// four radii) bytes are taken modulo the side, else modulo 256.
struct ReachBytes {
  int period_x = 256;
  int period_y = 256;
  int period_z = 256;
  int bias = 0;   ///< Chebyshev: the radius, so that bytes 0..2 radius are within reach; Euclidean: 0
  int limit = 0;  ///< Chebyshev: 2 radius; Euclidean: radius squared
  bool euclidean = false;

  explicit ReachBytes(const AnnealInstance& instance);

  std::uint8_t x_byte(int k) const { return static_cast<std::uint8_t>(wrap(k + bias, period_x)); }
  std::uint8_t y_byte(int k) const { return static_cast<std::uint8_t>(wrap(k + bias, period_y)); }
  std::uint8_t z_byte(int k) const { return static_cast<std::uint8_t>(wrap(k + bias, period_z)); }
  /// The nearest displacement of that name.
  Shift offset(int x, int y, int z) const {
    return {wrap_centred(x - bias, period_x), wrap_centred(y - bias, period_y),
            wrap_centred(z - bias, period_z)};
  }
  bool allows(int x, int y, int z) const {
    if (!euclidean) return std::max(std::max(x, y), z) <= limit;
    const int a = std::min(x, period_x - x), b = std::min(y, period_y - y), c = std::min(z, period_z - z);
    return a * a + b * b + c * c <= limit;
  }
};

/// What a sweep draws.
struct Sweep {
  Shift s;
  int phase = 0;
  int cut_x = 0;  ///< used where s.y = s.z = 0
  int cut_y = 0;  ///< of a volume, used where s.z = 0 and s.y is not
  std::uint32_t key_even = 0;
  std::uint32_t key_odd = 0;
  float temperature = 0.0f;
};

/// Rows first..first + count - 1, modulo the height, or a volume's slices, modulo the depth; the cuts inside
/// it are drawn iff `wrap`.
struct Band {
  int first = 0;
  int count = 0;
  std::uint32_t number = 0;
};

Sweep sweep_of(const AnnealInstance& instance, std::uint64_t seed, std::uint32_t chain, std::int64_t round,
               int sweep, const Band& band, float temperature);

/// The bands of a round: their number from the size, where they start from the round.
std::vector<Band> bands_of(const AnnealInstance& instance, std::uint64_t seed, std::uint32_t chain,
                           std::int64_t round);

/// Mixes 32 bits: two multiplications of full period (constants: C. Wellons, "Prospecting for hash
/// functions", 2018), a second key between them.
constexpr std::uint32_t mix(std::uint32_t x, std::uint32_t key) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= key;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

inline constexpr std::uint32_t kGolden = 0x9E3779B9u;

/// The random bits of the pair whose first position is (x, y). Columns 2i and 2i + 1 share a counter and swap
/// the roles of the keys, so that one vector of 32 bit words serves two of 16 bit lanes.
inline std::uint32_t pair_bits(const Sweep& sweep, int width, int x, int y) {
  const std::uint32_t index = static_cast<std::uint32_t>(y) * (static_cast<std::uint32_t>(width + 1) / 2) +
                              static_cast<std::uint32_t>(x) / 2;
  const bool odd = (x & 1) != 0;
  return mix(index * kGolden + (odd ? sweep.key_odd : sweep.key_even), odd ? sweep.key_even : sweep.key_odd);
}

/// The state: per channel the level of the seed at each position and the level that belongs there; and each
/// seed's displacement bytes, x + 256 y. Lane is int16_t, int32_t or int64_t, such that a change of energy
/// fits. Rows start on 64 bytes and repeat their first columns behind the last, so that vectors may read and
/// write across the border of the torus.
template <class Lane>
struct SweepState {
  static constexpr int kMaxLanes = 64 / static_cast<int>(sizeof(Lane));

  int width = 0;
  int height = 0;  ///< of all slices
  int slice_height = 0;
  int depth = 1;
  int repeated = 0;  ///< columns behind the last that must equal the first ones
  std::size_t stride = 0;
  int channels = 0;
  ReachBytes reach;
  std::vector<Lane> weight;
  std::vector<hwy::AlignedFreeUniquePtr<Lane[]>> level;
  std::vector<hwy::AlignedFreeUniquePtr<Lane[]>> landing;
  hwy::AlignedFreeUniquePtr<Lane[]> bytes;
  hwy::AlignedFreeUniquePtr<Lane[]> bytes_z;  ///< of a volume; else null

  SweepState(const AnnealInstance& instance, int longest_s_x);

  Lane* row(hwy::AlignedFreeUniquePtr<Lane[]>& plane, int y) const {
    return plane.get() + static_cast<std::size_t>(y) * stride;
  }
  const Lane* row(const hwy::AlignedFreeUniquePtr<Lane[]>& plane, int y) const {
    return plane.get() + static_cast<std::size_t>(y) * stride;
  }
  /// Restores the repeated columns of row y.
  void repeat(int y) {
    for (auto& plane : level) repeat_row(row(plane, y));
    repeat_row(row(bytes, y));
    if (bytes_z) repeat_row(row(bytes_z, y));
  }

 private:
  void repeat_row(Lane* lanes) const {
    for (int x = 0; x < repeated; ++x) lanes[width + x] = lanes[x];
  }
};

/// Which pairs a row of s.y = 0 has: whether column x is a first partner.
inline bool starts_pair(const Sweep& sweep, int width, int x) {
  const int i = x >= sweep.cut_x ? x - sweep.cut_x : x - sweep.cut_x + width;
  return (i + sweep.phase) % (2 * sweep.s.x) < sweep.s.x && i + sweep.s.x < width;
}

/// Calls body(p, q) for each pair of lines (rows, or slices) that are `s` apart on a ring of `period` lines,
/// in disjoint blocks over the band.
template <class Body>
void for_each_line_pair(int s, int phase, const Band& band, int period, Body&& body) {
  const int a = std::abs(s);
  for (int block = -phase; block < band.count - a; block += 2 * a) {
    const int end = std::min(block + a, band.count - a);
    for (int j = std::max(block, 0); j < end; ++j) {
      int lower = band.first + j, upper = lower + a;
      if (lower >= period) lower -= period;
      if (upper >= period) upper -= period;
      if (s > 0) {
        body(lower, upper);
      } else {
        body(upper, lower);
      }
    }
  }
}

/// Calls body(row of p, row of q) for each pair of rows of a sweep of a flat tile with s.y != 0.
template <class Body>
void for_each_row_pair(const Sweep& sweep, const Band& band, int height, Body&& body) {
  for_each_line_pair(sweep.s.y, sweep.phase, band, height, body);
}

/// The same of a volume, for s.y != 0 or s.z != 0.
template <class Body>
void for_each_volume_row_pair(const Sweep& sweep, const Band& band, int height, int depth, bool wraps,
                              Body&& body) {
  if (sweep.s.z == 0) {
    const Band rows{sweep.cut_y, height, 0};
    for (int j = 0; j < band.count; ++j) {
      const int first_row = (band.first + j) % depth * height;
      for_each_line_pair(sweep.s.y, sweep.phase, rows, height,
                         [&](int p, int q) { body(first_row + p, first_row + q); });
    }
    return;
  }
  for_each_line_pair(sweep.s.z, sweep.phase, band, depth, [&](int p_slice, int q_slice) {
    for (int y = 0; y < height; ++y) {
      const int q_y = y + sweep.s.y;
      if (!wraps && (q_y < 0 || q_y >= height)) continue;
      body(p_slice * height + y, q_slice * height + wrap(q_y, height));
    }
  });
}

/// Calls body(row) for each row of a band.
template <class Body>
void for_each_row(const Band& band, int slice_height, int depth, Body&& body) {
  if (depth == 1) {
    for (int j = 0; j < band.count; ++j) body((band.first + j) % slice_height);
    return;
  }
  for (int j = 0; j < band.count; ++j) {
    const int first_row = (band.first + j) % depth * slice_height;
    for (int y = 0; y < slice_height; ++y) body(first_row + y);
  }
}

/// What a sweep of one band did.
struct SweepCounts {
  RoundCounts counts;
  std::int64_t change = 0;  ///< of the energy
};

/// The sweep, pair by pair. Random bits decide only between the changes that any bits accept and those that
/// none do.
template <Metric metric, bool kVolume, class Lane>
void sweep_plainly(SweepState<Lane>& state, const AnnealInstance& instance, const Sweep& sweep,
                   const Band& band, SweepCounts& result, WorseningCounts* worsenings) {
  const Shift s = sweep.s;
  const ReachBytes& reach = state.reach;
  const int plus_x = wrap(s.x, reach.period_x), minus_x = wrap(-s.x, reach.period_x),
            plus_y = wrap(s.y, reach.period_y), minus_y = wrap(-s.y, reach.period_y),
            plus_z = wrap(s.z, reach.period_z), minus_z = wrap(-s.z, reach.period_z);
  // Both below the period.
  const auto moved = [](int byte, int by, int period) {
    return byte + by < period ? byte + by : byte + by - period;
  };
  const auto cost = [](Lane a, Lane b) {
    return level_cost(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), metric);
  };
  const std::int64_t most = metropolis_threshold(0, sweep.temperature);
  const auto propose = [&](int x, int y, int q_y) {
    const int q_x = x + s.x < state.width ? x + s.x : x + s.x - state.width;
    ++result.counts.proposals;
    const int p_bytes = static_cast<int>(state.row(state.bytes, y)[x]);
    const int q_bytes = static_cast<int>(state.row(state.bytes, q_y)[q_x]);
    const int to_q_x = moved(p_bytes & 255, plus_x, reach.period_x);
    const int to_q_y = moved(p_bytes >> 8 & 255, plus_y, reach.period_y);
    const int to_p_x = moved(q_bytes & 255, minus_x, reach.period_x);
    const int to_p_y = moved(q_bytes >> 8 & 255, minus_y, reach.period_y);
    int to_q_z = reach.bias, to_p_z = reach.bias;
    if constexpr (kVolume) {
      to_q_z = moved(static_cast<int>(state.row(state.bytes_z, y)[x]), plus_z, reach.period_z);
      to_p_z = moved(static_cast<int>(state.row(state.bytes_z, q_y)[q_x]), minus_z, reach.period_z);
    }
    if (!reach.allows(to_q_x, to_q_y, to_q_z) || !reach.allows(to_p_x, to_p_y, to_p_z)) return;

    std::int64_t change = 0;
    for (int c = 0; c < state.channels; ++c) {
      const Lane v_p = state.row(state.level[c], y)[x], v_q = state.row(state.level[c], q_y)[q_x];
      const Lane t_p = state.row(state.landing[c], y)[x], t_q = state.row(state.landing[c], q_y)[q_x];
      change +=
          std::int64_t{state.weight[c]} * (cost(v_p, t_q) + cost(v_q, t_p) - cost(v_p, t_p) - cost(v_q, t_q));
    }
    const bool taken =
        change <= 0 || (change <= most && change <= metropolis_threshold(pair_bits(sweep, state.width, x, y),
                                                                         sweep.temperature));
    if (worsenings != nullptr) worsenings->count(change, taken);
    if (!taken) return;
    for (int c = 0; c < state.channels; ++c) {
      std::swap(state.row(state.level[c], y)[x], state.row(state.level[c], q_y)[q_x]);
    }
    state.row(state.bytes, y)[x] = static_cast<Lane>(to_p_x | to_p_y << 8);
    state.row(state.bytes, q_y)[q_x] = static_cast<Lane>(to_q_x | to_q_y << 8);
    if constexpr (kVolume) {
      state.row(state.bytes_z, y)[x] = static_cast<Lane>(to_p_z);
      state.row(state.bytes_z, q_y)[q_x] = static_cast<Lane>(to_q_z);
    }
    result.change += change;
    ++result.counts.accepted;
    result.counts.changed += change != 0;
  };

  const int columns = instance.options.wrap ? state.width : state.width - s.x;
  if (s.y == 0 && s.z == 0) {
    for_each_row(band, state.slice_height, state.depth, [&](int y) {
      for (int x = 0; x < columns; ++x) {
        if (starts_pair(sweep, state.width, x)) propose(x, y, y);
      }
      state.repeat(y);
    });
    return;
  }
  const auto rows = [&](int y, int q_y) {
    for (int x = 0; x < columns; ++x) propose(x, y, q_y);
    state.repeat(y);
    state.repeat(q_y);
  };
  if constexpr (kVolume) {
    for_each_volume_row_pair(sweep, band, state.slice_height, state.depth, instance.options.wrap, rows);
  } else {
    for_each_row_pair(sweep, band, state.height, rows);
  }
}

/// The same on the best instruction set; `first_partner` is starts_pair() of each column as -1 or 0, used
/// where s.y = 0.
void sweep_l1_single(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result);
void sweep_l1(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
              const Band& band, SweepCounts& result);
void sweep_l1(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
              const Band& band, SweepCounts& result);
void sweep_l2(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
              const Band& band, SweepCounts& result);
void sweep_volume_l1(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result);
void sweep_volume_l1(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result);
void sweep_volume_l2(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result);

}  // namespace bn::retarget
