// bn/offsets.h - floor 2: using one mask in many frames, for many samples and with an importance map.
//
// The arithmetic is in 32-bit integers; textures/shaders/bn_offsets.glsl and .hlsl have the same functions,
// and a test compares them bit by bit.
//
//   value of pixel p in frame t:    rotated(mask(p), golden_offset(t))           one mask for every frame
//   a second number a pixel:        rotated(mask(p), r2_offset(t)[1])            its frames are a lattice in
//   the square after the last slice:           slice t mod T, read at p + cycle_shift(t, {W, H, T}) k samples
//   a pixel and frame:    sample i reads at p + sample_shifts(k, {W, H})[i]

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bn/grid.h"

namespace bn {

// --- offsets of values -----------------------------------------------------------------------------
// A fraction of 1 in units of 2^-32. Multiples of these numbers, modulo 1, are the additive recurrences of
// least discrepancy: after any number of frames they are spread as evenly as such a sequence can be. Their
// multipliers are odd, so 2^32 frames pass before one comes again. Source: M. Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018.

/// i / phi modulo 1, phi the golden ratio.
constexpr std::uint32_t golden_offset(std::uint32_t i) { return i * 2654435769u; }

/// i sqrt(2) modulo 1.
constexpr std::uint32_t sqrt2_offset(std::uint32_t i) { return i * 1779033703u; }

/// (i / g, i / g^2) modulo 1, g the plastic number: the sequence R2, even in the square.
constexpr std::array<std::uint32_t, 2> r2_offset(std::uint32_t i) {
  return {i * 3242174889u, i * 2447445413u};
}

/// A value in [0, 1) moved on by an offset, around to 0 at 1 (a Cranley-Patterson rotation), in [0, 1). The
/// value's histogram stays as flat as it was.
constexpr float rotated(float value, std::uint32_t offset) {
  const float sum = value + static_cast<float>(offset >> 8) * (1.0f / 16777216.0f);
  return sum < 1.0f ? sum : sum - 1.0f;
}

// --- shifts in pixels ------------------------------------------------------------------------------

/// The pixels, 0..side-1, that a fraction of a side comes to; side 1..65536.
constexpr int pixels_of(std::uint32_t offset, int side) {
  return static_cast<int>((std::uint64_t{offset >> 16} * static_cast<std::uint32_t>(side)) >> 16);
}

/// Where to read a mask in frame i: shifts by R2, so that a pixel meets the whole mask evenly.
constexpr Offset r2_shift(std::uint32_t i, Extent size) {
  const auto [x, y] = r2_offset(i);
  return {pixels_of(x, size.width), pixels_of(y, size.height)};
}

/// Where to read slice `frame` modulo depth of a stack: not shifted in the first cycle, by R2 from cycle to
/// cycle after that, so that what is left of the error goes on falling.
constexpr Offset cycle_shift(std::uint32_t frame, Shape shape) {
  return r2_shift(frame / static_cast<std::uint32_t>(shape.depth), shape.slice());
}

/// Where `count` samples of one pixel read one mask: shifts as far from each other, around the torus, as a
/// rank-1 lattice allows, the first {0, 0}; blue noise is nearly independent at such distances.
/// count 1..4096, sides 1..16384. Errors: invalid_input. Cost: count^2 steps.
std::vector<Offset> sample_shifts(int count, Extent size);

/// The largest depth up to `depth` without a common factor with `period`: with so many slices, every pixel
/// meets every slice with every phase of a jitter (of TAA, most often) of that period. Both 1..65536. Errors:
/// invalid_input.
int coprime_depth(int depth, int period);

// --- adaptive sampling -----------------------------------------------------------------------------

/// Which pixels to sample in a frame: those where (rank + 1/2) / N < importance. `ranks` holds 0..N-1 in each
/// slice, which is repeated over the importance map; the map holds shares of the frames in which a pixel is
/// to be sampled, 0..1. What is chosen is spread as evenly as the mask's patterns are, at any density, and
/// follows the map. Frame t reads slice t modulo depth, shifted by cycle_shift(). Errors: invalid_input (a
/// map with values that are no numbers). Cost: one comparison a pixel.
Grid<std::uint8_t> sampled_pixels(const Grid<std::uint32_t>& ranks, const Grid<float>& importance,
                                  std::uint32_t frame);

/// How many pixels are sampled at least once in frames 0..frames-1.
std::int64_t distinct_pixels(const Grid<std::uint32_t>& ranks, const Grid<float>& importance,
                             std::uint32_t frames);

}  // namespace bn
