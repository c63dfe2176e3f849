// bn_dither.hlsl - which texel of a tile a pixel reads. Paste into your engine. See bn_dither.glsl,
// and bn_quantise.hlsl for the dither itself.

#ifndef BN_DITHER_HLSL
#define BN_DITHER_HLSL

// (pixel + shift) mod tile for coordinates 0..131071; shift = (t * d) mod tile, made on the host.
int2 bn_texel(int2 pixel, int2 shift, int2 tile) {
  int2 at = pixel + shift;
  return at - tile * int2((float2(at) + 0.5) / float2(tile));
}

// A mask sample of 8 bits as a number in the middle of its level: never 0, never 1.
float bn_level(uint sample8) { return (float(sample8) + 0.5) / 256.0; }

#endif
