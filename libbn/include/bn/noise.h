// bn/noise.h - floor 1: blue-noise masks.

#pragma once

#include <cstdint>

#include "bn/core.h"

namespace bn {

/// Raised whenever the same options would give other bytes than before. Written into every file.
inline constexpr int kVoidAndClusterVersion = 1;

/// What a void-and-cluster mask is made from. Equal options give equal masks, everywhere.
struct VoidAndClusterOptions {
  Extent size{64, 64};           ///< each side 1..16384 pixels
  double sigma_px = 1.9;         ///< standard deviation of the Gaussian, 0.3..16 pixels
  double initial_density = 0.0;  ///< share of the ranks ordered by removing clusters, 0..0.5; 0 suits best
  std::uint64_t seed = 1;        ///< any value; stream numbers are listed in void_and_cluster.cpp
  int cutoff_px = 0;             ///< kernel radius, 1..64 pixels; 0: where the weight rounds to zero
};

/// A scalar blue-noise mask by void-and-cluster: the rank of each pixel, a permutation of
/// 0..width*height-1, toroidal.
///
/// Source: R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913
/// (1993). Energies are integers, so neither order nor instruction set nor threads can change a bit.
/// Ties go to the lowest index y * width + x.
///
/// Sizes below the kernel's are correct: the kernel wraps onto itself.
/// Errors: invalid_input (an option outside its range), over_limit (memory), cancelled.
/// Threads: execution.threads. Cost: see docs/methods.md for measured figures; memory about 12 bytes
/// a pixel.
Grid<std::uint32_t> void_and_cluster(const VoidAndClusterOptions& options, const Execution& execution = {});

}  // namespace bn
