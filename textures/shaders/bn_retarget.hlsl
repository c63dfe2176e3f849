// bn_retarget.hlsl - carry sorted seeds on to the next frame's mask. Paste into your engine.
// See bn_retarget.glsl:
//
//   seeds_next[bn_retarget(p, shift, tile, size)] = seeds[p];     for every p of the seed image
//
// Define first: int2 BN_LOAD_MOVE(int2 texel), the stored move: 8-bit red - 128, green - 128.

#ifndef BN_RETARGET_HLSL
#define BN_RETARGET_HLSL

#include "bn_dither.hlsl"

int2 bn_retarget(int2 pixel, int2 shift, int2 tile, int2 size) {
  int2 to = pixel + BN_LOAD_MOVE(bn_texel(pixel, shift, tile));
  // Moves are shorter than the seed image.
  return to + size * (int2(to < 0) - int2(to >= size));
}

#endif
