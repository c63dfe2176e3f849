// Any bytes: the parser answers with a recipe or a bn::Error that says where; and a recipe that came
// out, written out whole, reads back the same and keeps every promise of the language.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "bn/anneal.h"
#include "bn/bake.h"
#include "bn/error.h"
#include "promise.h"

namespace {

using namespace bn;

void check_inside(const std::string& path) {
  const std::filesystem::path normal = std::filesystem::path("out") / path;
  const std::string text = normal.lexically_normal().string();
  require(text.starts_with("out/") && text.size() > 4, "outputs stay in the output folder");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Recipe recipe;
  try {
    recipe = parse_recipe({reinterpret_cast<const char*>(data), size}, "input", "");
  } catch (const Error& error) {
    require(std::string_view(error.what()).starts_with("input"), "an error says where");
    return 0;
  }
  for (const auto& entry : recipe.entries) {
    require(entry->output_count() > 0, "an entry has a file");
    for (std::size_t i = 0; i < entry->output_count(); ++i) check_inside(entry->path_of(i));
    const Options options = options_of(*entry);
    for (const Option& option : options.list())
      require(!option.applies() || out_of_range(option, option.get()).empty(), "options are in range");
    const auto* retarget = dynamic_cast<const RetargetEntry*>(entry.get());
    if (!retarget) continue;
    const RetargetEntry& set = *retarget;
    require(set.mask.empty() != set.image.empty(), "a set has one source");
    require(set.problem.radius + set.motion <= 127, "moves fit 8 bits");
    if (!set.anneals) continue;
    const AnnealMethod& anneal = set.anneal;
    check_anneal_options(anneal.options);
    require(anneal.channels.size() <= 16, "channels are few");
    require(
        anneal.weights.empty() || anneal.weights.size() == std::max<std::size_t>(1, anneal.channels.size()),
        "each channel has a weight");
    require(anneal.residual_sigma_px == 0.0 || set.problem.metric == Metric::l2, "residuals are of squares");
    require(anneal.seconds == 0.0, "a recipe knows no clock");
  }
  const std::string text = recipe_text(recipe);
  require(text == recipe_text(parse_recipe(text, "again", "")), "written out it reads back the same");
  return 0;
}
