// Motion choice, second half: the mean over the known pixels, rounded half up, clamped to the tiles at
// hand. 64-bit integers: exact for any screen. One invocation; a thousand additions take microseconds.
#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

layout(local_size_x = 1) in;

layout(std430, binding = 0) readonly buffer Sums { ivec4 sums[1024]; };
layout(std430, binding = 1) writeonly buffer Chosen { ivec2 motion; };

layout(push_constant) uniform Push { int motion_range; };

int rounded_mean(int64_t sum, int64_t count) {
  const int64_t unit = 256;  // motion counts 1/256 pixel
  if (count == 0) return 0;
  int64_t a = 2 * sum + unit * count;
  int64_t b = 2 * unit * count;
  // Floor division; GLSL leaves % of negative numbers undefined, and / truncates.
  int64_t mean = a >= 0 ? a / b : -((b - 1 - a) / b);
  return int(clamp(mean, int64_t(-motion_range), int64_t(motion_range)));
}

void main() {
  int64_t x = 0;
  int64_t y = 0;
  int64_t count = 0;
  for (int i = 0; i < 1024; ++i) {
    x += sums[i].x;
    y += sums[i].y;
    count += sums[i].z;
  }
  motion = ivec2(rounded_mean(x, count), rounded_mean(y, count));
}
