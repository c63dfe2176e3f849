#version 450
// example.comp - a whole compute shader: the end of a frame. It runs as it is (a test runs it).
//
// One invocation a pixel of the seed image. It moves the pixel's seed to where the next frame needs it, and
// writes the pixel's colour, dithered to 8 bits of sRGB. docs/engines.md says where in the frame this stands.
//
//   glslc --target-env=vulkan1.2 -Itextures/shaders textures/shaders/example.comp -o example.spv
//   glslc ... -DBN_EXAMPLE_IMAGES                  the same with textures and storage images

#extension GL_GOOGLE_include_directive : require
#ifdef BN_EXAMPLE_IMAGES
#extension GL_EXT_samplerless_texture_functions : require
#endif
#include "bn_dither.glsl"
#include "bn_quantise.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform Frame {
  ivec2 screen;  // pixels shown
  ivec2 size;    // of the seed image: the screen padded up to multiples of the tile
  ivec2 tile;    // of mask and retarget tile, 64 x 64
  ivec2 shift;   // (t * d) mod tile of frame t
};

#ifdef BN_EXAMPLE_IMAGES
// Textures of format R8_UNORM and RG8_UNORM, never _SRGB. texelFetch needs no sampler state, so no filter and no
// mip-map can get between. RGB files loaded as RGBA8_UNORM do as well.
layout(binding = 0, rgba16f) uniform readonly image2D light;
layout(binding = 1) uniform texture2D mask;
layout(binding = 2) uniform texture2D retarget;
layout(binding = 3, r32ui) uniform readonly uimage2D seeds;
layout(binding = 4, r32ui) uniform writeonly uimage2D next_seeds;
layout(binding = 5, rgba8) uniform writeonly image2D target;  // a UNORM image shown as sRGB

vec3 load_light(ivec2 p) { return imageLoad(light, p).rgb; }
uint load_level(ivec2 u) { return uint(texelFetch(mask, u, 0).r * 255.0 + 0.5); }
ivec2 load_move(ivec2 u) { return ivec2(texelFetch(retarget, u, 0).rg * 255.0 + 0.5) - 128; }
uint load_seed(ivec2 p) { return imageLoad(seeds, p).r; }
void store_seed(ivec2 p, uint seed) { imageStore(next_seeds, p, uvec4(seed)); }
void store_colour(ivec2 p, vec3 encoded) { imageStore(target, p, vec4(encoded, 1.0)); }
#else
// Buffers of the same contents, row by row.
layout(std430, binding = 0) readonly buffer Light { vec4 light[]; };
layout(std430, binding = 1) readonly buffer Mask { uint mask[]; };       // 0..255
layout(std430, binding = 2) readonly buffer Retarget { ivec2 moves[]; };  // red - 128, green - 128
layout(std430, binding = 3) readonly buffer Seeds { uint seeds[]; };
layout(std430, binding = 4) writeonly buffer NextSeeds { uint next_seeds[]; };
layout(std430, binding = 5) writeonly buffer Target { uint target[]; };  // red in the lowest byte

vec3 load_light(ivec2 p) { return light[p.y * screen.x + p.x].rgb; }
uint load_level(ivec2 u) { return mask[u.y * tile.x + u.x]; }
ivec2 load_move(ivec2 u) { return moves[u.y * tile.x + u.x]; }
uint load_seed(ivec2 p) { return seeds[p.y * size.x + p.x]; }
void store_seed(ivec2 p, uint seed) { next_seeds[p.y * size.x + p.x] = seed; }
void store_colour(ivec2 p, vec3 encoded) { target[p.y * screen.x + p.x] = packUnorm4x8(vec4(encoded, 1.0)); }
#endif

#define BN_LOAD_MOVE(u) load_move(u)
#include "bn_retarget.glsl"

// Noise for one colour channel. The channels read one mask at places far from each other.
float noise_of(ivec2 pixel, int channel) {
  ivec2 apart = channel * (tile / 3 + 1);
  return bn_level(load_level(bn_texel(pixel + apart, shift, tile)));
}

void main() {
  int index = int(gl_GlobalInvocationID.x);
  if (index >= size.x * size.y) return;
  ivec2 pixel = ivec2(index % size.x, index / size.x);

  store_seed(bn_retarget(pixel, shift, tile, size), load_seed(pixel));

  if (pixel.x >= screen.x || pixel.y >= screen.y) return;
  vec3 colour = load_light(pixel);
  store_colour(pixel, vec3(bn_dither_srgb_triangular(colour.r, 255.0, noise_of(pixel, 0)),
                           bn_dither_srgb_triangular(colour.g, 255.0, noise_of(pixel, 1)),
                           bn_dither_srgb_triangular(colour.b, 255.0, noise_of(pixel, 2))));
}
