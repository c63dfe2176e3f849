// bn/runtime.h - floor 2: the temporal algorithm at work.
//
// A renderer whose pixels draw all their random numbers from one seed each moves those seeds between
// frames, so that the error of the picture becomes blue noise:
//
//   trace with the seeds  ->  sort them, block by block, like the dither mask  ->  retarget them from
//   this frame's mask to the next frame's  ->  next frame
//
// Source: E. Heitz and L. Belcour, "Distributing Monte Carlo errors as a blue noise in screen space
// by permuting pixel seeds between frames", Computer Graphics Forum 38(4), 2019.
//
// The functions of this header are the specification; the shaders in textures/shaders must equal
// them bit for bit. Conventions (grid, dither, scatter form, padding): docs/conventions.md.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bn/core.h"

namespace bn {

// --- random numbers of a pixel -----------------------------------------------------------------

/// One seed a pixel. The seed alone decides a pixel's samples: no frame number, no position.
using Seeds = Grid<std::uint32_t>;

/// A bijection of the 32-bit integers without visible structure: PCG-RXS-M-XS.
/// Source: M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
constexpr std::uint32_t pcg_hash(std::uint32_t value) {
  const std::uint32_t state = value * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

/// Random number `dimension` = 0, 1, ... of the stream that `seed` stands for, in [0, 1): a multiple
/// of 2^-24, so exact in single precision on any machine.
constexpr float sample(std::uint32_t seed, std::uint32_t dimension) {
  const std::uint32_t bits = pcg_hash(pcg_hash(seed) + dimension * 0x9E3779B9u);
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// The seed image for a screen: padded up to multiples of the tile, where a retarget tile wraps.
Extent padded_extent(Extent screen, Extent tile);

/// Seeds in no order, all different. `size` at most 2^32 pixels; `start` chooses another set.
Seeds initial_seeds(Extent size, std::uint32_t start);

/// A number that any permutation of the seeds leaves alone, and that almost any other change moves.
std::uint64_t multiset_digest(const Seeds& seeds);

// --- the passes --------------------------------------------------------------------------------

/// The baked textures of one run. check() throws invalid_input naming the first thing that is wrong.
struct TemporalTextures {
  Grid<std::int32_t> mask;  ///< levels 0..65535
  Offset step;              ///< d: frame t dithers pixel p with mask texel p + t * d
  /// Scatter form, each of the mask's size: empty (never retarget), one (plain), or
  /// (2 * motion_range + 1)^2 variants row by row, the plain one in the middle.
  std::vector<Grid<Offset>> moves = {};
  int motion_range = 0;  ///< 0..8

  void check() const;
  /// The tile for a motion within the range.
  const Grid<Offset>& move(Offset motion) const;
};

/// Where frame `frame` begins in a tile of `tile` texels: frame * step, wrapped into it.
Offset tile_shift(Extent tile, Offset step, std::int64_t frame);

/// The blocks within which seeds are sorted.
struct SortBlocks {
  int side = 8;   ///< 2, 4, 8 or 16 pixels
  Offset origin;  ///< the grid's first block starts at -origin; 0..side-1 each
};

/// The grid of frame `frame`: at rest, or moved by a random offset each frame.
SortBlocks sort_blocks(int side, bool jitter, std::uint64_t seed, std::int64_t frame);

/// Sort pass. In each block the seed of the k-th darkest pixel goes to the pixel with the k-th
/// lowest mask level at `shift`. Only pixels of the screen (luminance's extent) take part; a block
/// that the screen's edge cuts is smaller.
/// The orders are total, so that every machine finds the same one: luminance is compared by its
/// exponent and its 16 leading fraction bits (relative steps of 1/65536), then by index in the block;
/// level, then index. NaN and negative luminance count as 0.
/// `seeds` is at least as large as `luminance`; `mask` levels 0..65535.
void sort_seeds(Seeds& seeds, const Grid<float>& luminance, const Grid<std::int32_t>& mask, Offset shift,
                const SortBlocks& blocks, const Execution& execution = {});

/// Retarget pass: the seed at p moves to p + move(p + shift), on the torus of `seeds`, whose sides
/// are multiples of the tile's. A bijection wherever `move` is one.
Seeds retarget_seeds(const Seeds& seeds, const Grid<Offset>& move, Offset shift,
                     const Execution& execution = {});

/// How far the picture moved at one pixel, in 1/256 pixel; x = kNoMotion where nothing is known
/// (sky, or a point that was behind the camera).
struct PixelMotion {
  std::int16_t x = 0;
  std::int16_t y = 0;
  friend bool operator==(const PixelMotion&, const PixelMotion&) = default;
};
inline constexpr std::int16_t kNoMotion = -32768;

/// The mean motion over the known pixels, rounded half up to whole pixels, clamped to -range..range
/// on each axis; (0, 0) where no pixel knows. Exact: sums are integers.
Offset choose_motion(const Grid<PixelMotion>& motion, int range);

/// What one pass of one frame took.
struct PassTime {
  std::string pass;
  double milliseconds = 0.0;
};

// --- the flat model ----------------------------------------------------------------------------

/// The algorithm alone, without a renderer: every pixel's value is sample(seed, 0)^2.
struct FlatModel {
  Extent screen{256, 256};  ///< sides a power of two, for the spectrum
  int block = 8;
  bool jitter = false;   ///< of the block grid
  bool retarget = true;  ///< with the plain tile
  int frames = 8;        ///< frames after the first
  std::uint64_t seed = 1;
};

/// For frame 0 (white noise) to `frames`: power of the values at 0 < f <= 0.1 cycles per pixel
/// against white noise of the same variance, in dB.
std::vector<double> run_flat_model(const FlatModel& model, const TemporalTextures& textures);

// --- measures ----------------------------------------------------------------------------------

/// Power of `picture` (sides powers of two) at 0 < f <= limit against white noise of its variance:
/// white noise reads 1.
double low_frequency_power(const Grid<float>& picture, double limit);

}  // namespace bn
