// bn_quantise.glsl - the dither itself: from a real value to one of few codes. Paste into your engine.
//
// All functions return code / steps, a value that the target stores exactly: steps is 255 for 8 bits,
// 1023 for 10, 1 for black and white. `noise` is above 0 and below 1 and evenly distributed: bn_level()
// of a mask's 8-bit sample (bn_dither.glsl), or a float mask as it is, or a mask of 4 bits or more made
// likewise. The texture unit's k / 255 reaches 1, which is one code too much. Give each colour channel
// noise of its own, from one channel of an RGBA mask or from the same mask read elsewhere.
//
//   bn_dither(value, steps, noise)                  the target is linear
//   bn_dither_srgb(light, steps, noise)             the target's codes are sRGB; `light` is linear
//   bn_dither_triangular(value, steps, noise)       the same with triangular noise
//   bn_dither_srgb_triangular(light, steps, noise)
//
// Write the result of the sRGB ones to a UNORM target as it is. An _SRGB target encodes once more: there
// write bn_linear_from_srgb() of it, which the hardware takes back to the same code.
//
// In the mean over the noise each of them shows exactly the value asked for, also in the dark and at both
// ends. Even noise is never off by a whole step between codes, triangular noise by one and a half at most.
//
// Even noise. Let A <= v <= B be the wanted value and the light that its two neighbouring codes show. The upper
// code with probability p = (v - A) / (B - A) gives the mean A + p (B - A) = v. For a linear target that is
// floor(v * steps + noise). For an sRGB target A and B are the codes' light, not the codes: adding even noise to
// the encoded value and rounding weights by codes, and is too bright wherever the curve bends; adding 1/255 of
// linear light before the encoding is thirteen codes in the dark.
//
// Triangular noise. The error of an even dither depends on the value: none on a code, most half-way, so grain
// comes and goes along a ramp. The usual remedy is noise of triangular density, two codes wide, before
// rounding: the sum of two even noises. Here it is one even dither of a value that jitters evenly by w to and
// fro: the jitter's mean is 0, so the dither's is v as before, and with w of one code it is the usual one.
// Of three codes that show A < M < B, with v between the midpoints (A + M) / 2 and (M + B) / 2,
//
//   lower: (M - v + w/2)^2 / (2 w (M - A))     upper: (v - M + w/2)^2 / (2 w (B - M))     middle: the rest
//
// w goes linearly from M - A to B - M between the midpoints, which keeps the jitter inside A..B and makes
// the probabilities continuous there. One noise value decides, in the order of the codes, so blue noise stays
// blue. In the lowest and the highest half code only two codes are left, and the dither is the even one. (Noise
// that is rounded and cut off there instead makes black grey.)
//
// The same text is GLSL, HLSL and C++ (a test compiles it so).

#ifndef BN_QUANTISE_GLSL
#define BN_QUANTISE_GLSL

// IEC 61966-2-1.
float bn_srgb_from_linear(float light) {
  return light <= 0.0031308f ? 12.92f * light : 1.055f * pow(light, 1.0f / 2.4f) - 0.055f;
}

float bn_linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : pow((encoded + 0.055f) / 1.055f, 2.4f);
}

// Not a number becomes 0.
float bn_0_to_1(float value) { return value > 0.0f ? min(value, 1.0f) : 0.0f; }

// 0 for the code that shows `below`, 1 for the one that shows `above`.
float bn_pick(float below, float above, float value, float noise) {
  return noise >= 1.0f - (value - below) / (above - below) ? 1.0f : 0.0f;
}

// -1, 0 or 1 for the codes that show `below`, `middle` and `above`.
float bn_pick_triangular(float below, float middle, float above, float value, float noise) {
  float left = middle - below;
  float right = above - middle;
  float share = (value - middle + 0.5f * left) / (0.5f * (left + right));
  float width = left + share * (right - left);
  float down = middle - value + 0.5f * width;
  float up = value - middle + 0.5f * width;
  if (noise < down * down / (2.0f * width * left)) return -1.0f;
  return noise >= 1.0f - up * up / (2.0f * width * right) ? 1.0f : 0.0f;
}

float bn_dither(float value, float steps, float noise) {
  float at = bn_0_to_1(value) * steps;
  float low = min(floor(at), steps - 1.0f);
  return (low + bn_pick(low, low + 1.0f, at, noise)) / steps;
}

float bn_dither_triangular(float value, float steps, float noise) {
  float at = bn_0_to_1(value) * steps;
  float middle = floor(at + 0.5f);
  if (middle < 0.5f || middle > steps - 0.5f) return bn_dither(value, steps, noise);
  return (middle + bn_pick_triangular(middle - 1.0f, middle, middle + 1.0f, at, noise)) / steps;
}

float bn_dither_srgb(float light, float steps, float noise) {
  float value = bn_0_to_1(light);
  float low = min(floor(bn_srgb_from_linear(value) * steps), steps - 1.0f);
  float below = bn_linear_from_srgb(low / steps);
  float above = bn_linear_from_srgb((low + 1.0f) / steps);
  return (low + bn_pick(below, above, value, noise)) / steps;
}

float bn_dither_srgb_triangular(float light, float steps, float noise) {
  float value = bn_0_to_1(light);
  float low = min(floor(bn_srgb_from_linear(value) * steps), steps - 1.0f);
  float below = bn_linear_from_srgb(low / steps);
  float above = bn_linear_from_srgb((low + 1.0f) / steps);
  float middle = value < 0.5f * (below + above) ? low : low + 1.0f;
  if (middle < 0.5f || middle > steps - 0.5f) return (low + bn_pick(below, above, value, noise)) / steps;
  float pick = middle > low
                   ? bn_pick_triangular(below, above, bn_linear_from_srgb((low + 2.0f) / steps), value, noise)
                   : bn_pick_triangular(bn_linear_from_srgb((low - 1.0f) / steps), below, above, value, noise);
  return (middle + pick) / steps;
}

#endif
