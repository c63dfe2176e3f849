// G-buffer pass: one invocation a pixel.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "frame.glsl"
layout(std430, binding = 1) readonly buffer Scene { vec4 scene[]; };
layout(std430, binding = 2) writeonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 3) writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 4) writeonly buffer Albedos { vec4 albedos[]; };
layout(std430, binding = 5) writeonly buffer Motion { uint motion[]; };

// No random numbers here; the shared text wants the names.
uint stream = 0u;
uint dimension = 0u;
float bn_sample(uint seed, uint number) { return 0.0; }
vec3 xyz(vec4 v) { return v.xyz; }
#include "trace.glsl"
#include "gbuffer.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= screen_width || pixel.y >= screen_height) return;
  int index = pixel.y * screen_width + pixel.x;
  Seen seen = see(pixel.x, pixel.y);
  positions[index] = seen.position;
  normals[index] = seen.normal;
  albedos[index] = seen.albedo;
  motion[index] = (uint(seen.motion_x) & 0xFFFFu) | uint(seen.motion_y) << 16;
}
