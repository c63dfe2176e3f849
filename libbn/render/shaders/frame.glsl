// The constants of one frame, member by member FrameConstants of frame_constants.h.
layout(std430, binding = 0) readonly buffer Frame {
  vec4 eye, forward, right, down;
  vec4 previous_eye, previous_forward, previous_right, previous_down;
  vec4 sky;
  float pixel_size2;     // |right|^2 = |down|^2
  int level_shift;       // 23 - bits of the mask's levels
  uint rotation;         // of a mask animated by the golden ratio, in 2^-24
  uint frame_key;
  int screen_width, screen_height, seed_pitch;
  int primitive_count, material_count, light_count;
  int bounces, sampling;
  int tile_width, tile_height, shift_x, shift_y;
  int sort_by_light;
  int first_level;       // of this frame's mask in level[]
  int paths;
};
