// bn_dither.glsl - which texel of a tile a pixel reads. Paste into your engine.
//
// Frame t dithers pixel p with mask texel p + t * d, wrapped: shift = (t * d) mod tile, made once a
// frame on the host, each component in 0..tile-1. d is the step that the retarget tile was baked for; the
// tile's file names it (`bn info`), the mask's does not. Use it as it is: an integer vector, never a real
// one truncated each frame. Without a retarget tile choose any step of long orbit, (48, 37) on 64 x 64.
//
// bn_quantise.glsl has the dither itself.

#ifndef BN_DITHER_GLSL
#define BN_DITHER_GLSL

// The texel for `pixel`, (pixel + shift) mod tile. Coordinates 0..131071. By one division of floats,
// which every device does faster than integers: the half keeps the quotient further from a whole
// number than any rounding reaches.
ivec2 bn_texel(ivec2 pixel, ivec2 shift, ivec2 tile) {
  ivec2 at = pixel + shift;
  return at - tile * ivec2((vec2(at) + 0.5) / vec2(tile));
}

// A mask sample of 8 bits as a number in the middle of its level, for dithering: never 0, never 1.
float bn_level(uint sample8) { return (float(sample8) + 0.5) / 256.0; }

#endif
