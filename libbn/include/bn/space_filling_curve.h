// bn/space_filling_curve.h - floor 0: Hilbert's curve in two, three and four dimensions, by integers only.
//
// The curve visits every cell of a grid of 2^bits cells a side, each once, and goes from each cell to one
// that shares a side with it. Places that are near each other on the curve are near each other in the grid,
// so a scalar mask that is pushed through the curve gives a vector mask at once (bn/vector_mask.h). A shader
// can evaluate it: 32-bit integers, shifts and exclusive or.
//
// Source: J. Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004.

#pragma once

#include <array>
#include <cstdint>

namespace bn {

/// Bits of a coordinate, so that a place on the curve has 32 bits or, in three dimensions, 30.
constexpr int curve_bits(int dimensions) { return 32 / dimensions; }

/// A cell of the grid; coordinates beyond the dimensions are 0.
using CurveCell = std::array<std::uint32_t, 4>;

/// The cell at `place`, 0 .. 2^(dimensions * curve_bits(dimensions)) - 1. In one dimension they are the same.
/// `dimensions` 1..4.
constexpr CurveCell hilbert_cell(std::uint32_t place, int dimensions) {
  const int bits = curve_bits(dimensions);
  CurveCell cell{};
  if (dimensions == 1) return {place};
  // The bits of the place in Gray's code, from the highest one, go to the coordinates in turn: in each level
  // the corner of a cube.
  place ^= place >> 1;
  for (int bit = 0; bit < bits * dimensions; ++bit) {
    const int coordinate = dimensions - 1 - bit % dimensions;
    cell[static_cast<std::size_t>(coordinate)] |= (place >> bit & 1u) << (bit / dimensions);
  }
  // Each level's cube is turned and mirrored by the corner that the level above is at.
  for (int level = 1; level < bits; ++level) {
    const std::uint32_t bit = std::uint32_t{1} << level;
    const std::uint32_t below = bit - 1;
    for (int i = dimensions - 1; i >= 0; --i) {
      std::uint32_t& other = cell[static_cast<std::size_t>(i)];
      if (other & bit) {
        cell[0] ^= below;  // mirror
      } else {
        const std::uint32_t differ = (cell[0] ^ other) & below;  // swap
        cell[0] ^= differ;
        other ^= differ;
      }
    }
  }
  return cell;
}

/// The place of a cell: the inverse of hilbert_cell().
constexpr std::uint32_t hilbert_place(CurveCell cell, int dimensions) {
  const int bits = curve_bits(dimensions);
  if (dimensions == 1) return cell[0];
  for (int level = bits - 1; level >= 1; --level) {
    const std::uint32_t bit = std::uint32_t{1} << level;
    const std::uint32_t below = bit - 1;
    for (int i = 0; i < dimensions; ++i) {
      std::uint32_t& other = cell[static_cast<std::size_t>(i)];
      if (other & bit) {
        cell[0] ^= below;
      } else {
        const std::uint32_t differ = (cell[0] ^ other) & below;
        cell[0] ^= differ;
        other ^= differ;
      }
    }
  }
  std::uint32_t gray = 0;
  for (int bit = 0; bit < bits * dimensions; ++bit) {
    const int coordinate = dimensions - 1 - bit % dimensions;
    gray |= (cell[static_cast<std::size_t>(coordinate)] >> (bit / dimensions) & 1u) << bit;
  }
  std::uint32_t place = gray;
  for (int shift = 1; shift < 32; shift *= 2) place ^= place >> shift;
  return place;
}

}  // namespace bn
