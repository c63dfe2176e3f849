// bn_study/trade_off.h - floor 4 (study): what a spatiotemporal mask can be good at, and at what price.
//
// One mask cannot be the best in each slice, in each pixel's series and in the filtered average at once. Two
// constants of the kernel move it between the three; this measures how far. Not installed.

#pragma once

#include <string>
#include <vector>

#include "bn/spatiotemporal.h"

namespace bn {

/// A kernel, and three errors of its mask, all of thresholded pictures (bn_study/convergence.h). Less is
/// better.
struct TradeOff {
  std::string name;  ///< the preset's; empty: a kernel of the sweep
  double slice_share = 0.0;
  double pixel_share = 0.0;
  double slice_error = 0.0;    ///< of one slice after the blur
  double average_error = 0.0;  ///< after the blur and the exponential average, mean over the last eighth of
                               ///< the frames
  double pixel_error = 0.0;    ///< of the mean of all slices at a pixel, without a blur
  bool is_best = false;        ///< no other kernel is at least as good in all three and better in one
};

/// Measures the presets, then slice_share 0..1 crossed with pixel_share 0..2, for the default filters.
/// Errors: those of spatiotemporal_mask(). Threads: one mask after the other, each by execution.threads.
std::vector<TradeOff> study_trade_off(Shape size, std::uint64_t seed, const Execution& execution = {});

/// A line each under a line of names:
/// name,slice_share,pixel_share,slice_error,average_error,pixel_error,best.
std::string trade_off_csv(const std::vector<TradeOff>& rows);

}  // namespace bn
