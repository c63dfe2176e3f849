// A recipe written out: every key, so that no later change of a default can change what it means.
// This is the text inside every file.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <type_traits>

#include "bn/bake.h"

namespace bn {
namespace {

/// A TOML basic string.
std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// The shortest decimal that reads back as the same double, as a TOML float.
std::string number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// Parameters that were left to follow from others are left out.
std::string anneal_text(const AnnealMethod& anneal) {
  const AnnealOptions& options = anneal.options;
  using Rule = StartTemperature::Rule;
  const Rule rule = options.start.rule;
  std::string text = "method = \"anneal\"\n";
  const auto out = std::back_inserter(text);
  if (!anneal.channels.empty()) fmt::format_to(out, "channels = [{}]\n", fmt::join(anneal.channels, ", "));
  if (!anneal.weights.empty()) fmt::format_to(out, "weights = [{}]\n", fmt::join(anneal.weights, ", "));
  fmt::format_to(out, "residual_sigma = {}\nschedule = \"{}\"\n", number(anneal.residual_sigma_px),
                 options.schedule);
  const auto given = [&](const char* key, const auto& value) {
    if (!value) return;
    if constexpr (std::is_same_v<std::decay_t<decltype(*value)>, double>) {
      fmt::format_to(out, "{} = {}\n", key, number(*value));
    } else {
      fmt::format_to(out, "{} = {}\n", key, *value);
    }
  };
  const ScheduleParameters& p = options.parameters;
  given("factor", p.factor);
  given("slope", p.slope);
  given("hajek_c", p.hajek_c);
  given("stages", p.stages);
  given("accepted_per_stage", p.accepted_per_stage);
  given("tried_per_stage", p.tried_per_stage);
  given("frozen_stages", p.frozen_stages);
  const double acceptance = rule == Rule::everything   ? 1.0
                            : rule == Rule::acceptance ? options.start.value
                                                       : 0.0;
  fmt::format_to(out,
                 "proposals = {}\nseed = {}\nstart_temperature = {}\ninitial_acceptance = {}\n"
                 "end_temperature = {}\nchains = {}\ncoupling = \"{}\"\nswap_distance = {}\n",
                 options.proposals, options.seed, number(rule == Rule::given ? options.start.value : 0.0),
                 number(acceptance), number(options.end_temperature), options.chains.count,
                 options.chains.coupling == ChainOptions::Coupling::tempering ? "tempering" : "independent",
                 options.swap_distance_px);
  if (options.stop_after > 0) fmt::format_to(out, "stop_after = {}\n", options.stop_after);
  return text;
}

}  // namespace

std::string_view name_of(MoveForm form) { return form == MoveForm::scatter ? "scatter" : "gather"; }
std::string_view name_of(Reach reach) { return reach == Reach::chebyshev ? "chebyshev" : "euclidean"; }
std::string_view name_of(Metric metric) { return metric == Metric::l1 ? "l1" : "l2"; }

std::string recipe_text(const Recipe& recipe) {
  std::string text =
      fmt::format("version = {}\ncontact_sheet = {}\n", kRecipeVersion, toml_string(recipe.contact_sheet));
  const auto out = std::back_inserter(text);
  for (const MaskEntry& mask : recipe.masks) {
    fmt::format_to(out,
                   "\n[[mask]]\nname = {}\nmethod = \"void-and-cluster\"\nsize = [{}, {}]\nsigma = {}\n"
                   "initial_density = {}\nseed = {}\ncutoff = {}\noutputs = [\n",
                   toml_string(mask.name), mask.options.size.width, mask.options.size.height,
                   number(mask.options.sigma_px), number(mask.options.initial_density), mask.options.seed,
                   mask.options.cutoff_px);
    for (const MaskOutput& output : mask.outputs) {
      fmt::format_to(out, "  {{ path = {}, type = \"{}\" }},\n", toml_string(output.path),
                     name_of(output.type));
    }
    text += "]\n";
  }
  for (const RetargetEntry& set : recipe.retargets) {
    fmt::format_to(out, "\n[[retarget]]\nname = {}\n", toml_string(set.name));
    if (set.mask.empty()) {
      fmt::format_to(out, "image = {}\n", toml_string(set.image));
      if (!set.anneal || set.anneal->channels.empty()) fmt::format_to(out, "channel = {}\n", set.channel);
    } else {
      fmt::format_to(out, "mask = {}\nlevels = \"{}\"\n", toml_string(set.mask), name_of(set.levels));
    }
    const std::string step = set.step ? fmt::format("[{}, {}]", set.step->x, set.step->y) : "\"auto\"";
    fmt::format_to(out, "step = {}\nradius = {}\nreach = \"{}\"\nmetric = \"{}\"\nwrap = {}\nmotion = {}\n",
                   step, set.options.radius, name_of(set.options.reach), name_of(set.options.metric),
                   set.options.wrap, set.motion);
    if (set.anneal) {
      text += anneal_text(*set.anneal);
    } else {
      fmt::format_to(out, "gap = {}\n", number(set.options.gap));
    }
    text += "outputs = [\n";
    for (const RetargetOutput& output : set.outputs) {
      const bool is_tile = output.kind == RetargetOutput::Kind::tile;
      fmt::format_to(out, "  {{ path = {}, kind = \"{}\", form = \"{}\"", toml_string(output.path),
                     is_tile ? "tile" : "atlas", name_of(output.form));
      if (is_tile) fmt::format_to(out, ", motion = [{}, {}]", output.motion.x, output.motion.y);
      text += " },\n";
    }
    text += "]\n";
  }
  return text;
}

}  // namespace bn
