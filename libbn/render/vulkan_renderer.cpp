// The frame on a Vulkan device: one submission a frame, a time stamp after each pass.

#include <fmt/format.h>

#include "render/renderer.h"
#include "render/scene.h"
#include "render/shaders.h"
#include "render/temporal_passes.h"

namespace bn {
namespace render {

namespace {

struct ToneMapPush {
  std::int32_t count;
};

template <class T>
void download_all(VulkanDevice& device, const gpu::DeviceBuffer& from, Grid<T>& to) {
  device.download(from, std::as_writable_bytes(std::span(to.data(), to.count())));
}

class VulkanRenderer final : public Renderer {
 public:
  VulkanRenderer(std::shared_ptr<VulkanDevice> device, const Scene& scene, const TemporalTextures& textures,
                 const RenderSettings& settings)
      : device_(std::move(device)),
        scene_(scene),
        textures_(textures),
        settings_(settings),
        padded_(check_rendering(scene, textures, settings)),
        packed_(pack_scene(scene)),
        digest_(multiset_digest(seeds_of_sequence(padded_, settings.seed))),
        temporal_(*device_, textures, settings.screen, seeds_of_sequence(padded_, settings.seed),
                  settings.block),
        gbuffer_(gpu::shared_pass(*device_, shaders::gbuffer, 6, 0, 8)),
        trace_(gpu::shared_pass(*device_, shaders::trace, 9, 0, 8)),
        tone_map_(gpu::shared_pass(*device_, shaders::tone_map, 2, sizeof(ToneMapPush), 64)),
        timer_(*device_) {
    const auto pixels = static_cast<std::uint64_t>(settings.screen.area());
    constants_ = device_->make_buffer(sizeof(FrameConstants));
    words_ = device_->make_buffer(packed_.words.size() * sizeof(vec4));
    device_->upload(words_, std::as_bytes(std::span(packed_.words)));
    for (gpu::DeviceBuffer* buffer : {&positions_, &normals_, &albedos_, &colours_}) {
      *buffer = device_->make_buffer(pixels * sizeof(vec4));
    }
    shown_ = device_->make_buffer(pixels * 4);
    const std::vector<std::int32_t> levels = levels_to_sample(textures, settings.method);
    levels_ = device_->make_buffer(levels.size() * 4);
    device_->upload(levels_, std::as_bytes(std::span(levels)));
  }

  Frame next() override {
    const FrameConstants constants = frame_constants(scene_, packed_, textures_, settings_, padded_, frame_);
    const Extent screen = settings_.screen;
    const Extent tile = textures_.mask.size();
    const bool reproject = settings_.method == Method::reproject;
    const bool retarget = settings_.method == Method::retarget || reproject;
    Frame result;
    result.colour = Grid<Rgb>(screen);
    const int tiles_down = (screen.height + 7) / 8;
    device_->run([&](const vk::raii::CommandBuffer& commands) {
      commands.updateBuffer<FrameConstants>(*constants_.buffer, 0, constants);
      gpu::record_barrier(commands);
      timer_.start(commands);
      gbuffer_->record_without_push(
          commands, {&constants_, &words_, &positions_, &normals_, &albedos_, &temporal_.motion()},
          screen.width, tiles_down);
      timer_.mark(commands, "gbuffer", {&words_, &positions_, &normals_, &albedos_, &temporal_.motion()});
      if (frame_ > 0 && retarget) {
        if (reproject) {
          temporal_.record_motion_choice(commands);
          timer_.mark(commands, "motion", {&temporal_.motion()});
        }
        temporal_.record_retarget(commands, tile_shift(tile, textures_.step, frame_ - 1));
        timer_.mark(commands, "retarget", {&temporal_.moves(), &temporal_.seeds(), &temporal_.moved_seeds()});
      }
      trace_->record_without_push(commands,
                                  {&constants_, &words_, &positions_, &normals_, &albedos_,
                                   &temporal_.seeds(), &levels_, &colours_, &temporal_.luminance()},
                                  screen.width, tiles_down);
      timer_.mark(commands, "trace",
                  {&words_, &positions_, &normals_, &albedos_, &temporal_.seeds(), &levels_, &colours_,
                   &temporal_.luminance()});
    });
    result.times = timer_.read();
    // The seeds as traced, before the sort moves them. Downloads are no part of the frame's time.
    result.seeds = temporal_.download_seeds();
    if (retarget && frame_ > 0) result.motion = temporal_.download_chosen_motion();
    device_->run([&](const vk::raii::CommandBuffer& commands) {
      timer_.start(commands);
      if (moves_seeds(settings_.method)) {
        temporal_.record_sort(commands, tile_shift(tile, textures_.step, frame_),
                              sort_blocks(settings_.block, settings_.jitter, settings_.seed, frame_).origin);
        timer_.mark(commands, "sort", {&temporal_.luminance(), &temporal_.mask(), &temporal_.seeds()});
      }
      tone_map_->record(commands, {&colours_, &shown_}, ToneMapPush{static_cast<std::int32_t>(screen.area())},
                        screen.area());
      timer_.mark(commands, "tone map", {&colours_, &shown_});
    });
    for (PassTime& time : timer_.read()) result.times.push_back(std::move(time));
    Grid<vec4> colours(screen);
    download_all(*device_, colours_, colours);
    for (std::size_t i = 0; i < colours.count(); ++i) {
      result.colour[i] = {colours[i].x, colours[i].y, colours[i].z};
    }
    result.shown = Grid<std::uint32_t>(screen);
    download_all(*device_, shown_, result.shown);
    result.motion_of_pixel = Grid<PixelMotion>(screen);
    download_all(*device_, temporal_.motion(), result.motion_of_pixel);
    check_seeds(result.seeds, digest_);
    ++frame_;
    return result;
  }

  std::string device() const override { return device_->name(); }

 private:
  std::shared_ptr<VulkanDevice> device_;
  Scene scene_;
  TemporalTextures textures_;
  RenderSettings settings_;
  Extent padded_;
  PackedScene packed_;
  std::uint64_t digest_;
  TemporalPasses temporal_;
  std::shared_ptr<const gpu::Pass> gbuffer_, trace_, tone_map_;
  gpu::PassTimer timer_;
  gpu::DeviceBuffer constants_, words_, levels_, positions_, normals_, albedos_, colours_, shown_;
  int frame_ = 0;
};

}  // namespace
}  // namespace render

std::unique_ptr<Renderer> make_vulkan_renderer(std::shared_ptr<VulkanDevice> device, const Scene& scene,
                                               const TemporalTextures& textures,
                                               const RenderSettings& settings) {
  return std::make_unique<render::VulkanRenderer>(std::move(device), scene, textures, settings);
}

}  // namespace bn
