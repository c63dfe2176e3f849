// bn/spatiotemporal.h - floor 2: blue-noise masks in volumes, made for the filter that will average them.
//
// A volume is a stack of slices, one a frame (or of time and a further axis). Its voxels are ranked by
// void-and-cluster with any kernel that is a sum of separable terms. With the autocorrelation of a filter as
// the kernel, every thresholded picture keeps the least variance after that filter; docs/spatiotemporal.md
// has the reasons, the figures and the preset for each use.
//
//   Grid<std::uint32_t> ranks = spatiotemporal_mask({.size = {128, 128, 64}});
//   std::vector<std::uint8_t> frame_3 = ... ranks.slice(3), each rank * 256 / (128 * 128)
//
// Status: new; names may still change.

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"

namespace bn {

/// Raised whenever the same options would give other bytes than before. Written into every file.
inline constexpr int kVolumeMaskVersion = 2;

// --- kernels as data -------------------------------------------------------------------------------

/// How much two voxels see of each other along one axis, at a distance d; 1 at d = 0.
enum class AxisForm {
  one,          ///< 1 at every distance. Along z and w only, or where the side is 1
  delta,        ///< only at d = 0
  gauss,        ///< exp(-d^2 / (2 width^2)); width 0.3..64
  tent,         ///< 1 - |d| / width, the autocorrelation of a box of `width` taps; width 1..64
  binomial,     ///< that of the binomial filter of order `width` ([1 2 1] is of order 2); 1..64, whole
  exponential,  ///< (1 - width)^|d|, that of an exponential average; width is its alpha, 0.0001..1
};

struct AxisFunction {
  AxisForm form = AxisForm::delta;
  double width = 0.0;  ///< of the forms that have one
};

/// weight x(dx) y(dy) z(dz) w(dw), each function wrapped around its axis of the torus (all images added).
/// Along x and y it ends at 64 pixels.
struct KernelTerm {
  double weight = 1.0;  ///< above 0, up to 1e6
  AxisFunction x = {}, y = {}, z = {};
  AxisFunction w = {AxisForm::one};
};

/// The sum of its terms, 1 to 16. Only proportions count.
using VolumeKernel = std::vector<KernelTerm>;

// --- masks by void-and-cluster ---------------------------------------------------------------------

/// The sides of a torus of up to four axes. Those that are not used are 1. Slice w * z_side + z of the result
/// is what lies at (z, w).
struct TorusSides {
  int x = 1;  ///< 1..16384
  int y = 1;  ///< 1..16384
  int z = 1;  ///< z * w: 1..16384
  int w = 1;
  friend bool operator==(const TorusSides&, const TorusSides&) = default;
};

enum class RankScope {
  slice,   ///< 0..width*height-1 in each slice: every level equally often in every slice
  volume,  ///< 0..width*height*depth-1 over all slices
};

struct VolumeMaskOptions {
  TorusSides size;
  VolumeKernel kernel;
  RankScope ranks = RankScope::slice;
  std::uint64_t seed = 1;  ///< any value; stream numbers are listed in volume_mask.cpp
};

/// Void-and-cluster on a torus of one to four axes: voxels are set one after another, always the one of least
/// energy (the largest void), and each adds the kernel to the energies around it. Returns the ranks in that
/// order, by RankScope. Voxels set at equal energies do not see each other; which of them comes first is
/// random.
///
/// With one slice it is the two-dimensional method for another kernel; for a single Gaussian in x and y it
/// returns what void_and_cluster() returns for that sigma and seed.
///
/// Energies are integers, so neither order nor instruction set nor threads can change a bit. Sides below the
/// kernel's are correct.
/// Errors: invalid_input (an option outside its range), over_limit (memory), cancelled.
/// Threads: execution.threads, useful from 128x128 pixels on; a stop is heeded within milliseconds.
/// Cost: in proportion to voxels and to those that one has in reach, about 0.5 us a voxel for the presets
/// below at a depth of 64. Memory: at most 16 bytes a voxel.
Grid<std::uint32_t> volume_mask(const VolumeMaskOptions& options, const Execution& execution = {});

// --- presets ---------------------------------------------------------------------------------------

enum class SpatiotemporalPreset {
  stbn,      ///< voxels see each other in one slice or at one pixel: each slice and each series is blue
  filtered,  ///< made for the spatial and the temporal filter: the least error after both
  both,      ///< nearly as good after the filters, and each pixel's series is blue
};
std::string_view name_of(SpatiotemporalPreset preset);  ///< "stbn", "filtered", "both"

/// What blurs a frame. Its width is, for gauss, the standard deviation in pixels, 0.3..11; for box the side
/// in pixels, 1..64; for binomial the order, 1..64 ([1 2 1] is of order 2).
enum class SpatialFilter { none, gauss, box, binomial };

/// What averages the frames. Its width is, for ema (the exponential moving average), alpha, 0.0001..1; for
/// box the frames, 1..64; for gauss the standard deviation in frames, 0.3..45.
enum class TemporalFilter { none, ema, box, gauss };

/// What a spatiotemporal mask is made from. Equal options give equal masks, everywhere. A constant that is
/// not set is the one that was measured best (docs/spatiotemporal.md); spatiotemporal_constants() tells it.
struct SpatiotemporalOptions {
  Shape size{128, 128, 64};  ///< width and height 1..16384, depth 1..16384; depth 1: a mask made for a blur
  SpatiotemporalPreset preset = SpatiotemporalPreset::both;
  SpatialFilter spatial = SpatialFilter::gauss;
  double spatial_width = 1.3435;
  TemporalFilter temporal = TemporalFilter::ema;
  double temporal_width = 0.1;
  RankScope ranks = RankScope::slice;
  std::uint64_t seed = 1;

  // The kernel's constants.
  std::optional<double> sigma_px = {};     ///< of its Gaussian in a slice, 0.3..16 pixels
  std::optional<double> gauss_share = {};  ///< weight of that Gaussian beside the box filter's tent, 0..16
  std::optional<double> slice_share = {};  ///< share of what is seen in the same slice only, 0..1
  std::optional<double> pixel_share = {};  ///< weight of what is seen at the same pixel only, 0..16
  std::optional<double> pixel_sigma = {};  ///< standard deviation of the latter, 0.3..64 frames
};

/// `options` with every constant set.
SpatiotemporalOptions spatiotemporal_constants(const SpatiotemporalOptions& options);

/// The kernel that the options mean:
///   stbn:      G(dx, dy) [dz = 0] + c [dx = dy = 0] G_p(dz)
///   filtered:  A(dx, dy) (u [dz = 0] + (1 - u) B(dz))
///   both:      A(dx, dy) (u [dz = 0] + (1 - u) B(dz)) + c [dx = dy = 0] G_p(dz)
/// A and B the autocorrelations of the filters (A as a slightly narrower Gaussian, or with a Gaussian added),
/// u slice_share, c pixel_share, G of sigma_px, G_p of pixel_sigma. A volume of depth 1 has A or G alone.
/// Errors: invalid_input (an option outside its range).
VolumeKernel spatiotemporal_kernel(const SpatiotemporalOptions& options);

/// volume_mask() of that kernel. Errors, threads, cost and memory: there.
Grid<std::uint32_t> spatiotemporal_mask(const SpatiotemporalOptions& options,
                                        const Execution& execution = {});

}  // namespace bn
