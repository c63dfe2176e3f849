// bn_sort.glsl - order the seeds of a block of pixels like the mask. Paste into your engine.
//
// In each block the seed of the k-th darkest pixel goes to the pixel with the k-th lowest mask level.
// One invocation sorts one block, in registers, by a network without branches or barriers: Batcher's
// odd-even merge sort (K. E. Batcher, "Sorting networks and their applications", AFIPS 1968). Both
// orders are sorted at once, as the two components of a key. All indices are constants after unrolling.
//
// A key is a quantity above and the pixel's index in the block in the low 8 bits, so all keys differ
// and the order is the same on every device. Luminance is compared by its exponent and 16 fraction
// bits. Pixels outside the screen keep their seeds.
//
// Define first: BN_BLOCK, 2, 4, 8 or 16, and the accesses
//   float BN_LOAD_LUMINANCE(ivec2 pixel)     uint BN_LOAD_SEED(ivec2 pixel)
//   uint  BN_LOAD_LEVEL(ivec2 texel)         void BN_STORE_SEED(ivec2 pixel, uint seed)
// Needs: #extension GL_EXT_control_flow_attributes

#ifndef BN_SORT_GLSL
#define BN_SORT_GLSL

#include "bn_dither.glsl"

const uint bn_pixels = uint(BN_BLOCK * BN_BLOCK);

uvec2 bn_key[bn_pixels];  // x orders by luminance, y by mask level

uint bn_luminance_key(float luminance, uint index) {
  uint bits = floatBitsToUint(luminance);
  if (bits > 0x7F800000u) bits = 0u;  // negative or NaN
  return ((bits << 1) & ~255u) | index;
}

// One step of the network: within groups of 2 * `group` keys, compares those `reach` apart.
void bn_compare(uint group, uint reach) {
  [[unroll]] for (uint i = 0u; i < bn_pixels - reach; ++i) {
    bool lower = i >= reach % group && (i - reach % group) % (2u * reach) < reach;
    if (lower && i / (2u * group) == (i + reach) / (2u * group)) {
      uvec2 a = bn_key[i];
      uvec2 b = bn_key[i + reach];
      bn_key[i] = min(a, b);
      bn_key[i + reach] = max(a, b);
    }
  }
}

void bn_sort_keys() {
  bn_compare(1u, 1u);
  bn_compare(2u, 2u); bn_compare(2u, 1u);
#if BN_BLOCK > 2
  bn_compare(4u, 4u); bn_compare(4u, 2u); bn_compare(4u, 1u);
  bn_compare(8u, 8u); bn_compare(8u, 4u); bn_compare(8u, 2u); bn_compare(8u, 1u);
#endif
#if BN_BLOCK > 4
  bn_compare(16u, 16u); bn_compare(16u, 8u); bn_compare(16u, 4u); bn_compare(16u, 2u); bn_compare(16u, 1u);
  bn_compare(32u, 32u); bn_compare(32u, 16u); bn_compare(32u, 8u); bn_compare(32u, 4u); bn_compare(32u, 2u);
  bn_compare(32u, 1u);
#endif
#if BN_BLOCK > 8
  bn_compare(64u, 64u); bn_compare(64u, 32u); bn_compare(64u, 16u); bn_compare(64u, 8u); bn_compare(64u, 4u);
  bn_compare(64u, 2u); bn_compare(64u, 1u);
  bn_compare(128u, 128u); bn_compare(128u, 64u); bn_compare(128u, 32u); bn_compare(128u, 16u);
  bn_compare(128u, 8u); bn_compare(128u, 4u); bn_compare(128u, 2u); bn_compare(128u, 1u);
#endif
}

// Sorts the block whose top left pixel is `corner`; parts of it may lie outside the screen.
void bn_sort_block(ivec2 corner, ivec2 screen, ivec2 shift, ivec2 tile) {
  [[unroll]] for (uint i = 0u; i < bn_pixels; ++i) {
    ivec2 pixel = corner + ivec2(i % uint(BN_BLOCK), i / uint(BN_BLOCK));
    bool inside = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, screen));
    bn_key[i] = uvec2(0xFFFFFF00u | i);
    if (inside) {
      bn_key[i].x = bn_luminance_key(BN_LOAD_LUMINANCE(pixel), i);
      bn_key[i].y = (BN_LOAD_LEVEL(bn_texel(pixel, shift, tile)) << 8) | i;
    }
  }
  bn_sort_keys();
  // All seeds are read before the first is written.
  uint seed[bn_pixels];
  [[unroll]] for (uint k = 0u; k < bn_pixels; ++k) {
    uint i = bn_key[k].x & 255u;
    bool inside = bn_key[k].x < 0xFFFFFF00u;
    seed[k] = inside ? BN_LOAD_SEED(corner + ivec2(i % uint(BN_BLOCK), i / uint(BN_BLOCK))) : 0u;
  }
  [[unroll]] for (uint k = 0u; k < bn_pixels; ++k) {
    uint i = bn_key[k].y & 255u;
    if (bn_key[k].y < 0xFFFFFF00u) BN_STORE_SEED(corner + ivec2(i % uint(BN_BLOCK), i / uint(BN_BLOCK)), seed[k]);
  }
}

#endif
