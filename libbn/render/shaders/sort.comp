// Sort pass: one invocation a block. BN_BLOCK comes from the compiler's command line.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Luminance { float luminance[]; };
layout(std430, binding = 1) readonly buffer Mask { uint level[]; };
layout(std430, binding = 2) buffer Seeds { uint seeds[]; };

layout(push_constant) uniform Push {
  ivec2 screen;
  ivec2 tile;
  ivec2 shift;
  ivec2 origin;     // of the block grid
  int seed_pitch;   // width of the padded seed image
  int columns;      // blocks in a row
  int blocks;
  int mask;         // this frame's
};

#define BN_LOAD_LUMINANCE(p) luminance[(p).y * screen.x + (p).x]
#define BN_LOAD_LEVEL(t) level[(mask * tile.y + (t).y) * tile.x + (t).x]
#define BN_LOAD_SEED(p) seeds[(p).y * seed_pitch + (p).x]
#define BN_STORE_SEED(p, seed) seeds[(p).y * seed_pitch + (p).x] = seed
#include "bn_sort.glsl"

void main() {
  int block = int(gl_GlobalInvocationID.x);
  if (block >= blocks) return;
  ivec2 corner = ivec2(block % columns, block / columns) * BN_BLOCK - origin;
  bn_sort_block(corner, screen, shift, tile);
}
