// Path tracing pass: one invocation a pixel, one path.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "frame.glsl"
layout(std430, binding = 1) readonly buffer Scene { vec4 scene[]; };
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 3) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 4) readonly buffer Albedos { vec4 albedos[]; };
layout(std430, binding = 5) readonly buffer Seeds { uint seeds[]; };
layout(std430, binding = 6) readonly buffer Mask { uint level[]; };
layout(std430, binding = 7) writeonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 8) writeonly buffer Luminance { float luminance[]; };

uint stream;
uint dimension;
int pixel_x;
int pixel_y;
vec3 xyz(vec4 v) { return v.xyz; }
#include "sampling.glsl"
#include "trace.glsl"
#include "gbuffer.glsl"

void main() {
  pixel_x = int(gl_GlobalInvocationID.x);
  pixel_y = int(gl_GlobalInvocationID.y);
  if (pixel_x >= screen_width || pixel_y >= screen_height) return;
  int index = pixel_y * screen_width + pixel_x;
  uint seed = seeds[pixel_y * seed_pitch + pixel_x] ^ (sampling == 0 ? frame_key : 0u);
  Seen seen;
  seen.position = positions[index];
  seen.normal = normals[index];
  seen.albedo = albedos[index];
  vec3 colour = render_paths(seen, seed);
  colours[index] = vec4(colour, 1.0);
  luminance[index] = sort_luminance(seen, colour);
}
