// The frame, pass by pass, on the processor. The Vulkan renderer makes the same passes in the same order.

#include "render/renderer.h"

#include <fmt/format.h>

#include "bn/error.h"
#include "bn/random.h"
#include "render/plain_passes.h"

namespace bn {

std::string_view name_of(Method method) {
  switch (method) {
    case Method::white:
      return "white";
    case Method::mask_still:
      return "mask-still";
    case Method::mask_moved:
      return "mask-moved";
    case Method::mask_golden:
      return "mask-golden";
    case Method::slices:
      return "slices";
    case Method::sort:
      return "sort";
    case Method::retarget:
      return "retarget";
    case Method::reproject:
      return "reproject";
  }
  return "";
}

namespace render {

Extent check_rendering(const Scene& scene, const TemporalTextures& textures, const RenderSettings& settings) {
  check_scene(scene);
  textures.check();
  const auto refuse = [](std::string what, std::string where, std::string limit) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::move(what),
                 .where = std::move(where),
                 .limit = std::move(limit),
                 .remedy = ""});
  };
  if (settings.screen.width > 4096 || settings.screen.height > 4096) {
    refuse(fmt::format("{}x{}", settings.screen.width, settings.screen.height), "size", "sides of 1..4096");
  }
  if (settings.bounces < 1 || settings.bounces > 8) {
    refuse(fmt::format("{} bounces", settings.bounces), "bounces", "1..8");
  }
  if (settings.paths < 1 || settings.paths > 64)
    refuse(fmt::format("{} paths", settings.paths), "paths", "1..64");
  sort_blocks(settings.block, false, 0, 0);  // refuses other sides
  if (settings.method == Method::slices && textures.slices.empty()) refuse("no stack of masks", "slices", "");
  if (moves_seeds(settings.method) && settings.method != Method::sort && textures.moves.empty()) {
    refuse("no retarget tile", "textures", "");
  }
  return padded_extent(settings.screen, textures.mask.size());
}

bool moves_seeds(Method method) {
  return method == Method::sort || method == Method::retarget || method == Method::reproject;
}

Seeds seeds_of_sequence(Extent padded, std::uint64_t seed) {
  constexpr std::uint32_t kSeedStream = 0x52540004u;
  return initial_seeds(padded, static_cast<std::uint32_t>(random_bits(seed, kSeedStream, 0)));
}

void check_seeds(const Seeds& seeds, std::uint64_t digest) {
  if (multiset_digest(seeds) == digest) return;
  throw Error({.code = ErrorCode::verification_failed,
               .what = "seeds were lost or doubled",
               .where = "the temporal passes",
               .limit = "",
               .remedy = "check the textures with bn verify"});
}

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
        levels_(levels_to_sample(textures, settings.method)),
        seeds_(seeds_of_sequence(padded_, settings.seed)),
        digest_(multiset_digest(seeds_)),
        gbuffer_(settings.screen) {}

  Frame next() override {
    const FrameConstants constants = frame_constants(scene_, packed_, textures_, settings_, padded_, frame_);
    Frame result;
    result.colour = Grid<Rgb>(settings_.screen);
    render_gbuffer(gbuffer_, packed_, constants, execution_);
    const Extent tile = textures_.mask.size();
    if (frame_ > 0 && (settings_.method == Method::retarget || settings_.method == Method::reproject)) {
      if (settings_.method == Method::reproject) {
        result.motion = choose_motion(gbuffer_.motion, textures_.motion_range);
      }
      seeds_ = retarget_seeds(seeds_, textures_.move(result.motion),
                              tile_shift(tile, textures_.step, frame_ - 1), execution_);
    }
    result.seeds = seeds_;
    Grid<float> luminance(settings_.screen);
    render_paths(result.colour, luminance, gbuffer_, seeds_, levels_, packed_, constants, execution_);
    if (moves_seeds(settings_.method)) {
      sort_seeds(seeds_, luminance, textures_.mask, tile_shift(tile, textures_.step, frame_),
                 sort_blocks(settings_.block, settings_.jitter, settings_.seed, frame_), execution_);
    }
    result.shown = tone_map(result.colour);
    result.motion_of_pixel = gbuffer_.motion;
    check_seeds(seeds_, digest_);
    ++frame_;
    return result;
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
