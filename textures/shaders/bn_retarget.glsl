// bn_retarget.glsl - carry sorted seeds on to the next frame's mask. Paste into your engine.
//
// At the end of frame t the seed at p moves to bn_retarget(p, ...), a bijection of the seed image:
//
//   seeds_next[bn_retarget(p, shift, tile, size)] = seeds[p];     for every p of the seed image
//
// The seed image is the screen padded up to multiples of the tile, and wraps there.
// When the camera moves, take the tile for the screen's mean motion, rounded, clamped to -4..4: tile
// (m.x + 4, m.y + 4) of the atlas.
//
// Define first: ivec2 BN_LOAD_MOVE(ivec2 texel), the stored move: 8-bit red - 128, green - 128.

#ifndef BN_RETARGET_GLSL
#define BN_RETARGET_GLSL

#include "bn_dither.glsl"

ivec2 bn_retarget(ivec2 pixel, ivec2 shift, ivec2 tile, ivec2 size) {
  ivec2 to = pixel + BN_LOAD_MOVE(bn_texel(pixel, shift, tile));
  // Moves are shorter than the seed image.
  return to + size * (ivec2(lessThan(to, ivec2(0))) - ivec2(greaterThanEqual(to, size)));
}

#endif
