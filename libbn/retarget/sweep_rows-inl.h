// What a sweep does to the pairs of two rows, or of one, a vector of them at a time; sweep_kernels.cpp walks
// the rows. Compiled once for each instruction set but SCALAR.
//
// Per vector of pairs: the change of energy from four levels, reach from two displacement words, and only
// where a lane remains whose change any threshold of this temperature could accept, the random thresholds.
// Late in a run most vectors end there, which is safe because random numbers come from counters: one not
// drawn is missed by nobody. Levels and displacements are written back only where a pair was accepted.

#if defined(BN_RETARGET_SWEEP_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BN_RETARGET_SWEEP_ROWS_INL_H_
#undef BN_RETARGET_SWEEP_ROWS_INL_H_
#else
#define BN_RETARGET_SWEEP_ROWS_INL_H_
#endif

#include <hwy/highway.h>

#include "retarget/sweep.h"

#if HWY_TARGET != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace bn::retarget::HWY_NAMESPACE {

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
template <class D32, class VF, class V = hn::Vec<D32>>
HWY_INLINE auto threshold_lanes(D32 du, V bits, VF temperature, float cap) {
  const hn::Repartition<float, D32> df;
  const hn::RebindToSigned<D32> di;
  (void)du;
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
  return hn::ConvertTo(di, hn::Min(hn::Mul(minus_log, temperature), hn::Set(df, cap)));
}

/// What one sweep's vectors share.
template <Metric metric, bool kSingle, bool kVolume, class Lane>
class RowSweeper {
  static constexpr int kCapLanes = SweepState<Lane>::kMaxLanes;
  using D = hn::CappedTag<Lane, kCapLanes>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using D8 = hn::Repartition<std::uint8_t, D>;
  using DU32 = hn::Repartition<std::uint32_t, D>;
  using DI32 = hn::Repartition<std::int32_t, D>;
  using DF = hn::Repartition<float, D>;
  using V8 = hn::Vec<D8>;
  static constexpr bool kNarrow = sizeof(Lane) == 2;
  /// Above every change of energy that fits the lane.
  static constexpr float kCap = kNarrow ? 32767.0f : 0x1p30f;

 public:
  RowSweeper(SweepState<Lane>& state, const Sweep& sweep) : state_(state), sweep_(sweep) {
    const ReachBytes& r = state.reach;
    const D d;
    const D8 d8;
    plus_ = byte_pairs(wrap(sweep.s.x, r.period_x), wrap(sweep.s.y, r.period_y));
    minus_ = byte_pairs(wrap(-sweep.s.x, r.period_x), wrap(-sweep.s.y, r.period_y));
    period_ = byte_pairs(r.period_x, r.period_y);
    limit_ =
        r.euclidean ? hn::BitCast(d8, hn::Set(d, static_cast<Lane>(r.limit))) : byte_pairs(r.limit, r.limit);
    if constexpr (kVolume) {
      plus_z_ = byte_pairs(wrap(sweep.s.z, r.period_z), 0);
      minus_z_ = byte_pairs(wrap(-sweep.s.z, r.period_z), 0);
      period_z_ = byte_pairs(r.period_z, 0);
    }
    periodic_ = r.period_x != 256 || r.period_y != 256;
    euclidean_ = r.euclidean;
    // Bits 0 give the largest threshold by far: the next larger u is three times as large.
    most_ = hn::Set(
        d, static_cast<Lane>(std::min(static_cast<float>(metropolis_threshold(0, sweep.temperature)), kCap)));

    const DU32 du;
    temperature_ = hn::Set(DF(), sweep.temperature);
    const auto even = hn::Set(du, sweep.key_even), odd = hn::Set(du, sweep.key_odd);
    if constexpr (kNarrow) {
      // A word of 32 bits belongs to an even column and its neighbour.
      index_ = hn::Mul(hn::Iota(du, 0u), hn::Set(du, kGolden));
      key_ = even;
      other_key_ = odd;
    } else {
      const auto lane = hn::Iota(du, 0u);
      const auto is_odd = hn::Ne(hn::And(lane, hn::Set(du, 1u)), hn::Zero(du));
      index_ = hn::Mul(hn::ShiftRight<1>(lane), hn::Set(du, kGolden));
      key_ = hn::IfThenElse(is_odd, odd, even);
      other_key_ = hn::IfThenElse(is_odd, even, odd);
    }
  }

  /// Columns from..end - 1 of row y with row q_y; `first_partner`, if not null, tells which columns count.
  void columns(int y, int q_y, int from, int end, const Lane* first_partner) {
    const auto lanes = static_cast<int>(hn::Lanes(D()));
    const Rows rows = rows_of(y, q_y, 0);
    while (from < end) {
      // Even, so that a pair of columns shares a random word; and inside the row's storage.
      int x = from & ~1;
      if (x + lanes > state_.width + 1) x = std::max(0, (state_.width - lanes + 1) & ~1);
      if (first_partner != nullptr) {
        const M counted = hn::MaskFromVec(hn::LoadU(D(), first_partner + x));
        vector<true>(rows, y, q_y, x, hn::And(counted, range(x, from, end)));
      } else if (x == from && x + lanes <= end) {
        vector<false>(rows, y, q_y, x, M());
      } else {
        vector<true>(rows, y, q_y, x, range(x, from, end));
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
  static V8 byte_pairs(int x, int y) {
    return hn::BitCast(D8(), hn::Set(D(), static_cast<Lane>((x & 255) | (y & 255) << 8)));
  }

  /// Of the columns from x, those in from..end - 1.
  static M range(int x, int from, int end) {
    const D d;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    return hn::AndNot(hn::FirstN(d, static_cast<std::size_t>(from - x)),
                      hn::FirstN(d, static_cast<std::size_t>(std::min(end - x, lanes))));
  }

  /// Where the first partners' and the second ones' lanes of column 0 lie, for one channel.
  struct Rows {
    Lane *bytes_p, *bytes_q, *level_p, *level_q;
    const Lane *landing_p, *landing_q;
  };
  /// The same of z.
  struct DeepRows {
    Lane *p, *q;
  };
  Rows rows_of(int y, int q_y, std::size_t c) const {
    const int s_x = sweep_.s.x;
    return {state_.row(state_.bytes, y),      state_.row(state_.bytes, q_y) + s_x,
            state_.row(state_.level[c], y),   state_.row(state_.level[c], q_y) + s_x,
            state_.row(state_.landing[c], y), state_.row(state_.landing[c], q_y) + s_x};
  }

  template <class Body>
  void each_plane(int y, Body&& body) {
    for (auto& plane : state_.level) body(state_.row(plane, y));
    body(state_.row(state_.bytes, y));
    if constexpr (kVolume) body(state_.row(state_.bytes_z, y));
  }

  HWY_INLINE V8 moved(V bytes, V8 by) const {
    V8 sum = hn::Add(hn::BitCast(D8(), bytes), by);
    if (periodic_) sum = hn::Min(sum, hn::Sub(sum, period_));
    return sum;
  }

  /// moved() of z, whose word has nothing in its upper byte.
  HWY_INLINE V8 moved_z(V bytes, V8 by) const {
    const V8 sum = hn::Add(hn::BitCast(D8(), bytes), by);
    return hn::Min(sum, hn::Sub(sum, period_z_));
  }

  /// within() for displacements with z.
  HWY_INLINE M within_volume(V8 a, V8 a_z, V8 b, V8 b_z) const {
    const D d;
    if (!euclidean_) {
      const V8 flat = hn::Or(hn::SaturatedSub(a, limit_), hn::SaturatedSub(b, limit_));
      const V8 deep = hn::Or(hn::SaturatedSub(a_z, limit_), hn::SaturatedSub(b_z, limit_));
      return hn::Eq(hn::BitCast(d, hn::Or(flat, deep)), hn::Zero(d));
    }
    const auto outside = [&](V8 bytes, V8 bytes_z) {
      const V least = hn::BitCast(d, hn::Min(bytes, hn::Sub(period_, bytes)));
      const V x = hn::And(least, hn::Set(d, Lane{255}));
      const V y = hn::ShiftRight<8>(least);
      const V z = hn::BitCast(d, hn::Min(bytes_z, hn::Sub(period_z_, bytes_z)));
      const V sum = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
      return hn::Gt(sum, hn::BitCast(d, limit_));
    };
    return hn::Not(hn::Or(outside(a, a_z), outside(b, b_z)));
  }

  HWY_INLINE M within(V8 a, V8 b) const {
    const D d;
    if (!euclidean_) {
      return hn::Eq(hn::BitCast(d, hn::Or(hn::SaturatedSub(a, limit_), hn::SaturatedSub(b, limit_))),
                    hn::Zero(d));
    }
    const auto outside = [&](V8 bytes) {
      const V least = hn::BitCast(d, hn::Min(bytes, hn::Sub(period_, bytes)));
      const V x = hn::And(least, hn::Set(d, Lane{255}));
      const V y = hn::ShiftRight<8>(least);
      return hn::Gt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::BitCast(d, limit_));
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

  HWY_INLINE V channel_change(const Rows& rows, int x) const {
    const D d;
    return pair_change(hn::LoadU(d, rows.level_p + x), hn::LoadU(d, rows.level_q + x),
                       hn::LoadU(d, rows.landing_p + x), hn::LoadU(d, rows.landing_q + x));
  }

  HWY_INLINE V thresholds(int x, int y) const {
    const D d;
    const DU32 du;
    const std::uint32_t base =
        static_cast<std::uint32_t>(y) * (static_cast<std::uint32_t>(state_.width + 1) / 2) +
        static_cast<std::uint32_t>(x) / 2;
    // (base + i) * kGolden, the product of i made once.
    const auto index = hn::Add(hn::Set(du, base * kGolden), index_);
    const auto low = threshold_lanes(du, mix_lanes(du, hn::Add(index, key_), other_key_), temperature_, kCap);
    if constexpr (!kNarrow) {
      return low;
    } else {
      const auto high =
          threshold_lanes(du, mix_lanes(du, hn::Add(index, other_key_), key_), temperature_, kCap);
      return hn::BitCast(d, hn::Or(low, hn::ShiftLeft<16>(high)));
    }
  }

  /// The pairs of one vector; of them only `counted` if kMasked.
  template <bool kMasked>
  HWY_INLINE void vector(const Rows& rows, int y, int q_y, int x, M counted) {
    const D d;
    const V p = hn::LoadU(d, rows.bytes_p + x), q = hn::LoadU(d, rows.bytes_q + x);
    const V8 to_q = moved(p, plus_), to_p = moved(q, minus_);
    DeepRows deep{};
    V8 to_q_z = plus_, to_p_z = plus_;
    M open;
    if constexpr (kVolume) {
      deep = {state_.row(state_.bytes_z, y) + x, state_.row(state_.bytes_z, q_y) + sweep_.s.x + x};
      to_q_z = moved_z(hn::LoadU(d, deep.p), plus_z_);
      to_p_z = moved_z(hn::LoadU(d, deep.q), minus_z_);
      open = within_volume(to_q, to_q_z, to_p, to_p_z);
    } else {
      open = within(to_q, to_p);
    }
    if constexpr (kMasked) open = hn::And(open, counted);

    V change = channel_change(rows, x);
    if constexpr (!kSingle) {
      change = hn::Mul(change, hn::Set(d, state_.weight[0]));
      for (std::size_t c = 1; c < state_.level.size(); ++c) {
        change =
            hn::Add(change, hn::Mul(channel_change(rows_of(y, q_y, c), x), hn::Set(d, state_.weight[c])));
      }
    }
    open = hn::AndNot(hn::Gt(change, most_), open);
    if (hn::AllFalse(d, open)) return;
    const M taken = hn::AndNot(hn::Gt(change, thresholds(x, y)), open);
    if (hn::AllFalse(d, taken)) return;

    dirty_ = true;
    const auto swap_lanes = [&](Lane* at_p, Lane* at_q, V new_p, V new_q, V old_p) {
      hn::StoreU(hn::IfThenElse(taken, new_p, old_p), d, at_p);
      // Both may lie in one row: read again what the first store may have changed.
      hn::StoreU(hn::IfThenElse(taken, new_q, hn::LoadU(d, at_q)), d, at_q);
    };
    swap_lanes(rows.bytes_p + x, rows.bytes_q + x, hn::BitCast(d, to_p), hn::BitCast(d, to_q), p);
    if constexpr (kVolume) {
      swap_lanes(deep.p, deep.q, hn::BitCast(d, to_p_z), hn::BitCast(d, to_q_z), hn::LoadU(d, deep.p));
    }
    for (std::size_t c = 0; c < (kSingle ? 1 : state_.level.size()); ++c) {
      const Rows channel = kSingle ? rows : rows_of(y, q_y, c);
      const V v_p = hn::LoadU(d, channel.level_p + x), v_q = hn::LoadU(d, channel.level_q + x);
      swap_lanes(channel.level_p + x, channel.level_q + x, v_q, v_p, v_p);
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
  V8 plus_, minus_, period_, limit_;
  V8 plus_z_, minus_z_, period_z_;  // of volumes
  V most_;
  hn::Vec<DU32> index_, key_, other_key_;
  hn::Vec<DF> temperature_;
  bool periodic_, euclidean_;
  bool dirty_ = false;
  std::int64_t accepted_ = 0, changed_ = 0, change_ = 0;
};

}  // namespace bn::retarget::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#endif  // BN_RETARGET_SWEEP_ROWS_INL_H_
