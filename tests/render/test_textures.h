// Textures for the tests, baked once a process.
#pragma once

#include "bn/noise.h"
#include "bn/render.h"
#include "bn/retarget.h"

namespace bn::test {

/// Near (n/g, n/g^2) for n = 64, both odd: an orbit of 64 frames.
inline constexpr Offset kStep{49, 37};

inline Grid<std::int32_t> eight_bit_levels(const Grid<std::uint32_t>& rank) {
  Grid<std::int32_t> levels(rank.size());
  for (std::size_t i = 0; i < rank.count(); ++i) {
    levels[i] = static_cast<std::int32_t>(rank[i] * std::uint64_t{256} / rank.count());
  }
  return levels;
}

inline const Grid<std::int32_t>& mask_64() {
  static const Grid<std::int32_t> mask = eight_bit_levels(void_and_cluster({.size = {64, 64}}));
  return mask;
}

/// Mask and proven plain tile.
inline const TemporalTextures& proven_textures() {
  static const TemporalTextures textures{
      .masks = {mask_64()}, .step = kStep, .moves = {solve_retarget(mask_64(), {.step = kStep}).move}};
  return textures;
}

}  // namespace bn::test
