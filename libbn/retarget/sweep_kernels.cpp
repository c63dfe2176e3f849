// The sweep on vectors: sweep_plainly() of sweep.h, a row of pairs at a time, equal to it bit for bit.
//
// Per vector of pairs: the change of energy from four levels, reach from two displacement words, and only
// where a lane remains whose change any threshold of this temperature could accept, the random thresholds.
// Late in a run most vectors end there, which is safe because random numbers come from counters: one not
// drawn is missed by nobody. Levels and displacements are written back only where a pair was accepted.
//
// Lanes of 16 bits serve one channel or more of 8 to 14 bit levels under L1, lanes of 32 bits the rest that
// fits. SCALAR, Highway's one-lane target, runs the plain statement.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "retarget/sweep_kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

#include "retarget/sweep.h"

HWY_BEFORE_NAMESPACE();
namespace bn::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

template <Metric metric, bool kSingle, class Lane>
void sweep_band(SweepState<Lane>& state, const AnnealInstance& instance, const Sweep& sweep, const Band& band,
                SweepCounts& result) {
  sweep_plainly<metric>(state, instance, sweep, band, result, nullptr);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// mix() of sweep.h.
template <class D32, class V = hn::Vec<D32>>
HWY_INLINE V mix_lanes(D32 d, V x, V key) {
  x = hn::Xor(x, hn::ShiftRight<16>(x));
  x = hn::Mul(x, hn::Set(d, 0x7feb352du));
  x = hn::Xor(x, key);
  x = hn::Xor(x, hn::ShiftRight<15>(x));
  x = hn::Mul(x, hn::Set(d, 0x846ca68bu));
  return hn::Xor(x, hn::ShiftRight<16>(x));
}

/// min(metropolis_threshold(), cap), in the same operations.
template <class D32, class V = hn::Vec<D32>>
HWY_INLINE hn::Vec<hn::Repartition<std::int32_t, D32>> threshold_lanes(D32 du, V bits, float temperature,
                                                                       float cap) {
  const hn::Repartition<float, D32> df;
  const hn::Repartition<std::int32_t, D32> di;
  const auto scaled = hn::Add(hn::ConvertTo(df, hn::BitCast(di, hn::ShiftRight<9>(bits))), hn::Set(df, 0.5f));
  const auto pattern = hn::BitCast(di, scaled);
  const auto octaves = hn::ConvertTo(df, hn::Sub(hn::Set(di, 127 + 23), hn::ShiftRight<23>(pattern)));
  const auto mantissa = hn::Or(hn::And(pattern, hn::Set(di, 0x7fffff)), hn::Set(di, 0x3f800000));
  const auto t = hn::Sub(hn::BitCast(df, mantissa), hn::Set(df, 1.0f));
  auto log = hn::Set(df, kLogCoefficients[5]);
  for (int i = 4; i >= 0; --i) log = hn::Add(hn::Mul(log, t), hn::Set(df, kLogCoefficients[i]));
  log = hn::Mul(log, t);
  const auto minus_log =
      hn::Max(hn::Sub(hn::Mul(octaves, hn::Set(df, kLn2Single)), log), hn::Set(df, kLeastMinusLog));
  (void)du;
  return hn::ConvertTo(di, hn::Min(hn::Mul(minus_log, hn::Set(df, temperature)), hn::Set(df, cap)));
}

/// What one sweep's vectors share.
template <Metric metric, bool kSingle, class Lane>
class RowSweeper {
  static constexpr int kCapLanes = SweepState<Lane>::kMaxLanes;
  using D = hn::CappedTag<Lane, kCapLanes>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using D8 = hn::Repartition<std::uint8_t, D>;
  using DU32 = hn::Repartition<std::uint32_t, D>;
  using DI32 = hn::Repartition<std::int32_t, D>;
  using V8 = hn::Vec<D8>;
  static constexpr bool kNarrow = sizeof(Lane) == 2;
  /// Above every change of energy that fits the lane.
  static constexpr float kCap = kNarrow ? 32767.0f : 0x1p30f;

 public:
  RowSweeper(SweepState<Lane>& state, const Sweep& sweep) : state_(state), sweep_(sweep) {
    const ReachBytes& r = state.reach;
    plus_ = byte_pair(wrap(sweep.s.x, r.period_x), wrap(sweep.s.y, r.period_y));
    minus_ = byte_pair(wrap(-sweep.s.x, r.period_x), wrap(-sweep.s.y, r.period_y));
    period_ = byte_pair(r.period_x & 255, r.period_y & 255);
    limit_ = r.euclidean ? static_cast<Lane>(r.limit) : byte_pair(r.limit, r.limit);
    periodic_ = r.period_x != 256 || r.period_y != 256;
    // Bits 0 give the largest threshold by far: the next larger u is three times as large.
    most_ = static_cast<Lane>(std::min(static_cast<float>(metropolis_threshold(0, sweep.temperature)), kCap));
  }

  /// Columns from..end - 1 of row y with row q_y; `first_partner`, if not null, tells which columns count.
  void columns(int y, int q_y, int from, int end, const Lane* first_partner) {
    const auto lanes = static_cast<int>(hn::Lanes(D()));
    while (from < end) {
      // Even, so that a pair of columns shares a random word; and inside the row's storage.
      int x = from & ~1;
      if (x + lanes > state_.width + 1) x = std::max(0, (state_.width - lanes + 1) & ~1);
      const bool whole = x == from && x + lanes <= end;
      if (first_partner != nullptr) {
        vector<true>(y, q_y, x, and_range(x, from, end, hn::MaskFromVec(hn::LoadU(D(), first_partner + x))));
      } else if (whole) {
        vector<false>(y, q_y, x, M());
      } else {
        vector<true>(y, q_y, x, and_range(x, from, end, hn::FirstN(D(), static_cast<std::size_t>(lanes))));
      }
      from = x + lanes;
    }
  }

  /// Brings what was written behind row y's last column back to its first ones.
  void unwrap(int y) {
    each_plane(y, [&](Lane* row) {
      const D d;
      for (int x = 0; x < sweep_.s.x; x += static_cast<int>(hn::Lanes(d))) {
        const auto mask = hn::FirstN(d, static_cast<std::size_t>(sweep_.s.x - x));
        hn::StoreU(hn::IfThenElse(mask, hn::LoadU(d, row + state_.width + x), hn::LoadU(d, row + x)), d,
                   row + x);
      }
    });
  }
  void repeat(int y) {
    each_plane(y, [&](Lane* row) {
      const D d;
      for (int x = 0; x < state_.repeated; x += static_cast<int>(hn::Lanes(d))) {
        hn::StoreU(hn::LoadU(d, row + x), d, row + state_.width + x);
      }
    });
  }

  /// Whether a swap was accepted since the last call.
  bool take_dirty() { return std::exchange(dirty_, false); }

  void add_to(SweepCounts& result) {
    result.change += change_;
    result.counts.accepted += accepted_;
    result.counts.changed += changed_;
  }

 private:
  static Lane byte_pair(int x, int y) { return static_cast<Lane>((x & 255) | (y & 255) << 8); }

  static M and_range(int x, int from, int end, M mask) {
    const D d;
    const auto column = hn::Add(hn::Iota(d, Lane{0}), hn::Set(d, static_cast<Lane>(x)));
    return hn::And(mask, hn::And(hn::Not(hn::Gt(hn::Set(d, static_cast<Lane>(from)), column)),
                                 hn::Gt(hn::Set(d, static_cast<Lane>(end)), column)));
  }

  template <class Body>
  void each_plane(int y, Body&& body) {
    for (auto& plane : state_.level) body(state_.row(plane, y));
    body(state_.row(state_.bytes, y));
  }

  V8 moved(V bytes, Lane by) const {
    const D8 d8;
    const D d;
    V8 sum = hn::Add(hn::BitCast(d8, bytes), hn::BitCast(d8, hn::Set(d, by)));
    if (periodic_) sum = hn::Min(sum, hn::Sub(sum, hn::BitCast(d8, hn::Set(d, period_))));
    return sum;
  }

  M within(V8 a, V8 b) const {
    const D8 d8;
    const D d;
    if (!state_.reach.euclidean) {
      const auto limit = hn::BitCast(d8, hn::Set(d, limit_));
      return hn::Eq(hn::BitCast(d, hn::Or(hn::SaturatedSub(a, limit), hn::SaturatedSub(b, limit))),
                    hn::Zero(d));
    }
    const auto outside = [&](V8 bytes) {
      const auto least = hn::Min(bytes, hn::Sub(hn::BitCast(d8, hn::Set(d, period_)), bytes));
      const V x = hn::And(hn::BitCast(d, least), hn::Set(d, Lane{255}));
      const V y = hn::ShiftRight<8>(hn::BitCast(d, least));
      return hn::Gt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Set(d, limit_));
    };
    return hn::Not(hn::Or(outside(a), outside(b)));
  }

  static HWY_INLINE V pair_change(V v_p, V v_q, V t_p, V t_q) {
    if constexpr (metric == Metric::l2) {
      // (vp - tq)^2 + (vq - tp)^2 - (vp - tp)^2 - (vq - tq)^2
      return hn::ShiftLeft<1>(hn::Mul(hn::Sub(v_p, v_q), hn::Sub(t_p, t_q)));
    } else {
      return hn::Sub(hn::Add(hn::Abs(hn::Sub(v_p, t_q)), hn::Abs(hn::Sub(v_q, t_p))),
                     hn::Add(hn::Abs(hn::Sub(v_p, t_p)), hn::Abs(hn::Sub(v_q, t_q))));
    }
  }

  HWY_INLINE V channel_change(std::size_t c, int y, int q_y, int x) const {
    const D d;
    const int q_x = x + sweep_.s.x;
    return pair_change(hn::LoadU(d, state_.row(state_.level[c], y) + x),
                       hn::LoadU(d, state_.row(state_.level[c], q_y) + q_x),
                       hn::LoadU(d, state_.row(state_.landing[c], y) + x),
                       hn::LoadU(d, state_.row(state_.landing[c], q_y) + q_x));
  }

  HWY_INLINE V thresholds(int x, int y) const {
    const D d;
    const DU32 du;
    const std::uint32_t base =
        static_cast<std::uint32_t>(y) * (static_cast<std::uint32_t>(state_.width + 1) / 2) +
        static_cast<std::uint32_t>(x) / 2;
    if constexpr (kNarrow) {
      const auto index = hn::Mul(hn::Iota(du, base), hn::Set(du, kGolden));
      const auto even = hn::Set(du, sweep_.key_even), odd = hn::Set(du, sweep_.key_odd);
      const auto low =
          threshold_lanes(du, mix_lanes(du, hn::Add(index, even), odd), sweep_.temperature, kCap);
      const auto high =
          threshold_lanes(du, mix_lanes(du, hn::Add(index, odd), even), sweep_.temperature, kCap);
      return hn::BitCast(d, hn::Or(low, hn::ShiftLeft<16>(high)));
    } else {
      const auto lane = hn::Iota(du, 0u);
      const auto index = hn::Mul(hn::Add(hn::ShiftRight<1>(lane), hn::Set(du, base)), hn::Set(du, kGolden));
      const auto is_odd = hn::Ne(hn::And(lane, hn::Set(du, 1u)), hn::Zero(du));
      const auto even = hn::Set(du, sweep_.key_even), odd = hn::Set(du, sweep_.key_odd);
      const auto bits =
          mix_lanes(du, hn::Add(index, hn::IfThenElse(is_odd, odd, even)), hn::IfThenElse(is_odd, even, odd));
      return threshold_lanes(du, bits, sweep_.temperature, kCap);
    }
  }

  /// The pairs of one vector; of them only `counted` if kMasked.
  template <bool kMasked>
  HWY_INLINE void vector(int y, int q_y, int x, M counted) {
    const D d;
    const int q_x = x + sweep_.s.x;
    Lane* bytes_p = state_.row(state_.bytes, y) + x;
    Lane* bytes_q = state_.row(state_.bytes, q_y) + q_x;
    const V p = hn::LoadU(d, bytes_p), q = hn::LoadU(d, bytes_q);
    const V8 to_q = moved(p, plus_), to_p = moved(q, minus_);
    M open = within(to_q, to_p);
    if constexpr (kMasked) open = hn::And(open, counted);

    V change = channel_change(0, y, q_y, x);
    if constexpr (!kSingle) {
      change = hn::Mul(change, hn::Set(d, state_.weight[0]));
      for (std::size_t c = 1; c < state_.level.size(); ++c) {
        change = hn::Add(change, hn::Mul(channel_change(c, y, q_y, x), hn::Set(d, state_.weight[c])));
      }
    }
    open = hn::And(open, hn::Not(hn::Gt(change, hn::Set(d, most_))));
    if (hn::AllFalse(d, open)) return;
    const M taken = hn::And(open, hn::Not(hn::Gt(change, thresholds(x, y))));
    if (hn::AllFalse(d, taken)) return;

    dirty_ = true;
    const auto swap_lanes = [&](Lane* at_p, Lane* at_q, V new_p, V new_q, V old_p) {
      hn::StoreU(hn::IfThenElse(taken, new_p, old_p), d, at_p);
      // Both may lie in one row: read again what the first store may have changed.
      hn::StoreU(hn::IfThenElse(taken, new_q, hn::LoadU(d, at_q)), d, at_q);
    };
    swap_lanes(bytes_p, bytes_q, hn::BitCast(d, to_p), hn::BitCast(d, to_q), p);
    for (std::size_t c = 0; c < (kSingle ? 1 : state_.level.size()); ++c) {
      Lane* at_p = state_.row(state_.level[c], y) + x;
      Lane* at_q = state_.row(state_.level[c], q_y) + q_x;
      const V v_p = hn::LoadU(d, at_p), v_q = hn::LoadU(d, at_q);
      swap_lanes(at_p, at_q, v_q, v_p, v_p);
    }
    accepted_ += static_cast<std::int64_t>(hn::CountTrue(d, taken));
    changed_ += static_cast<std::int64_t>(hn::CountTrue(d, hn::And(taken, hn::Ne(change, hn::Zero(d)))));
    change_ += sum_of(hn::IfThenElseZero(taken, change));
  }

  static HWY_INLINE std::int64_t sum_of(V change) {
    const DI32 di;
    if constexpr (kNarrow) {
      auto odd_sum = hn::Zero(di);
      const auto sum =
          hn::ReorderWidenMulAccumulate(di, change, hn::Set(D(), Lane{1}), hn::Zero(di), odd_sum);
      return hn::GetLane(hn::SumOfLanes(di, hn::Add(sum, odd_sum)));
    } else {
      HWY_ALIGN Lane lanes[kCapLanes];
      hn::Store(change, D(), lanes);
      std::int64_t sum = 0;
      for (std::size_t i = 0; i < hn::Lanes(D()); ++i) sum += lanes[i];
      return sum;
    }
  }

  SweepState<Lane>& state_;
  const Sweep& sweep_;
  Lane plus_, minus_, period_, limit_, most_;
  bool periodic_;
  bool dirty_ = false;
  std::int64_t accepted_ = 0, changed_ = 0, change_ = 0;
};

template <Metric metric, bool kSingle, class Lane>
void sweep_band(SweepState<Lane>& state, const AnnealInstance& instance, const Sweep& sweep, const Band& band,
                SweepCounts& result) {
  RowSweeper<metric, kSingle, Lane> sweeper(state, sweep);
  const int s_x = sweep.s.x, width = state.width;
  const bool wraps = instance.options.wrap;
  std::int64_t pairs = 0;

  if (sweep.s.y != 0) {
    const int columns = wraps ? width : width - s_x;
    for_each_row_pair(sweep, band, state.height, [&](int y, int q_y) {
      pairs += columns;
      sweeper.columns(y, q_y, 0, columns, nullptr);
      if (!sweeper.take_dirty()) return;
      if (wraps) sweeper.unwrap(q_y);
      sweeper.repeat(y);
      sweeper.repeat(q_y);
    });
  } else {
    std::vector<Lane> first_partner(static_cast<std::size_t>(width) + SweepState<Lane>::kMaxLanes, Lane{0});
    int in_a_row = 0;
    for (int x = 0; x < (wraps ? width : width - s_x); ++x) {
      if (!starts_pair(sweep, width, x)) continue;
      first_partner[static_cast<std::size_t>(x)] = Lane{-1};
      ++in_a_row;
    }
    for (int j = 0; j < band.count; ++j) {
      const int y = (band.first + j) % state.height;
      pairs += in_a_row;
      // Across the border first, while the repeated columns are still those of the row.
      if (wraps) {
        sweeper.columns(y, y, width - s_x, width, first_partner.data());
        if (sweeper.take_dirty()) sweeper.unwrap(y);
      }
      sweeper.columns(y, y, 0, width - s_x, first_partner.data());
      sweeper.repeat(y);
    }
  }
  result.counts.proposals += pairs;
  sweeper.add_to(result);
}

#endif

void L1Single16(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, true>(state, instance, sweep, band, result);
}
void L1Of16(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
            const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, false>(state, instance, sweep, band, result);
}
void L1Of32(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
            const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, false>(state, instance, sweep, band, result);
}
void L2Of32(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
            const Band& band, SweepCounts& result) {
  sweep_band<Metric::l2, false>(state, instance, sweep, band, result);
}

}  // namespace bn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn {

HWY_EXPORT(L1Single16);
HWY_EXPORT(L1Of16);
HWY_EXPORT(L1Of32);
HWY_EXPORT(L2Of32);

void sweep_l1_single(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result) {
  HWY_DYNAMIC_DISPATCH(L1Single16)(state, instance, sweep, band, result);
}
void sweep_l1(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
              const Band& band, SweepCounts& result) {
  HWY_DYNAMIC_DISPATCH(L1Of16)(state, instance, sweep, band, result);
}
void sweep_l1(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
              const Band& band, SweepCounts& result) {
  HWY_DYNAMIC_DISPATCH(L1Of32)(state, instance, sweep, band, result);
}
void sweep_l2(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
              const Band& band, SweepCounts& result) {
  HWY_DYNAMIC_DISPATCH(L2Of32)(state, instance, sweep, band, result);
}

}  // namespace bn
#endif
