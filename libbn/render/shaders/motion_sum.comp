// Motion choice, first half: 1024 partial sums of the pixels' motion, in integers. Invocation i takes
// pixels i, i + 1024, ...; up to 2^26 pixels no 32-bit sum can overflow.
#version 460

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Motion { uint motion[]; };  // two 16-bit signed numbers
layout(std430, binding = 1) writeonly buffer Sums { ivec4 sums[]; };    // x, y, count, 0

layout(push_constant) uniform Push { int pixels; };

void main() {
  int lane = int(gl_GlobalInvocationID.x);
  ivec4 sum = ivec4(0);
  for (int i = lane; i < pixels; i += 1024) {
    int packed = int(motion[i]);
    ivec2 moved = ivec2(bitfieldExtract(packed, 0, 16), bitfieldExtract(packed, 16, 16));
    if (moved.x != -32768) sum += ivec4(moved, 1, 0);
  }
  sums[lane] = sum;
}
