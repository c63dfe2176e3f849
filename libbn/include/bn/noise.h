// bn/noise.h - floor 2: blue-noise masks, and the patterns they are compared with.

#pragma once

#include <cstdint>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"

namespace bn {

/// Raised whenever the same options would give other bytes than before. Written into every file.
inline constexpr int kVoidAndClusterVersion = 2;

/// What a void-and-cluster mask is made from. Equal options give equal masks, everywhere.
struct VoidAndClusterOptions {
  Extent size{64, 64};           ///< each side 1..16384 pixels
  double sigma_px = 1.9;         ///< standard deviation of the Gaussian, 0.3..16 pixels
  double initial_density = 0.0;  ///< share of the ranks ordered by removing clusters, 0..0.5; 0 suits best,
                                 ///< and only with 0 are the sparsest patterns evenly spread
  std::uint64_t seed = 1;        ///< any value; stream numbers are listed in void_and_cluster.cpp
  int cutoff_px = 0;             ///< kernel radius, 1..64 pixels; 0: where the weight rounds to zero
};

/// A scalar blue-noise mask by void-and-cluster: the rank of each pixel, a permutation of
/// 0..width*height-1, toroidal.
///
/// Source: R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913
/// (1993); what differs, and the method: docs/void_and_cluster.md. Energies are integers, so neither
/// order nor instruction set nor threads can change a bit. Ties go to the lowest index y * width + x.
/// Sizes below the kernel's are correct: the kernel wraps onto itself.
///
/// Errors: invalid_input (an option outside its range), over_limit (memory), cancelled.
/// Threads: execution.threads, useful from 1024 pixels a side on; a stop is heeded within
/// milliseconds. Cost at sigma 1.9 on one core: about 120 ns a pixel at 256² and 512², 165 ns at
/// 4096² and above (8 ms for 256², 0.14 s for 1024², 2.6 s for 4096²); it grows with the square of
/// sigma. Memory: 12 bytes a pixel.
Grid<std::uint32_t> void_and_cluster(const VoidAndClusterOptions& options, const Execution& execution = {});

// --- baselines: what masks are compared with -------------------------------------------------------
// Ranks 0..N-1 like a mask's; ties in a pattern's value go to the lowest index. Sides 1..16384.
// Decided by integers or by IEEE products in a written order: the same bytes everywhere.
// Errors: invalid_input (a side outside its range). Cost: N log N; one thread.

/// Independent ranks: a random permutation.
Grid<std::uint32_t> white_noise_mask(Extent size, std::uint64_t seed);

/// The recursive ordered-dither matrix; `side` a power of two. Source: B. E. Bayer, "An optimum method
/// for two-level rendition of continuous-tone pictures", ICC 1973.
Grid<std::uint32_t> bayer_mask(int side);

/// Interleaved gradient noise, frac(52.9829189 frac(0.06711056 x + 0.00583715 y)), in double. Not toroidal.
/// Source: J. Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
Grid<std::uint32_t> interleaved_gradient_mask(Extent size);

/// The lattice frac(x / g + y / g^2), g the plastic number, the additive recurrence R2 read along x and y.
/// Not toroidal. Source: M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
Grid<std::uint32_t> r2_mask(Extent size);

/// Slice t = 0..depth-1 of a still mask shifted by the golden ratio: rank + floor(N frac(t / phi)) modulo N.
/// In space each slice is nearly as good as the mask; in time each pixel runs through a
/// one-dimensional low-discrepancy sequence. `mask` holds ranks 0..N-1.
std::vector<Grid<std::uint32_t>> golden_ratio_slices(const Grid<std::uint32_t>& mask, int depth);

/// A picture of `size` covered with repetitions of `mask`; its values are the mask's.
Grid<std::uint32_t> tiled(const Grid<std::uint32_t>& mask, Extent size);

}  // namespace bn
