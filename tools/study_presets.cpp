// bn study presets: what a spatiotemporal mask can be good at, as a curve.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bn/report.h"
#include "bn/texture.h"
#include "bn_study/trade_off.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  Extent size{64, 64};
  int frames = 32;
  std::uint64_t seed = 1;
  std::filesystem::path out;
  bool json = false;
};

constexpr std::string_view kFigures =
#include "tools/study_presets.gnuplot.inc"
    ;

/// The presets, and the kernels with the least of each error.
std::string markdown(const std::vector<TradeOff>& rows) {
  std::string text =
      "| kernel | slice share | pixel share | one slice | average | one pixel |\n|---|---|---|---|---|---|\n";
  const auto add = [&](std::string_view name, const TradeOff& row) {
    text += fmt::format("| {} | {} | {} | {:.4f} | {:.4f} | {:.4f} |\n", name, row.slice_share,
                        row.pixel_share, row.slice_error, row.average_error, row.pixel_error);
  };
  for (const TradeOff& row : rows) {
    if (!row.name.empty()) add(fmt::format("`{}`", row.name), row);
  }
  const auto add_least = [&](std::string_view name, double TradeOff::*error) {
    add(name, *std::min_element(rows.begin(), rows.end(), [&](const TradeOff& a, const TradeOff& b) {
          return a.*error < b.*error;
        }));
  };
  add_least("the best slices", &TradeOff::slice_error);
  add_least("the best average", &TradeOff::average_error);
  add_least("the best series", &TradeOff::pixel_error);
  return text;
}

Json json_of(const std::vector<TradeOff>& rows) {
  Json result = Json::array();
  for (const TradeOff& row : rows) {
    result.push_back({{"name", row.name},
                      {"slice_share", row.slice_share},
                      {"pixel_share", row.pixel_share},
                      {"slice_error", row.slice_error},
                      {"average_error", row.average_error},
                      {"pixel_error", row.pixel_error},
                      {"best", row.is_best}});
  }
  return result;
}

void run(const Settings& settings, Session& session) {
  if (!settings.out.empty()) make_folder(settings.out);
  const auto rows = study_trade_off({settings.size.width, settings.size.height, settings.frames},
                                    settings.seed, session.execution_showing("kernels"));
  session.progress.finish();
  if (!settings.out.empty()) {
    write_text_file(settings.out / "presets.csv", trade_off_csv(rows));
    write_text_file(settings.out / "presets.md", markdown(rows));
    const std::string failure = draw_figures(settings.out, kFigures, session.execution);
    if (!failure.empty()) session.progress.note("no figures: " + failure);
  }
  if (settings.json) return session.output.write_result(json_of(rows), true);
  session.output.tell(markdown(rows));
}

}  // namespace

Verb study_presets_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "study presets";
  verb.summary = "Measure what a spatiotemporal mask's kernel can be good at.";
  verb.examples = {{"bn study presets -o presets", "the curve of docs/spatiotemporal.md, a few minutes"}};
  verb.details =
      "One mask cannot be the best in each slice, in each pixel's series and in the filtered average at "
      "once. Makes the presets, and masks with slice_share 0..1 crossed with pixel_share 0..2, and measures "
      "what is left of a thresholded picture's error: one slice after a blur, the average of frames after "
      "blur and exponential average, the mean of all slices at one pixel without a blur. Prints the presets "
      "and the kernels with the least of each. The folder gets presets.csv with all kernels, where `best` "
      "marks those that no other is better than in all three, presets.md, and the figures as SVG where "
      "gnuplot is installed.";
  verb.arguments.option("--size", settings->size, extent_in(8, 1024), "Width and height of the masks.");
  verb.arguments.option("--frames", settings->frames, integer_in(2, 1024), "Slices of the masks.");
  verb.arguments.option("--seed", settings->seed, seed_value(), "Another seed gives other masks.");
  verb.arguments.option("--out", settings->out, folder_path(), "The folder to write; made if missing.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
