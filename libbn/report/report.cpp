// The report: collect, look at each texture, draw all plots at once, put the page together, write.
//
// Whatever can fail for reasons outside (an output that cannot be written) is checked before the work.

#include "bn/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "bn/error.h"
#include "bn/texture.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/section.h"
#include "report/sources.h"

namespace bn {
namespace {

namespace fs = std::filesystem;

void check_options(const ReportOptions& options) {
  if (options.inputs.empty()) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "no files or folders",
                 .where = "inputs",
                 .limit = "at least one",
                 .remedy = ""});
  }
  check_text_writable(options.out);
  if (options.csv_dir.empty()) return;
  // The folder is made when there is something to put into it; until then its name must be as free as a
  // file's.
  std::error_code ignored;
  const bool exists = fs::is_directory(options.csv_dir, ignored);
  const fs::path bare = options.csv_dir.has_filename() ? options.csv_dir : options.csv_dir.parent_path();
  check_text_writable(exists ? options.csv_dir / "curves.csv" : bare);
  if (!exists && fs::exists(bare, ignored)) {
    throw Error({.code = ErrorCode::io,
                 .what = "is no folder",
                 .where = options.csv_dir.string(),
                 .limit = "",
                 .remedy = "choose another folder"});
  }
}

/// A name for files: letters and digits of `name`, the rest as single hyphens; never one that is in `taken`.
std::string file_name_for(const std::string& name, std::set<std::string>& taken) {
  std::string base;
  for (const char c : name.substr(name.size() > 80 ? name.size() - 80 : 0)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (plain) {
      base += c;
    } else if (!base.empty() && base.back() != '-') {
      base += '-';
    }
  }
  while (!base.empty() && base.back() == '-') base.pop_back();
  if (base.empty()) base = "texture";
  std::string result = base;
  for (int i = 2; !taken.insert(result).second; ++i) result = fmt::format("{}-{}", base, i);
  return result;
}

/// All textures' curves over each other. Six can be told apart; of more, the five of the lowest grades have
/// colours of their own and the others are one pale band of lines.
void add_common_plots(report::Page& page, const report::Reference& reference) {
  page.common_power = report::power_plot("compare-power", reference);
  page.common_anisotropy = report::anisotropy_plot("compare-anisotropy", reference);
  page.common_anisotropy.wide = true;
  std::vector<const report::Section*> shown;
  for (const report::Section& section : page.sections) {
    if (!section.card.empty()) shown.push_back(&section);
  }
  const bool many = shown.size() > report::kCurveColours;
  std::vector<const report::Section*> named = shown;
  if (many) {
    std::stable_sort(named.begin(), named.end(), [](auto* a, auto* b) {
      return (std::isnan(a->grade) ? -1.0 : a->grade) < (std::isnan(b->grade) ? -1.0 : b->grade);
    });
    named.resize(report::kCurveColours - 1);
    page.common_caption = fmt::format(" In colour the {} of the lowest grades, in pale violet the other {}.",
                                      named.size(), shown.size() - named.size());
  }
  for (const auto& [which, plot] :
       {std::pair(0, &page.common_power), std::pair(1, &page.common_anisotropy)}) {
    if (many) {
      report::Curve others{
          fmt::format("{} others", shown.size() - named.size()), report::Role::others, 0, {}, {}};
      for (const report::Section* section : shown) {
        if (std::find(named.begin(), named.end(), section) != named.end()) continue;
        const report::Curve& curve = section->plots[static_cast<std::size_t>(which)].curves.back();
        others.x.insert(others.x.end(), curve.x.begin(), curve.x.end());
        others.y.insert(others.y.end(), curve.y.begin(), curve.y.end());
        others.x.push_back(curve.x.empty() ? 0.0 : curve.x.back());  // a gap between two textures
        others.y.push_back(std::nan(""));
      }
      plot->curves.push_back(std::move(others));
    }
    int colour = 0;
    for (const report::Section* section : named) {
      plot->curves.push_back(section->plots[static_cast<std::size_t>(which)].curves.back());
      plot->curves.back().colour = colour++;
    }
  }
}

}  // namespace

ReportSummary write_report(const ReportOptions& options, const Execution& execution) {
  check_options(options);
  Execution quiet = execution;
  quiet.progress = {};
  report::Collection found = report::collect(options, quiet);
  const std::size_t textures = found.textures.size(), sets = found.retarget_sets.size();
  if (textures + sets == 0) {
    if (found.first_fault) throw Error(*found.first_fault);
    throw Error({.code = ErrorCode::invalid_input,
                 .what = found.notes.empty() ? "nothing to report on" : found.notes.front(),
                 .where = found.notes.empty() ? options.inputs.front().string() : "",
                 .limit = "",
                 .remedy = "name textures, or folders that hold some"});
  }

  report::Page page;
  page.compare = options.compare;
  page.notes = found.notes;
  page.sections.resize(textures + sets);
  ReportSummary summary;
  std::set<std::string> taken;
  std::vector<std::string> file_names;
  for (const auto& texture : found.textures) {
    const bool volume = texture.shape.depth > 1;
    page.names.push_back(texture.name);
    page.kinds.push_back(volume ? "volume" : "texture");
    ++(volume ? summary.volumes : summary.masks);
    file_names.push_back(file_name_for(texture.name, taken));
  }
  for (const auto& set : found.retarget_sets) {
    page.names.push_back(set.name);
    page.kinds.push_back("retarget set");
    file_names.push_back(file_name_for(set.name, taken));
  }
  summary.retarget_sets = static_cast<int>(sets);

  // Sections side by side; each on one thread.
  const report::Reference reference = report::make_reference(quiet);
  Execution single = quiet;
  single.threads = 1;
  parallel_for(execution, static_cast<std::int64_t>(page.sections.size()), [&](std::int64_t index) {
    const auto i = static_cast<std::size_t>(index);
    page.sections[i] =
        i < textures
            ? report::texture_section(found.textures[i], reference, file_names[i], single)
            : report::retarget_section(found.retarget_sets[i - textures], reference, file_names[i], single);
  });
  if (options.compare) add_common_plots(page, reference);

  std::vector<report::Plot> plots;
  for (const report::Section& section : page.sections) {
    plots.insert(plots.end(), section.plots.begin(), section.plots.end());
    summary.failed += section.failed;
    summary.weak += section.weak;
    summary.not_judged += section.not_judged;
  }
  if (options.compare) {
    plots.push_back(page.common_power);
    plots.push_back(page.common_anisotropy);
  }
  const report::Drawing drawing = report::draw(plots, execution.stop);
  throw_if_stopped(execution);
  if (!drawing.failure.empty()) page.notes.push_back("No plots: " + drawing.failure);
  if (!options.csv_dir.empty()) make_folder(options.csv_dir);
  write_text_file(options.out, report::page_html(page, drawing.svg));

  if (!options.csv_dir.empty()) {
    for (const report::Plot& plot : plots) {
      write_text_file(options.csv_dir / (plot.file_name + ".csv"), report::to_csv(plot));
    }
    for (const report::Section& section : page.sections) {
      for (const auto& [name, csv] : section.tables) write_text_file(options.csv_dir / (name + ".csv"), csv);
    }
  }
  summary.notes = page.notes;
  return summary;
}

}  // namespace bn
