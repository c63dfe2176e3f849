// The passes of a frame on a Vulkan device, and the renderer that executes their list there: a time stamp
// after each pass, and a second submission where the frame's seeds are read before the sort moves them.

#include <algorithm>

#include "render/frame_passes.h"
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

/// What a frame consists of on the device, the images of the temporal passes aside.
struct DeviceImages {
  gpu::DeviceBuffer constants, scene, levels, positions, normals, albedos, colours, shown;
};

/// The passes that are no temporal ones.
struct DevicePasses {
  explicit DevicePasses(VulkanDevice& device)
      : gbuffer(gpu::shared_pass(device, shaders::gbuffer, 6, 0, 8)),
        trace(gpu::shared_pass(device, shaders::trace, 9, 0, 8)),
        tone_map(gpu::shared_pass(device, shaders::tone_map, 2, sizeof(ToneMapPush), 64)) {}
  std::shared_ptr<const gpu::Pass> gbuffer, trace, tone_map;
};

template <class T>
void download_all(VulkanDevice& device, const gpu::DeviceBuffer& from, Grid<T>& to) {
  device.download(from, std::as_writable_bytes(std::span(to.data(), to.count())));
}

}  // namespace

/// A frame in the making.
struct DeviceFrame {
  const vk::raii::CommandBuffer& commands;
  const DeviceImages& images;
  const DevicePasses& passes;
  TemporalPasses& temporal;
  const RenderSettings& settings;
  int number = 0;

  int tiles_down() const { return (settings.screen.height + 7) / 8; }
};

namespace on_device {

void gbuffer(DeviceFrame& frame) {
  const DeviceImages& images = frame.images;
  frame.passes.gbuffer->record_without_push(frame.commands,
                                            {&images.constants, &images.scene, &images.positions,
                                             &images.normals, &images.albedos, &frame.temporal.motion()},
                                            frame.settings.screen.width, frame.tiles_down());
}

void choose_motion(DeviceFrame& frame) { frame.temporal.record_motion_choice(frame.commands); }

void retarget(DeviceFrame& frame) { frame.temporal.record_retarget(frame.commands, frame.number - 1); }

void trace(DeviceFrame& frame) {
  const DeviceImages& images = frame.images;
  frame.passes.trace->record_without_push(
      frame.commands,
      {&images.constants, &images.scene, &images.positions, &images.normals, &images.albedos,
       &frame.temporal.seeds(), &images.levels, &images.colours, &frame.temporal.luminance()},
      frame.settings.screen.width, frame.tiles_down());
}

void sort(DeviceFrame& frame) {
  const RenderSettings& settings = frame.settings;
  frame.temporal.record_sort(
      frame.commands, frame.number,
      sort_blocks(settings.block, settings.jitter, settings.seed, frame.number).origin);
}

void tone_map(DeviceFrame& frame) {
  const std::int64_t pixels = frame.settings.screen.area();
  frame.passes.tone_map->record(frame.commands, {&frame.images.colours, &frame.images.shown},
                                ToneMapPush{static_cast<std::int32_t>(pixels)}, pixels);
}

}  // namespace on_device

namespace {

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
        passes_(*device_),
        timer_(*device_) {
    const auto pixels = static_cast<std::uint64_t>(settings.screen.area());
    images_.constants = device_->make_buffer(sizeof(FrameConstants));
    images_.scene = device_->make_buffer(packed_.words.size() * sizeof(vec4));
    device_->upload(images_.scene, std::as_bytes(std::span(packed_.words)));
    for (gpu::DeviceBuffer* buffer :
         {&images_.positions, &images_.normals, &images_.albedos, &images_.colours}) {
      *buffer = device_->make_buffer(pixels * sizeof(vec4));
    }
    images_.shown = device_->make_buffer(pixels * 4);
    const std::vector<std::int32_t> levels = levels_of(textures);
    images_.levels = device_->make_buffer(levels.size() * 4);
    device_->upload(images_.levels, std::as_bytes(std::span(levels)));
  }

  Frame next() override {
    Frame result;
    const std::vector<FramePass> passes = passes_of(settings_.method, frame_);
    for (std::size_t at = 0; at < passes.size();) {
      const std::size_t first = at;
      device_->run([&](const vk::raii::CommandBuffer& commands) { at = record(commands, passes, first); });
      for (PassTime& time : timer_.read()) result.times.push_back(std::move(time));
      // Downloads are no part of the frame's time.
      if (passes[at - 1].seeds_are_final) read_seeds(passes, result);
    }
    read_images(result);
    check_seeds(result.seeds, digest_);
    ++frame_;
    return result;
  }

  std::string device() const override { return device_->name(); }

 private:
  /// Records the passes from `first` to one after which seeds are read, or to the last; returns what follows.
  std::size_t record(const vk::raii::CommandBuffer& commands, const std::vector<FramePass>& passes,
                     std::size_t first) {
    if (first == 0) {
      const FrameConstants constants =
          frame_constants(scene_, packed_, textures_, settings_, padded_, frame_);
      commands.updateBuffer<FrameConstants>(*images_.constants.buffer, 0, constants);
      gpu::record_barrier(commands);
    }
    timer_.start(commands);
    DeviceFrame frame{commands, images_, passes_, temporal_, settings_, frame_};
    std::size_t at = first;
    do {
      passes[at].on_device(frame);
      timer_.mark(commands, std::string(passes[at].name), bytes_of(passes[at]));
    } while (!passes[at++].seeds_are_final && at < passes.size());
    return at;
  }

  void read_seeds(const std::vector<FramePass>& passes, Frame& result) {
    result.seeds = temporal_.download_seeds();
    const bool retargets = std::any_of(passes.begin(), passes.end(),
                                       [](const FramePass& pass) { return pass.name == "retarget"; });
    if (retargets) result.motion = temporal_.download_chosen_motion();
  }

  void read_images(Frame& result) {
    const Extent screen = settings_.screen;
    Grid<vec4> colours(screen);
    download_all(*device_, images_.colours, colours);
    result.colour = Grid<Rgb>(screen);
    for (std::size_t i = 0; i < colours.count(); ++i)
      result.colour[i] = {colours[i].x, colours[i].y, colours[i].z};
    result.shown = Grid<std::uint32_t>(screen);
    download_all(*device_, images_.shown, result.shown);
    result.motion_of_pixel = Grid<PixelMotion>(screen);
    download_all(*device_, temporal_.motion(), result.motion_of_pixel);
  }

  /// Of the images that a pass reads or writes, each once.
  std::uint64_t bytes_of(const FramePass& pass) const {
    std::vector<FrameImage> images = pass.inputs;
    images.insert(images.end(), pass.outputs.begin(), pass.outputs.end());
    std::sort(images.begin(), images.end());
    images.erase(std::unique(images.begin(), images.end()), images.end());
    std::uint64_t bytes = 0;
    for (const FrameImage image : images) bytes += bytes_of(image);
    return bytes;
  }

  std::uint64_t bytes_of(FrameImage image) const {
    switch (image) {
      case FrameImage::scene:
        return images_.scene.bytes;
      case FrameImage::position:
        return images_.positions.bytes;
      case FrameImage::normal:
        return images_.normals.bytes;
      case FrameImage::albedo:
        return images_.albedos.bytes;
      case FrameImage::motion:
        return temporal_.motion().bytes;
      case FrameImage::chosen_motion:
        return 0;  // eight bytes, which say nothing about a frame's traffic
      case FrameImage::moves:
        return temporal_.moves().bytes;
      case FrameImage::seeds:
        return temporal_.seeds().bytes;
      case FrameImage::moved_seeds:
        return temporal_.moved_seeds().bytes;
      case FrameImage::levels:
        return images_.levels.bytes;
      case FrameImage::mask:
        return temporal_.mask().bytes;
      case FrameImage::luminance:
        return temporal_.luminance().bytes;
      case FrameImage::colour:
        return images_.colours.bytes;
      case FrameImage::shown:
        return images_.shown.bytes;
    }
    return 0;
  }

  std::shared_ptr<VulkanDevice> device_;
  Scene scene_;
  TemporalTextures textures_;
  RenderSettings settings_;
  Extent padded_;
  PackedScene packed_;
  std::uint64_t digest_;
  TemporalPasses temporal_;
  DevicePasses passes_;
  gpu::PassTimer timer_;
  DeviceImages images_;
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
