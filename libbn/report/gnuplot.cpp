// Every figure of the toolkit is drawn from here: those of the page (plot.cpp), and those that stand as
// files.
//
// Scripts come through stdin. Those of figures are left beside their data too, whole, so that whoever has
// installed gnuplot since, or wants another look, runs them by hand.

#include "report/gnuplot.h"

#include <fmt/format.h>

#include <chrono>

#include "bn/report.h"
#include "bn/texture.h"
#include "report/child_process.h"

namespace bn {
namespace report {
namespace {

constexpr std::chrono::seconds kTimeLimit{60};

constexpr std::string_view kLook =
#include "report/figures.gnuplot.inc"
    ;

}  // namespace

GnuplotResult run_gnuplot(std::string_view script, const std::filesystem::path& folder,
                          std::stop_token stop) {
  const auto gnuplot = find_program("gnuplot");
  if (!gnuplot)
    return {.output = {}, .failure = "gnuplot is not installed (Debian: apt-get install gnuplot-nox)"};
  // -d: no settings of the user's.
  ChildResult run = run_child(*gnuplot, {"-d", "-"}, script, kTimeLimit, stop, folder);
  throw_if_stopped({.stop = stop});
  if (!run.succeeded) return {.output = {}, .failure = "gnuplot " + run.failure};
  return {.output = std::move(run.output), .failure = {}};
}

}  // namespace report

std::string draw_figures(const std::filesystem::path& folder, std::string_view script,
                         const Execution& execution) {
  const std::string whole =
      fmt::format("# gnuplot {}, in this folder.\n{}\n{}", kFigureScript, report::kLook, script);
  write_text_file(folder / kFigureScript, whole);
  for (const std::string_view page : {"dark = 0\n", "dark = 1\n"}) {
    const std::string failure =
        report::run_gnuplot(std::string(page) + whole, folder, execution.stop).failure;
    if (!failure.empty()) return failure;
  }
  return "";
}

}  // namespace bn
