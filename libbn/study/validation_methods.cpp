// The methods of a study: those with the mask, those with a stack of masks, and variations of the settings.

#include <fmt/format.h>

#include <algorithm>

#include "core/refuse.h"
#include "study/validation.h"

namespace bn {

std::string StudyMethod::name() const {
  if (stack.empty()) return std::string(name_of(method));
  return method == Method::mask_moved ? stack : fmt::format("{}-{}", name_of(method), stack);
}

std::vector<StudyMethod> study_methods(std::span<const std::string> stacks) {
  std::vector<StudyMethod> methods;
  // Samplers first, then what carries seeds.
  for (const bool carries : {false, true}) {
    for (const Method& method : kMethods) {
      if (carries == (method.transport != SeedTransport::none)) methods.push_back({method});
    }
    for (const std::string& stack : stacks)
      methods.push_back({carries ? Method::retarget : Method::mask_moved, stack});
  }
  return methods;
}

namespace study {

std::vector<Variant> variants_of(const StudyOptions& options) {
  std::vector<Variant> variants;
  for (const StudyMethod& method : options.methods)
    variants.push_back({method.name(), method, options.block, options.sort_by_light});
  if (!options.variations) return variants;
  for (const int block : {2, 4, 8, 16}) {
    if (block == options.block) continue;
    variants.push_back(
        {fmt::format("retarget-block-{}", block), {Method::retarget}, block, options.sort_by_light});
  }
  if (!options.sort_by_light) {
    variants.push_back({"retarget-by-light", {Method::retarget}, options.block, true});
    variants.push_back({"reproject-by-light", {Method::reproject}, options.block, true});
  }
  return variants;
}

const TemporalTextures& Stage::textures_of(const StudyMethod& method) const {
  if (method.stack.empty()) return textures;
  const auto found = std::find_if(options.stacks.begin(), options.stacks.end(),
                                  [&](const StudyStack& stack) { return stack.name == method.stack; });
  if (found == options.stacks.end())
    refuse("method", fmt::format("{} without a stack of that name", method.name()),
           "the stacks of the study");
  return found->textures;
}

std::unique_ptr<Renderer> Stage::renderer(const TemporalTextures& with,
                                          const RenderSettings& settings) const {
  if (device) return make_vulkan_renderer(device, scene, with, settings);
  return make_plain_renderer(scene, with, settings, execution);
}

}  // namespace study
}  // namespace bn
