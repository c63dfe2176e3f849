// The passes of a frame on the processor, and the renderer that executes their list there.

#include <algorithm>

#include "render/frame_passes.h"
#include "render/plain_passes.h"
#include "render/renderer.h"

namespace bn {
namespace render {

/// A frame in the making.
struct PlainFrame {
  const TemporalTextures& textures;
  const RenderSettings& settings;
  const Execution& execution;
  const PackedScene& packed;
  const std::vector<std::int32_t>& levels;
  int number = 0;
  FrameConstants constants;
  Seeds& seeds;
  GBuffer& gbuffer;
  Grid<float> luminance;
  Frame result;
};

namespace on_processor {

void gbuffer(PlainFrame& frame) {
  render_gbuffer(frame.gbuffer, frame.packed, frame.constants, frame.execution);
  frame.result.motion_of_pixel = frame.gbuffer.motion;
}

void choose_motion(PlainFrame& frame) {
  frame.result.motion = bn::choose_motion(frame.gbuffer.motion, frame.textures.motion_range);
}

void retarget(PlainFrame& frame) {
  const int before = frame.number - 1;
  frame.seeds = retarget_seeds(frame.seeds, frame.textures.move(frame.result.motion, before),
                               frame.textures.shift(before), frame.execution);
}

void trace(PlainFrame& frame) {
  frame.result.colour = Grid<Rgb>(frame.settings.screen);
  frame.luminance = Grid<float>(frame.settings.screen);
  render_paths(frame.result.colour, frame.luminance, frame.gbuffer, frame.seeds, frame.levels, frame.packed,
               frame.constants, frame.execution);
}

void sort(PlainFrame& frame) {
  const RenderSettings& settings = frame.settings;
  sort_seeds(frame.seeds, frame.luminance, frame.textures.mask(frame.number),
             frame.textures.shift(frame.number),
             sort_blocks(settings.block, settings.jitter, settings.seed, frame.number), frame.execution);
}

void tone_map(PlainFrame& frame) { frame.result.shown = render::tone_map(frame.result.colour); }

}  // namespace on_processor

namespace {

class PlainRenderer final : public Renderer {
 public:
  PlainRenderer(const Scene& scene, const TemporalTextures& textures, const RenderSettings& settings,
                const Execution& execution)
      : scene_(scene),
        textures_(textures),
        settings_(settings),
        execution_(execution),
        padded_(check_rendering(scene, textures, settings)),
        packed_(pack_scene(scene)),
        levels_(levels_of(textures)),
        seeds_(seeds_of_sequence(padded_, settings.seed)),
        digest_(multiset_digest(seeds_)),
        gbuffer_(settings.screen) {}

  Frame next() override {
    PlainFrame frame{.textures = textures_,
                     .settings = settings_,
                     .execution = execution_,
                     .packed = packed_,
                     .levels = levels_,
                     .number = frame_,
                     .constants = frame_constants(scene_, packed_, textures_, settings_, padded_, frame_),
                     .seeds = seeds_,
                     .gbuffer = gbuffer_,
                     .luminance = {},
                     .result = {}};
    for (const FramePass& pass : passes_of(settings_.method, frame_)) {
      pass.on_processor(frame);
      if (pass.seeds_are_final) frame.result.seeds = seeds_;
    }
    check_seeds(seeds_, digest_);
    ++frame_;
    return std::move(frame.result);
  }

  std::string device() const override { return "processor"; }

 private:
  Scene scene_;
  TemporalTextures textures_;
  RenderSettings settings_;
  Execution execution_;
  Extent padded_;
  PackedScene packed_;
  std::vector<std::int32_t> levels_;
  Seeds seeds_;
  std::uint64_t digest_;
  GBuffer gbuffer_;
  int frame_ = 0;
};

}  // namespace
}  // namespace render

std::unique_ptr<Renderer> make_plain_renderer(const Scene& scene, const TemporalTextures& textures,
                                              const RenderSettings& settings, const Execution& execution) {
  return std::make_unique<render::PlainRenderer>(scene, textures, settings, execution);
}

}  // namespace bn
