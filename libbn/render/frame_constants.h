// What a frame is rendered with, in the layout of shaders/frame.glsl.
#pragma once

#include <cstdint>

#include "render/shader_math.h"

namespace bn::render {

struct FrameConstants {
  vec4 eye, forward, right, down;
  vec4 previous_eye, previous_forward, previous_right, previous_down;
  vec4 sky;
  float pixel_size2;
  std::int32_t level_shift;
  std::uint32_t rotation;
  std::uint32_t frame_key;
  std::int32_t screen_width, screen_height, seed_pitch;
  std::int32_t primitive_count, material_count, light_count;
  std::int32_t bounces, sampling;
  std::int32_t tile_width, tile_height, shift_x, shift_y;
  std::int32_t sort_by_light;
  std::int32_t first_level;  // of this frame's mask in level[]
  std::int32_t paths;
  std::int32_t unused;  // to a whole number of vec4
};
static_assert(sizeof(FrameConstants) == 9 * 16 + 20 * 4);

}  // namespace bn::render
