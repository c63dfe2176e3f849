// What both renderers need: names of methods, checks, and the seeds that a sequence starts with.

#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "bn/random.h"
#include "core/refuse.h"
#include "render/scene.h"

namespace bn {
namespace {

struct NamedMethod {
  Method method;
  std::string_view name;
};
constexpr NamedMethod kNames[] = {
    {Method::white, "white"},
    {Method::mask_still, "mask-still"},
    {Method::mask_moved, "mask-moved"},
    {Method::mask_golden, "mask-golden"},
    {Method::sort, "sort"},
    {Method::retarget, "retarget"},
    {Method::reproject, "reproject"},
};

}  // namespace

std::string_view name_of(const Method& method) {
  for (const NamedMethod& named : kNames) {
    if (named.method == method) return named.name;
  }
  return "";
}

namespace render {

Extent check_rendering(const Scene& scene, const TemporalTextures& textures, const RenderSettings& settings) {
  check_scene(scene);
  textures.check();
  if (settings.screen.width > 4096 || settings.screen.height > 4096) {
    refuse("size", fmt::format("{}x{}", settings.screen.width, settings.screen.height), "sides of 1..4096");
  }
  if (settings.bounces < 1 || settings.bounces > 8) {
    refuse("bounces", fmt::format("{} bounces", settings.bounces), "1..8");
  }
  if (settings.paths < 1 || settings.paths > 64)
    refuse("paths", fmt::format("{} paths", settings.paths), "1..64");
  sort_blocks(settings.block, false, 0, 0);  // refuses other sides
  const auto [sampler, transport] = settings.method;
  if (transport != SeedTransport::none && sampler != Sampler::seeds) {
    refuse("method", "seeds that are carried to the next frame but not sampled",
           "transport only with the sampler of seeds");
  }
  const bool needs_tile = transport == SeedTransport::retarget || transport == SeedTransport::reproject;
  if (needs_tile && textures.moves.empty()) refuse("textures", "no retarget tile", "");
  return padded_extent(settings.screen, textures.size());
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

}  // namespace render
}  // namespace bn
