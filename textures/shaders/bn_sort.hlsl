// bn_sort.hlsl - order the seeds of a block of pixels like the mask. Paste into your engine.
//
// In each block the seed of the k-th darkest pixel goes to the pixel with the k-th lowest mask level.
// One invocation sorts one block, in registers, by a network without branches or barriers: Batcher's
// bitonic sort (K. E. Batcher, "Sorting networks and their applications", AFIPS 1968), every
// comparison upwards. Both orders are sorted at once, as the two components of a
// key. All indices into arrays are constants.
//
// A key is a quantity above and the pixel's index in the block in the low 8 bits, so all keys differ
// and the order is the same on every device. Luminance is compared by its exponent and 16 fraction
// bits. Pixels outside the screen keep their seeds.
//
// Define first: BN_BLOCK, 2, 4, 8 or 16, and the accesses
//   float BN_LOAD_LUMINANCE(int2 pixel)     uint BN_LOAD_SEED(int2 pixel)
//   uint  BN_LOAD_LEVEL(int2 texel)         void BN_STORE_SEED(int2 pixel, uint seed)

#ifndef BN_SORT_HLSL
#define BN_SORT_HLSL

#include "bn_dither.hlsl"

static const uint bn_pixels = uint(BN_BLOCK * BN_BLOCK);

static uint2 bn_key[bn_pixels];  // x orders by luminance, y by mask level

uint bn_luminance_key(float luminance, uint index) {
  uint bits = asuint(luminance);
  if (bits > 0x7F800000u) bits = 0u;  // negative or NaN
  return ((bits << 1) & ~255u) | index;
}

// The network is written out by the preprocessor: as loops it would cost compilers half a minute at
// 16 x 16. BN_PAIRS(step, size) makes step(t, size) for every pair t of the block.
#define BN_2(step, t, size) step((t), size) step((t + 1u), size)
#define BN_8(step, t, size) BN_2(step, t, size) BN_2(step, t + 2u, size) BN_2(step, t + 4u, size) BN_2(step, t + 6u, size)
#define BN_32(step, t, size) BN_8(step, t, size) BN_8(step, t + 8u, size) BN_8(step, t + 16u, size) BN_8(step, t + 24u, size)
#if BN_BLOCK == 2
#define BN_PAIRS(step, size) BN_2(step, 0u, size)
#elif BN_BLOCK == 4
#define BN_PAIRS(step, size) BN_8(step, 0u, size)
#elif BN_BLOCK == 8
#define BN_PAIRS(step, size) BN_32(step, 0u, size)
#else
#define BN_PAIRS(step, size) BN_32(step, 0u, size) BN_32(step, 32u, size) BN_32(step, 64u, size) BN_32(step, 96u, size)
#endif

#define BN_ORDER(i, j) { uint2 a = bn_key[i]; uint2 b = bn_key[j]; bn_key[i] = min(a, b); bn_key[j] = max(a, b); }
// Two sorted runs of `run` keys: first against last, second against last but one, ...
#define BN_FOLD_PAIR(t, run) BN_ORDER(2u * t - t % run, 2u * t - 2u * (t % run) + 2u * run - 1u - t % run)
// Then within halves, quarters, ...
#define BN_HALVE_PAIR(t, reach) BN_ORDER(2u * t - t % reach, 2u * t - t % reach + reach)
#define BN_FOLD(run) BN_PAIRS(BN_FOLD_PAIR, run)
#define BN_HALVE(reach) BN_PAIRS(BN_HALVE_PAIR, reach)

void bn_sort_keys() {
  BN_FOLD(1u)
  BN_FOLD(2u) BN_HALVE(1u)
#if BN_BLOCK > 2
  BN_FOLD(4u) BN_HALVE(2u) BN_HALVE(1u)
  BN_FOLD(8u) BN_HALVE(4u) BN_HALVE(2u) BN_HALVE(1u)
#endif
#if BN_BLOCK > 4
  BN_FOLD(16u) BN_HALVE(8u) BN_HALVE(4u) BN_HALVE(2u) BN_HALVE(1u)
  BN_FOLD(32u) BN_HALVE(16u) BN_HALVE(8u) BN_HALVE(4u) BN_HALVE(2u) BN_HALVE(1u)
#endif
#if BN_BLOCK > 8
  BN_FOLD(64u) BN_HALVE(32u) BN_HALVE(16u) BN_HALVE(8u) BN_HALVE(4u) BN_HALVE(2u) BN_HALVE(1u)
  BN_FOLD(128u) BN_HALVE(64u) BN_HALVE(32u) BN_HALVE(16u) BN_HALVE(8u) BN_HALVE(4u) BN_HALVE(2u) BN_HALVE(1u)
#endif
}

// Sorts the block whose top left pixel is `corner`; parts of it may lie outside the screen.
void bn_sort_block(int2 corner, int2 screen, int2 shift, int2 tile) {
  [unroll] for (uint i = 0u; i < bn_pixels; ++i) {
    int2 pixel = corner + int2(i % uint(BN_BLOCK), i / uint(BN_BLOCK));
    bool inside = all(pixel >= 0) && all(pixel < screen);
    bn_key[i] = uint2(0xFFFFFF00u | i, 0xFFFFFF00u | i);
    if (inside) {
      bn_key[i].x = bn_luminance_key(BN_LOAD_LUMINANCE(pixel), i);
      bn_key[i].y = (BN_LOAD_LEVEL(bn_texel(pixel, shift, tile)) << 8) | i;
    }
  }
  bn_sort_keys();
  // All seeds are read before the first is written.
  uint seed[bn_pixels];
  [unroll] for (uint k = 0u; k < bn_pixels; ++k) {
    uint i = bn_key[k].x & 255u;
    bool inside = bn_key[k].x < 0xFFFFFF00u;
    seed[k] = inside ? BN_LOAD_SEED(corner + int2(i % uint(BN_BLOCK), i / uint(BN_BLOCK))) : 0u;
  }
  [unroll] for (uint k = 0u; k < bn_pixels; ++k) {
    uint i = bn_key[k].y & 255u;
    if (bn_key[k].y < 0xFFFFFF00u) BN_STORE_SEED(corner + int2(i % uint(BN_BLOCK), i / uint(BN_BLOCK)), seed[k]);
  }
}

#endif
