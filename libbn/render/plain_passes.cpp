// The shared shader text as C++: each .glsl file below is the body of a struct, whose members play
// the part of the shader's globals and buffers.

#include "render/plain_passes.h"

namespace bn::render {
namespace {

using uint = std::uint32_t;

struct Tracer : FrameConstants {
  Tracer(const FrameConstants& constants, const vec4* words, const std::int32_t* levels)
      : FrameConstants(constants), scene(words), level(levels) {}

  const vec4* scene;
  const std::int32_t* level;
  uint stream = 0;
  uint dimension = 0;
  int pixel_x = 0;
  int pixel_y = 0;

  static float sqrt(float x) { return std::sqrt(x); }
  static float floor(float x) { return std::floor(x); }

#include "render/shaders/gbuffer.glsl"
#include "render/shaders/sampling.glsl"
#include "render/shaders/trace.glsl"
};

struct ToneMap {
  static float sqrt(float x) { return std::sqrt(x); }
#include "render/shaders/tone_map.glsl"
};

}  // namespace

void render_gbuffer(GBuffer& gbuffer, const PackedScene& scene, const FrameConstants& constants,
                    const Execution& execution) {
  parallel_for(execution, gbuffer.position.height(), [&](std::int64_t row) {
    Tracer tracer(constants, scene.words.data(), nullptr);
    const int y = static_cast<int>(row);
    for (int x = 0; x < gbuffer.position.width(); ++x) {
      const Tracer::Seen seen = tracer.see(x, y);
      gbuffer.position(x, y) = seen.position;
      gbuffer.normal(x, y) = seen.normal;
      gbuffer.albedo(x, y) = seen.albedo;
      gbuffer.motion(x, y) = {static_cast<std::int16_t>(seen.motion_x),
                              static_cast<std::int16_t>(seen.motion_y)};
    }
  });
}

void render_paths(Grid<Rgb>& colour, Grid<float>& luminance, const GBuffer& gbuffer, const Seeds& seeds,
                  const std::vector<std::int32_t>& levels, const PackedScene& scene,
                  const FrameConstants& constants, const Execution& execution) {
  parallel_for(execution, colour.height(), [&](std::int64_t row) {
    Tracer tracer(constants, scene.words.data(), levels.data());
    const int y = static_cast<int>(row);
    for (int x = 0; x < colour.width(); ++x) {
      tracer.pixel_x = x;
      tracer.pixel_y = y;
      const uint seed = seeds(x, y) ^ (constants.sampling == 0 ? constants.frame_key : 0u);
      const Tracer::Seen seen{gbuffer.position(x, y), gbuffer.normal(x, y), gbuffer.albedo(x, y), 0, 0};
      const vec3 radiance = tracer.render_paths(seen, seed);
      colour(x, y) = {radiance.x, radiance.y, radiance.z};
      luminance(x, y) = tracer.sort_luminance(seen, radiance);
    }
  });
}

Grid<std::uint32_t> tone_map(const Grid<Rgb>& colour) {
  Grid<std::uint32_t> shown(colour.size());
  ToneMap map;
  for (std::size_t i = 0; i < shown.count(); ++i) {
    const Rgb& c = colour[i];
    shown[i] = map.display_byte(c.r) | map.display_byte(c.g) << 8 | map.display_byte(c.b) << 16 | 0xFF000000u;
  }
  return shown;
}

}  // namespace bn::render
