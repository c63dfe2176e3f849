// Retarget pass: one invocation a seed, with the tile for the motion that motion_choose.comp found.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;  // along a row; y is the row

layout(std430, binding = 0) readonly buffer Moves { uint moves[]; };  // two 16-bit signed numbers
layout(std430, binding = 1) readonly buffer Chosen { ivec2 motion; };
layout(std430, binding = 2) readonly buffer Seeds { uint seeds[]; };
layout(std430, binding = 3) writeonly buffer Moved { uint moved[]; };

layout(push_constant) uniform Push {
  ivec2 size;   // of the padded seed image
  ivec2 tile;
  ivec2 shift;
  int motion_range;
  int mask;     // of the frame that the seeds come from
};

ivec2 load_move(ivec2 texel) {
  int side = 2 * motion_range + 1;
  int variant = (mask * side + motion.y + motion_range) * side + motion.x + motion_range;
  int packed = int(moves[(variant * tile.y + texel.y) * tile.x + texel.x]);
  return ivec2(bitfieldExtract(packed, 0, 16), bitfieldExtract(packed, 16, 16));
}

#define BN_LOAD_MOVE(texel) load_move(texel)
#include "bn_retarget.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= size.x) return;
  ivec2 to = bn_retarget(pixel, shift, tile, size);
  moved[to.y * size.x + to.x] = seeds[pixel.y * size.x + pixel.x];
}
