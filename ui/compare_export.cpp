#include "ui/compare_export.h"

#include <fmt/format.h>

#include <string_view>

#include "bn/report.h"
#include "bn/texture.h"
#include "bn_study/anneal.h"

namespace bn::ui {
namespace {

constexpr std::string_view kFigures =
#include "ui/compare_runs.gnuplot.inc"
    ;

}  // namespace

std::string export_runs(const std::vector<ExportedRun>& runs, const std::filesystem::path& folder,
                        const Execution& execution) {
  make_folder(folder);
  std::string names;
  std::vector<AnnealStudyRun> table;
  for (const ExportedRun& run : runs) {
    throw_if_stopped(execution);
    table.push_back({run.schedule, run.radius, run.proposals, run.seed, run.seconds, run.energy});
    write_text_file(folder / ("trace_" + run.name + ".csv"), run.trace_csv);
    names += (names.empty() ? "" : " ") + run.name;
  }
  write_text_file(folder / "runs.csv", runs_csv(table));
  const std::string failure =
      draw_figures(folder, fmt::format("runs = \"{}\"\n{}", names, kFigures), execution);
  return fmt::format("Exported {} runs into {}: {}", runs.size(), folder.string(),
                     failure.empty() ? "CSV and SVG" : "CSV; no figures: " + failure);
}

}  // namespace bn::ui
