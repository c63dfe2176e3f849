// Tone map and write: x / (1 + x), a square root for the display's curve, 8 bits.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 1) writeonly buffer Pixels { uint pixels[]; };
layout(push_constant) uniform Push { int count; };

#include "tone_map.glsl"

void main() {
  int index = int(gl_GlobalInvocationID.x);
  if (index >= count) return;
  vec4 colour = colours[index];
  pixels[index] = display_byte(colour.x) | display_byte(colour.y) << 8 | display_byte(colour.z) << 16 | 0xFF000000u;
}
