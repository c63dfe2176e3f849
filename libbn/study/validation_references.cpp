// Converged pictures: the mean of many independent paths a pixel, with the camera at rest where a frame of
// the sequence has it.
//
// A picture of N paths has itself an error, white and N times less in power than one frame's. Its halves are
// summed apart: half their difference is as strong as that error, so it is measured, not assumed, and its
// power can be taken off what a method seems to leave.
//
// A moving camera needs one a frame. They are kept in files, named by a hash of all that decides them, so
// that the next method, block size or retarget tile to be measured finds them there.

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "bn/error.h"
#include "bn/texture.h"
#include "render/camera.h"
#include "render/renderer.h"
#include "render/scene.h"
#include "study/validation.h"

namespace bn::study {
using namespace render;
namespace {

// Not the seed of anything measured: a reference must not share its random numbers, nor change with them.
constexpr std::uint64_t kReferenceSeed = 0xC0417E46EDFu;
constexpr int kMostPaths = 16;  // a frame; more would keep a device busy for seconds without an answer

RenderSettings settings_of(const Stage& stage, int frame) {
  const int paths = std::clamp(stage.options.reference_samples / 2, 1, kMostPaths);
  return {.screen = stage.options.screen,
          .method = Method::white,
          .bounces = stage.options.bounces,
          .paths = paths,
          .seed = kReferenceSeed,
          .camera_frame = frame};
}

int frames_of(const Stage& stage) {
  const int paths = settings_of(stage, 0).paths;
  return (stage.options.reference_samples + paths - 1) / paths;
}

}  // namespace

References::References(const Stage& stage, int frames, std::filesystem::path folder)
    : stage_(stage), folder_(std::move(folder)) {
  for (int frame = 0; frame <= frames; ++frame) {
    const auto seen = std::find_if(frame_of_view_.begin(), frame_of_view_.end(),
                                   [&](int other) { return same_view(stage.scene, frame, other); });
    view_of_frame_.push_back(static_cast<int>(seen - frame_of_view_.begin()));
    if (seen == frame_of_view_.end()) frame_of_view_.push_back(frame);
  }
}

std::filesystem::path References::file_of(int view) const {
  // All that decides a reference: what the shaders are told, in the first frame of the run that makes it.
  const RenderSettings settings = settings_of(stage_, frame_of_view_[static_cast<std::size_t>(view)]);
  const PackedScene packed = pack_scene(stage_.scene);
  const Extent padded = padded_extent(settings.screen, stage_.textures.size());
  FrameConstants constants = frame_constants(stage_.scene, packed, stage_.textures, settings, padded, 0);
  constants.tile_width = constants.tile_height = constants.level_shift =
      0;  // of a mask that white noise ignores
  constants.unused = stage_.options.reference_samples;
  const std::size_t of_scene = packed.words.size() * sizeof(vec4);
  Image all{.size = {static_cast<int>(sizeof constants + of_scene), 1},
            .channels = 1,
            .type = SampleType::u8,
            .samples = std::vector<std::byte>(sizeof constants + of_scene)};
  std::memcpy(all.samples.data(), &constants, sizeof constants);
  std::memcpy(all.samples.data() + sizeof constants, packed.words.data(), of_scene);
  const std::string hash = pixel_hash(all);
  return folder_ / fmt::format("{}-{}.bin", stage_.scene.name, hash.substr(hash.find(':') + 1, 16));
}

std::optional<Reference> References::read(int view) const {
  const auto path = file_of(view);
  if (!std::filesystem::exists(path)) return {};
  try {
    const FileContent file = read_image(path, stage_.execution);
    const Image& image = file.image;
    const bool fits =
        image.size == stage_.options.screen && image.channels == 2 && image.type == SampleType::f32;
    if (!fits || !file.metadata || pixel_hash(image) != file.metadata->pixel_hash) return {};
    Reference reference{Grid<float>(image.size), Grid<float>(image.size)};
    for (std::size_t i = 0; i < reference.luminance.count(); ++i) {
      std::memcpy(&reference.luminance[i], &image.samples[8 * i], 4);
      std::memcpy(&reference.own_error[i], &image.samples[8 * i + 4], 4);
    }
    return reference;
  } catch (const Error&) {
    return {};  // cut short or damaged: rendered again
  }
}

int References::work() const {
  int frames = 0;
  for (int view = 0; view < views(); ++view) {
    if (!read(view)) frames += frames_of(stage_);
  }
  return frames;
}

void References::render(ProgressMeter& progress) {
  make_folder(folder_);
  for (int view = 0; view < views(); ++view) {
    if (read(view)) continue;
    const RenderSettings settings = settings_of(stage_, frame_of_view_[static_cast<std::size_t>(view)]);
    const auto renderer = stage_.renderer(stage_.textures, settings);
    const auto pixels = static_cast<std::size_t>(settings.screen.area());
    std::vector<double> halves[2] = {std::vector<double>(pixels), std::vector<double>(pixels)};
    int counts[2] = {0, 0};
    for (int i = 0; i < frames_of(stage_); ++i) {
      throw_if_stopped(stage_.execution);
      const Grid<float> sample = luminance_of(renderer->next().colour);
      for (std::size_t p = 0; p < pixels; ++p) halves[i % 2][p] += sample[p];
      ++counts[i % 2];
      progress.advance(1);
    }
    Image image{.size = settings.screen, .channels = 2, .type = SampleType::f32, .samples = {}};
    image.samples.resize(pixels * 8);
    for (std::size_t p = 0; p < pixels; ++p) {
      const double mean = (halves[0][p] + halves[1][p]) / (counts[0] + counts[1]);
      const double own = counts[1] == 0 ? 0.0 : 0.5 * (halves[0][p] / counts[0] - halves[1][p] / counts[1]);
      const float both[2] = {static_cast<float>(mean), static_cast<float>(own)};
      std::memcpy(&image.samples[8 * p], both, 8);
    }
    Metadata metadata;
    metadata.algorithm = "validate";
    metadata.kind = "reference";
    write_image(file_of(view), image, metadata);
  }
}

const Reference& References::at(int frame) {
  const int view = view_of_frame_[static_cast<std::size_t>(frame)];
  if (view != view_) {
    std::optional<Reference> reference = read(view);
    if (!reference) {
      throw Error({.code = ErrorCode::io,
                   .what = "a converged picture that was just written cannot be read back",
                   .where = file_of(view).string(),
                   .limit = "",
                   .remedy = "is another run writing to this folder?"});
    }
    current_ = std::move(*reference);
    view_ = view;
  }
  return current_;
}

}  // namespace bn::study
