// The page of a validation study: for each scene what its figures say, tables, curves and pictures.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bn/report.h"
#include "bn/texture.h"
#include "report/html.h"
#include "report/page.h"
#include "report/study_parts.h"

namespace bn {
namespace {

namespace fs = std::filesystem;
using report::Csv;
using report::Curve;
using report::distinct;
using report::Plot;
using report::PlotStyle;
using report::Role;
using report::Study;

/// The methods that plots show, a colour each; white noise is the line at 0 dB.
std::vector<std::string> plotted_variants(const Study& study, const std::string& scene) {
  // One of each sort first: there are more methods than colours.
  constexpr std::string_view kOrder[] = {
      "retarget",      "mask-moved",       "both",        "slices",     "sort", "reproject",
      "retarget-both", "retarget-slices",  "mask-golden", "mask-still", "stbn", "filtered",
      "retarget-stbn", "retarget-filtered"};
  std::vector<std::string> variants = distinct(study.errors, "variant", scene);
  std::vector<std::string_view> chosen;
  for (const std::string_view name : kOrder) {
    const bool there = std::find(variants.begin(), variants.end(), name) != variants.end();
    if (there && std::ssize(chosen) < report::kCurveColours) chosen.push_back(name);
  }
  std::erase_if(variants, [&](const std::string& name) {
    return std::find(chosen.begin(), chosen.end(), name) == chosen.end();
  });
  return variants;
}

/// Power by frequency at the last frame, against white noise's variance.
Plot radial_plot(const Study& study, const std::string& scene, const std::string& region,
                 const std::string& frame) {
  double white = std::nan("");
  const Csv& errors = study.errors;
  for (std::size_t row = 0; row < errors.rows(); ++row) {
    if (errors.text(row, "scene") == scene && errors.text(row, "variant") == "white" &&
        errors.text(row, "region") == region && errors.text(row, "frame") == frame)
      white = errors.number(row, "rmse");
  }
  Plot plot{PlotStyle::error_power, scene + "-radial", "frequency_cycles_per_pixel", "power_db", {}};
  plot.curves.push_back({"white noise", Role::white, 0, {0.0, 0.7071}, {0.0, 0.0}});
  int colour = 0;
  for (const std::string& variant : plotted_variants(study, scene)) {
    Curve curve{variant, Role::texture, colour++, {}, {}};
    const Csv& radial = study.radial;
    for (std::size_t row = 0; row < radial.rows(); ++row) {
      if (radial.text(row, "scene") != scene || radial.text(row, "variant") != variant ||
          radial.text(row, "region") != region || radial.text(row, "frame") != frame)
        continue;
      curve.x.push_back(radial.number(row, "frequency"));
      curve.y.push_back(10.0 * std::log10(radial.number(row, "power") / (white * white)));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// Low-frequency error by frame, against the mean of white noise's.
Plot frames_plot(const Study& study, const std::string& scene, const std::string& region) {
  std::map<std::string, Curve> powers;
  double white = 0.0;
  int white_frames = 0;
  const Csv& errors = study.errors;
  for (std::size_t row = 0; row < errors.rows(); ++row) {
    if (errors.text(row, "scene") != scene || errors.text(row, "region") != region) continue;
    const double power = errors.number(row, "power_to_0.1") - errors.number(row, "reference_power_to_0.1");
    if (errors.text(row, "variant") == "white") {
      white += power;
      ++white_frames;
    }
    Curve& curve = powers[errors.text(row, "variant")];
    curve.x.push_back(errors.number(row, "frame"));
    curve.y.push_back(power);
  }
  Plot plot{PlotStyle::error_frames, scene + "-frames", "frame", "low_frequency_error_db", {}};
  double last = 1.0;
  int colour = 0;
  std::vector<Curve> curves;
  for (const std::string& variant : plotted_variants(study, scene)) {
    Curve curve = powers[variant];
    curve.name = variant;
    curve.role = Role::texture;
    curve.colour = colour++;
    for (double& y : curve.y) y = y > 0.0 ? 10.0 * std::log10(y / (white / white_frames)) : std::nan("");
    if (!curve.x.empty()) last = std::max(last, curve.x.back());
    curves.push_back(std::move(curve));
  }
  plot.curves.push_back({"white noise", Role::white, 0, {0.0, last}, {0.0, 0.0}});
  plot.curves.insert(plot.curves.end(), curves.begin(), curves.end());
  return plot;
}

/// In how many scenes each method is the best or within the scatter of it: the study in one sentence.
std::string overall(const std::map<std::string, int>& wins, std::size_t scenes) {
  std::vector<std::pair<std::string, int>> order(wins.begin(), wins.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  if (order.empty()) return "";
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i)
    text +=
        fmt::format("{}<b>{}</b> ({})", i == 0 ? "" : ", ", report::escaped(order[i].first), order[i].second);
  return fmt::format(
      "<p class=\"verdict\">Best, or within about {} dB of it, in how many of {} scene{}: {}.</p>\n",
      report::kScatter_db, scenes, scenes == 1 ? "" : "s", text);
}

/// A section, and what its methods add to `wins`.
report::Section scene_section(const Study& study, const report::StudyScene& scene, const fs::path& folder,
                              std::map<std::string, int>& wins, std::string& kind,
                              std::vector<std::string>& notes) {
  const std::string& name = scene.name;
  const std::vector<std::string> regions = distinct(study.summary, "region", name);
  const std::vector<report::MethodRow> rows = report::rows_of(study, name);
  // The first region that the scene names; the whole picture stands before it.
  const std::size_t index = regions.size() > 1 ? 1 : 0;
  const std::string& region = regions[index];
  const std::string last = distinct(study.errors, "frame", name).back();
  const report::MethodRow* best = report::best_of(rows, index);
  for (const report::MethodRow& row : rows) {
    if (best != nullptr && row.db[index] <= best->db[index] + report::kScatter_db) ++wins[row.name];
  }
  kind = report::short_verdict(rows, region, index);
  report::Section section;
  section.plots = {radial_plot(study, name, region, last), frames_plot(study, name, region)};
  section.html =
      fmt::format(
          "<h2>{}</h2>\n<p class=\"about\">{} Converged pictures: {} paths a pixel, own RMSE {}.</p>\n",
          report::escaped(name), report::escaped(scene.about), report::whole(study.reference_paths),
          report::number(scene.reference_rmse)) +
      report::verdict_html(rows, region, index) +
      report::frames_html(name, best == nullptr ? "retarget" : best->name, folder) +
      report::methods_table(rows, regions, scene) + "<div class=\"plots\">" +
      report::plot_figure(section.plots[0], 0, "Radial power",
                          fmt::format("of the error in region “{}” at frame {}, dB.", report::escaped(region),
                                      report::escaped(last))) +
      report::plot_figure(section.plots[1], 1, "Low frequencies by frame",
                          fmt::format("f ≤ 0.1 in region “{}”, dB.", report::escaped(region))) +
      "</div>\n" + report::sheets_html(study, name, region, folder, notes) + report::pass_table(study, name);
  return section;
}

}  // namespace

void write_study_report(const fs::path& study_folder, const fs::path& out, const Execution& execution) {
  check_text_writable(out);
  const Study study(study_folder);
  report::Page page;
  page.title = "Validation";
  std::map<std::string, int> wins;
  const std::vector<std::string> shown = distinct(study.summary, "scene", "");
  for (const report::StudyScene& scene : study.scenes) {
    if (std::find(shown.begin(), shown.end(), scene.name) == shown.end()) continue;
    throw_if_stopped(execution);
    page.names.push_back(scene.name);
    page.kinds.emplace_back();
    page.sections.push_back(scene_section(study, scene, study_folder, wins, page.kinds.back(), page.notes));
  }
  page.introduction = fmt::format(
      "{} × {} pixels, one path a pixel, {} bounces, {} frames, sort blocks of {} × {}, on {}. dB: error at "
      "0 "
      "&lt; <i>f</i> ≤ 0.1 cycles/pixel against white noise's, over frames {} to {}, the converged picture's "
      "own "
      "error taken off; about 1 dB is scatter. The other figures are of the whole picture at the last frame: "
      "error (RMSE), after a blur of 1.5 pixels, change of the blurred error from frame to frame along the "
      "motion (flicker), error of the exponential average over time (0.1 of each new frame), and of that "
      "average after the blur. Less is better everywhere.",
      study.width, study.height, study.bounces, study.frames + 1, study.block, study.block,
      report::escaped(study.device), study.first_counted, study.frames);
  page.preface = overall(wins, page.sections.size());
  page.appendix = report::method_words(study);
  std::vector<Plot> plots;
  for (const auto& section : page.sections)
    plots.insert(plots.end(), section.plots.begin(), section.plots.end());
  const report::Drawing drawing = report::draw(plots, execution.stop);
  if (!drawing.failure.empty()) page.notes.push_back("No plots: " + drawing.failure);
  write_text_file(out, report::page_html(page, drawing.svg));
}

}  // namespace bn
