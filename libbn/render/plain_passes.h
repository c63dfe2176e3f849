// G-buffer, path tracing and tone mapping on the processor: the shared shader text as C++.
#pragma once

#include "bn/render.h"
#include "render/scene.h"

namespace bn::render {

struct GBuffer {
  explicit GBuffer(Extent screen) : position(screen), normal(screen), albedo(screen), motion(screen) {}
  Grid<vec4> position;  ///< w: distance, below 0 where nothing is seen
  Grid<vec4> normal;    ///< w: roughness
  Grid<vec4> albedo;    ///< w: material
  Grid<PixelMotion> motion;
};

void render_gbuffer(GBuffer& gbuffer, const PackedScene& scene, const FrameConstants& constants,
                    const Execution& execution);

void render_paths(Grid<Rgb>& colour, Grid<float>& luminance, const GBuffer& gbuffer, const Seeds& seeds,
                  const std::vector<std::int32_t>& levels, const PackedScene& scene,
                  const FrameConstants& constants, const Execution& execution);

Grid<std::uint32_t> tone_map(const Grid<Rgb>& colour);

}  // namespace bn::render
