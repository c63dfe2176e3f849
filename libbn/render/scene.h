// A scene as the shared shader text reads it, and its camera at a frame.
#pragma once

#include <vector>

#include "bn/render.h"
#include "render/frame_constants.h"

namespace bn::render {

/// Throws invalid_input, naming the first thing that is wrong with `scene`.
void check_scene(const Scene& scene);

/// scene[] of shaders/trace.glsl, and its counts.
struct PackedScene {
  std::vector<vec4> words;
  int primitives = 0;
  int materials = 0;
  int lights = 0;
};
PackedScene pack_scene(const Scene& scene);

/// The levels of all masks, one after the other.
std::vector<std::int32_t> levels_of(const TemporalTextures& textures);

/// The constants of frame `frame`: counts, camera now and one frame before (at frame 0: now), and
/// how pixels get their random numbers.
FrameConstants frame_constants(const Scene& scene, const PackedScene& packed,
                               const TemporalTextures& textures, const RenderSettings& settings,
                               Extent padded, int frame);

}  // namespace bn::render
