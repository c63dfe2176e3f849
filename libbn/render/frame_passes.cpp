#include "render/frame_passes.h"

namespace bn::render {

std::vector<FramePass> passes_of(const Method& method, int frame) {
  const bool sorts = method.transport != SeedTransport::none;
  const bool reprojects = method.transport == SeedTransport::reproject;
  // What the frame before sorted is carried to this one; the first frame has none before.
  const bool retargets = frame > 0 && (reprojects || method.transport == SeedTransport::retarget);
  std::vector<FramePass> passes;
  passes.push_back(
      {.name = "gbuffer",
       .inputs = {FrameImage::scene},
       .outputs = {FrameImage::position, FrameImage::normal, FrameImage::albedo, FrameImage::motion},
       .on_processor = on_processor::gbuffer,
       .on_device = on_device::gbuffer});
  if (retargets && reprojects) {
    passes.push_back({.name = "motion",
                      .inputs = {FrameImage::motion},
                      .outputs = {FrameImage::chosen_motion},
                      .on_processor = on_processor::choose_motion,
                      .on_device = on_device::choose_motion});
  }
  if (retargets) {
    passes.push_back({.name = "retarget",
                      .inputs = {FrameImage::moves, FrameImage::chosen_motion, FrameImage::seeds},
                      .outputs = {FrameImage::moved_seeds},
                      .on_processor = on_processor::retarget,
                      .on_device = on_device::retarget});
  }
  passes.push_back({.name = "trace",
                    .inputs = {FrameImage::scene, FrameImage::position, FrameImage::normal,
                               FrameImage::albedo, FrameImage::seeds, FrameImage::levels},
                    .outputs = {FrameImage::colour, FrameImage::luminance},
                    .on_processor = on_processor::trace,
                    .on_device = on_device::trace,
                    .seeds_are_final = true});
  if (sorts) {
    passes.push_back({.name = "sort",
                      .inputs = {FrameImage::luminance, FrameImage::mask, FrameImage::seeds},
                      .outputs = {FrameImage::seeds},
                      .on_processor = on_processor::sort,
                      .on_device = on_device::sort});
  }
  passes.push_back({.name = "tone map",
                    .inputs = {FrameImage::colour},
                    .outputs = {FrameImage::shown},
                    .on_processor = on_processor::tone_map,
                    .on_device = on_device::tone_map});
  return passes;
}

}  // namespace bn::render
