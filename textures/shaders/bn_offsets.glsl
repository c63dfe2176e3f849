// bn_offsets.glsl - one mask in many frames and with an importance map. Paste into your engine; HLSL takes the same
// text. libbn's bn/offsets.h has the same functions, bit by bit, and says more.
//
//   value of pixel p in frame t:  bn_rotated(mask at p, bn_golden_offset(t))
//   a second number a pixel:      bn_rotated(mask at p, bn_r2_offset_y(t))
//   slices again and again:       slice t % depth, at column bn_shifted(p.x, bn_r2_offset_x(t / depth), width) and row
//                                 bn_shifted(p.y, bn_r2_offset_y(t / depth), height)
//   sample where it matters:      bn_is_sampled(mask at p, share of frames in which p is to be sampled)

// Offsets are fractions of 1 in units of 2^-32: multiples of 1 / phi, sqrt(2), 1 / g and 1 / g^2, modulo 1.
uint bn_golden_offset(uint i) { return i * 2654435769u; }
uint bn_sqrt2_offset(uint i) { return i * 1779033703u; }
uint bn_r2_offset_x(uint i) { return i * 3242174889u; }
uint bn_r2_offset_y(uint i) { return i * 2447445413u; }

// A value in [0, 1) moved on by an offset, around to 0 at 1. For values of 8 bit take (sample * 255 + 0.5) / 256.
float bn_rotated(float value, uint offset) {
  float sum = value + float(offset >> 8u) * (1.0f / 16777216.0f);
  return sum < 1.0f ? sum : sum - 1.0f;
}

// The pixels that an offset comes to on a side of 1..65535 pixels, and a coordinate moved by them around the torus.
uint bn_pixels(uint offset, uint side) { return ((offset >> 16u) * side) >> 16u; }
uint bn_shifted(uint at, uint offset, uint side) { return (at + bn_pixels(offset, side)) % side; }

bool bn_is_sampled(float value, float importance) { return value < importance; }
