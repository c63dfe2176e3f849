// The sweep on vectors: sweep_plainly() of sweep.h, a row of pairs at a time, equal to it bit for bit.
//
// Lanes of 16 bits serve one channel or more of 8 to 14 bit levels under L1, lanes of 32 bits the rest that
// fits. SCALAR, Highway's one-lane target, runs the plain statement.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "retarget/sweep_kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

#include "retarget/sweep.h"
#include "retarget/sweep_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bn::retarget::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

template <Metric metric, bool kSingle, bool kVolume, class Lane>
void sweep_band(SweepState<Lane>& state, const AnnealInstance& instance, const Sweep& sweep, const Band& band,
                SweepCounts& result) {
  sweep_plainly<metric, kVolume>(state, instance, sweep, band, result, nullptr);
}

#else

template <Metric metric, bool kSingle, bool kVolume, class Lane>
void sweep_band(SweepState<Lane>& state, const AnnealInstance& instance, const Sweep& sweep, const Band& band,
                SweepCounts& result) {
  RowSweeper<metric, kSingle, kVolume, Lane> sweeper(state, sweep);
  const int s_x = sweep.s.x, width = state.width;
  const bool wraps = instance.options.wrap;
  std::int64_t pairs = 0;

  if (sweep.s.y != 0 || (kVolume && sweep.s.z != 0)) {
    const int columns = wraps ? width : width - s_x;
    const auto rows = [&](int y, int q_y) {
      pairs += columns;
      sweeper.columns(y, q_y, 0, columns, nullptr);
      if (!sweeper.take_dirty()) return;
      if (wraps) sweeper.unwrap(q_y);
      sweeper.repeat(y);
      sweeper.repeat(q_y);
    };
    if constexpr (kVolume) {
      for_each_volume_row_pair(sweep, band, state.slice_height, state.depth, wraps, rows);
    } else {
      for_each_row_pair(sweep, band, state.height, rows);
    }
  } else {
    std::vector<Lane> first_partner(static_cast<std::size_t>(width) + SweepState<Lane>::kMaxLanes, Lane{0});
    int in_a_row = 0;
    for (int x = 0; x < (wraps ? width : width - s_x); ++x) {
      if (!starts_pair(sweep, width, x)) continue;
      first_partner[static_cast<std::size_t>(x)] = Lane{-1};
      ++in_a_row;
    }
    for_each_row(band, state.slice_height, kVolume ? state.depth : 1, [&](int y) {
      pairs += in_a_row;
      // Across the border first, while the repeated columns are still those of the row.
      if (wraps) {
        sweeper.columns(y, y, width - s_x, width, first_partner.data());
        if (sweeper.take_dirty()) sweeper.unwrap(y);
      }
      sweeper.columns(y, y, 0, width - s_x, first_partner.data());
      sweeper.repeat(y);
    });
  }
  result.counts.proposals += pairs;
  sweeper.add_to(result);
}

#endif

void L1Single16(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, true, false>(state, instance, sweep, band, result);
}
void L1Of16(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
            const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, false, false>(state, instance, sweep, band, result);
}
void L1Of32(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
            const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, false, false>(state, instance, sweep, band, result);
}
void L2Of32(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
            const Band& band, SweepCounts& result) {
  sweep_band<Metric::l2, false, false>(state, instance, sweep, band, result);
}
void VolumeL1Of16(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                  const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, false, true>(state, instance, sweep, band, result);
}
void VolumeL1Of32(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                  const Band& band, SweepCounts& result) {
  sweep_band<Metric::l1, false, true>(state, instance, sweep, band, result);
}
void VolumeL2Of32(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                  const Band& band, SweepCounts& result) {
  sweep_band<Metric::l2, false, true>(state, instance, sweep, band, result);
}

}  // namespace bn::retarget::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn::retarget {

HWY_EXPORT(L1Single16);
HWY_EXPORT(L1Of16);
HWY_EXPORT(L1Of32);
HWY_EXPORT(L2Of32);
HWY_EXPORT(VolumeL1Of16);
HWY_EXPORT(VolumeL1Of32);
HWY_EXPORT(VolumeL2Of32);

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

void sweep_volume_l1(SweepState<std::int16_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result) {
  HWY_DYNAMIC_DISPATCH(VolumeL1Of16)(state, instance, sweep, band, result);
}
void sweep_volume_l1(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result) {
  HWY_DYNAMIC_DISPATCH(VolumeL1Of32)(state, instance, sweep, band, result);
}
void sweep_volume_l2(SweepState<std::int32_t>& state, const AnnealInstance& instance, const Sweep& sweep,
                     const Band& band, SweepCounts& result) {
  HWY_DYNAMIC_DISPATCH(VolumeL2Of32)(state, instance, sweep, band, result);
}

}  // namespace bn::retarget
#endif
