// Compiled when libbn is built, and never run: the HLSL that users paste must be HLSL.
RWStructuredBuffer<uint> seeds : register(u0);
RWStructuredBuffer<uint> moved : register(u1);
StructuredBuffer<float> luminance : register(t2);
StructuredBuffer<uint> level : register(t3);
StructuredBuffer<int2> moves : register(t4);
RWStructuredBuffer<float4> shown : register(u5);

static const int2 size = int2(640, 384);
static const int2 tile = int2(64, 64);

#define BN_BLOCK 8
#define BN_LOAD_LUMINANCE(p) luminance[(p).y * size.x + (p).x]
#define BN_LOAD_LEVEL(t) level[(t).y * tile.x + (t).x]
#define BN_LOAD_SEED(p) seeds[(p).y * size.x + (p).x]
#define BN_STORE_SEED(p, seed) seeds[(p).y * size.x + (p).x] = seed
#define BN_LOAD_MOVE(t) moves[(t).y * tile.x + (t).x]
#include "bn_sort.hlsl"
#include "bn_retarget.hlsl"
#include "bn_quantise.hlsl"

[numthreads(8, 8, 1)] void main(uint3 id : SV_DispatchThreadID) {
  bn_sort_block(int2(id.xy) * BN_BLOCK, size, int2(3, 5), tile);
  int2 to = bn_retarget(int2(id.xy), int2(3, 5), tile, size);
  moved[to.y * size.x + to.x] = seeds[id.y * size.x + id.x];

  uint at = id.y * size.x + id.x;
  float noise = bn_level(BN_LOAD_LEVEL(bn_texel(int2(id.xy), int2(3, 5), tile)));
  shown[at] = float4(bn_dither(luminance[at], 255.0f, noise), bn_dither_triangular(luminance[at], 255.0f, noise),
                     bn_dither_srgb(luminance[at], 255.0f, noise),
                     bn_linear_from_srgb(bn_dither_srgb_triangular(luminance[at], 255.0f, noise)));
}
