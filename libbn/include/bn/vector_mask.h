// bn/vector_mask.h - floor 2: blue-noise masks of vectors and directions, still or in volumes.
//
// Every voxel has a vector. Of any test function of the vector, a half-plane or a cap of directions, what is
// left of the error after blurring a frame and averaging frames is small: bn/spatiotemporal.h says how that
// is meant for scalars, docs/vector_masks.md for vectors.
//
//   const Grid<std::uint32_t> mask = vector_mask({.values = VectorValues::hemisphere});
//   const std::array<float, 4> direction = vector_value(VectorValues::hemisphere, mask(x, y, frame));
//
// Status: new; names may still change.

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bn/spatiotemporal.h"

namespace bn {

/// Raised whenever the same options would give other bytes than before. Written into every file.
inline constexpr int kVectorMaskVersion = 1;

// --- values ----------------------------------------------------------------------------------------

enum class VectorValues {
  vec2,        ///< uniform in [0,1)^2
  vec3,        ///< uniform in [0,1)^3
  vec4,        ///< uniform in [0,1)^4
  circle,      ///< uniform on the unit circle
  sphere,      ///< uniform on the unit sphere
  hemisphere,  ///< on the unit sphere's half z >= 0, with a density in proportion to z
};
std::string_view name_of(VectorValues values);  ///< "vec2", "vec3", ...

/// Components of a value: 2, 3, 4; circle 2; sphere and hemisphere 3.
int vector_components(VectorValues values);

/// The value at a place, a 32-bit fraction of a curve through all values: equal stretches of the curve have
/// equal probability, and near places have near values. Components beyond those of the value are 0.
///
/// The curve is Hilbert's in the cube (bn/space_filling_curve.h), a value the middle of its cell: of 16 bits
/// a component for vec2, 10 for vec3, 8 for vec4. Directions are taken from the square by maps that keep
/// areas: sphere by the octahedral map (Clarberg 2008), hemisphere by the concentric map (Shirley and Chiu
/// 1997). The circle is its own curve: (cos, sin) of the fraction of a turn.
/// Same bits everywhere.
std::array<float, 4> vector_value(VectorValues values, std::uint32_t place);

// --- masks -----------------------------------------------------------------------------------------

/// How unlike two values are, by their distance d.
enum class VectorEnergy {
  half_spaces,  ///< d: how often a random half-space, of any direction and offset, parts them
  /// 1 - exp(-d^(n/2)), n the dimensions of the values (circle 1, sphere and hemisphere 2): Georgiev and
  /// Fajardo 2016. Theirs in all is with the preset stbn and sigma_px 2.1 / sqrt(2).
  georgiev_fajardo,
};
std::string_view name_of(VectorEnergy energy);  ///< "half_spaces", "georgiev_fajardo"

/// What a vector mask is made from. Equal options give equal masks, everywhere.
struct VectorMaskOptions {
  VectorValues values = VectorValues::vec2;
  VectorEnergy energy = VectorEnergy::half_spaces;
  /// Size, filters, ranks, seed and the kernel's constants. `ranks` slice: the values of each slice are
  /// spread evenly, one in each of width * height equal stretches of the curve; volume: those of all slices
  /// together.
  SpatiotemporalOptions mask = {};
  /// How often each voxel looks for a better value, on average, 0..kMostVectorBudget; 0: the curve alone.
  std::int64_t budget = 20;
};
inline constexpr std::int64_t kMostVectorBudget = 10000;

/// The scalar mask pushed through the curve: voxels' places, by rank. Of the values of n voxels, one is in
/// each n-th of the curve (n of a slice or of the volume), so the share of values in a cell of 2^-k of the
/// curve is exact to 1 / n. All values differ while n * slices <= 2^32.
/// Errors, threads and memory: spatiotemporal_mask(). Cost: that, and 20 ns a voxel.
Grid<std::uint32_t> curve_mask(const VectorMaskOptions& options, const Execution& execution = {});

/// curve_mask(), then values exchanged between voxels, of a slice or of the volume (`ranks`), whenever that
/// lowers the energy
///
///   - sum over pairs i < j of A(i - j) D(v_i, v_j)
///
/// A the kernel of spatiotemporal_kernel(), D by VectorEnergy. With half_spaces the energy is, but for a
/// constant, the mean over all half-planes, half-spaces or caps of what void-and-cluster lowers for
/// thresholds. Distances and weights are integers: the same bytes on any number of threads and on any
/// machine. Errors: invalid_input (an option outside its range), over_limit (memory), cancelled. Threads:
/// execution.threads; a round has work for one thread in 40 of its voxels, and there are about width * height
/// / 25 of them for the default blur. Memory: at most 60 bytes a voxel. A stop is heeded within milliseconds.
/// Cost: in proportion to budget, voxels, and the voxels that one sees; about 5 us a voxel and unit of budget
/// for the default filters at a depth of 32.
Grid<std::uint32_t> vector_mask(const VectorMaskOptions& options, const Execution& execution = {});

}  // namespace bn
