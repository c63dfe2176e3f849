// The random numbers of a pixel. Shared by GLSL and C++ like trace.glsl; equal to sample() of
// bn/render.h where the seed decides.
//
// sampling == 0: the seed alone decides (the temporal algorithm; white noise draws a new frame_key each frame).
// sampling == 1: a mask decides. Every pixel takes the same random point, rotated (Cranley and Patterson
// 1976) by the mask's level, each dimension with its own offset into the tile (Georgiev and Fajardo 2016).

uint bn_hash(uint value) {
  uint state = value * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

// 24 random bits.
uint bn_bits(uint seed, uint number) { return bn_hash(bn_hash(seed) + number * 0x9E3779B9u) >> 8; }

// In [0, 1), a multiple of 2^-24. Turning a point is adding integers modulo 2^24: exact.
float bn_sample(uint seed, uint number) {
  uint bits = 0u;
  if (sampling == 0) {
    bits = bn_bits(seed, number);
  } else {
    int x = (pixel_x + shift_x + int((number * 3242174889u) >> 16)) % tile_width;
    int y = (pixel_y + shift_y + int((number * 2447445414u) >> 16)) % tile_height;
    uint middle = (uint(level[first_level + y * tile_width + x]) * 2u + 1u) << level_shift;
    bits = (bn_bits(frame_key, number) + middle + rotation) & 0xFFFFFFu;
  }
  return float(bits) * 0.000000059604644775390625f;
}
