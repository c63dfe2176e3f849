// bn report: one page that shows textures, and how good they are.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "bn/report.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

struct Settings {
  ReportOptions options;
  bool json = false;
};

std::string verdict_of(const ReportSummary& summary) {
  const int judged = summary.masks + summary.retarget_sets + summary.volumes - summary.not_judged;
  std::string verdict = judged == 0           ? "none judged"
                        : summary.failed == 0 ? "all within their thresholds"
                                              : fmt::format("{} of {} fail", summary.failed, judged);
  if (summary.weak > 0) verdict += fmt::format(", {} weak", summary.weak);
  return judged == 0 || summary.not_judged == 0
             ? verdict
             : fmt::format("{}, {} not judged", verdict, summary.not_judged);
}

void run(const Settings& settings, Session& session) {
  const ReportSummary summary = write_report(settings.options, session.execution);
  if (settings.json) {
    session.output.write_result({{"report", settings.options.out.string()},
                                 {"textures", summary.masks},
                                 {"retarget_sets", summary.retarget_sets},
                                 {"volumes", summary.volumes},
                                 {"failed", summary.failed},
                                 {"weak", summary.weak},
                                 {"not_judged", summary.not_judged},
                                 {"notes", summary.notes}},
                                true);
    return;
  }
  for (const std::string& note : summary.notes) session.progress.note(note);
  const auto counted = [](int count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  session.output.tell(fmt::format("{}: {}, {}, {}; {}\n", settings.options.out.string(),
                                  counted(summary.masks, "texture"),
                                  counted(summary.retarget_sets, "retarget set"),
                                  counted(summary.volumes, "volume"), verdict_of(summary)));
}

}  // namespace

Verb report_verb() {
  const auto settings = std::make_shared<Settings>();
  ReportOptions& options = settings->options;
  Verb verb;
  verb.name = "report";
  verb.summary = "Make a page that shows textures and how good they are.";
  verb.examples = {{"bn report out -o report.html", "everything that a bake made"},
                   {"bn report ours.png theirs.png -o report.html --compare", "textures side by side"},
                   {"bn report --volume slices -o report.html", "a folder of slices as one volume"}};
  verb.details =
      "Writes one HTML file without network or script, for the screen, light and dark, and for paper. For "
      "each texture: "
      "pictures, spectrum, radial power and anisotropy, autocorrelation, histogram, thresholds, and figures "
      "of merit that "
      "pass or fail; for each retarget set its moves, residual, energies and proof, all recomputed; for "
      "volumes the "
      "spectrum in time. docs/report.md explains every part.\n\n"
      "Verdicts and grades are those of bn spectrum --check blue, for volumes stbn. A channel that is "
      "another one "
      "moved or repeated fails.\n\n"
      "Plots need gnuplot (Debian: gnuplot-nox). Without it the page has tables and pictures and says so. "
      "Files that "
      "cannot be read are named in the page; the exit code is 0 as long as one can. A texture that misses "
      "its thresholds "
      "is marked, which is no error either: bn spectrum --check is for that.";
  verb.arguments.positional_list("DIR|FILE", options.inputs, file_path(), "Folders to search and textures.");
  verb.arguments.required_option("--out", options.out, text_path(), "The page to write.", "-o");
  verb.arguments.flag("--compare", options.compare, true, "Begin with all textures side by side.");
  verb.arguments.flag("--volume", options.volume, true,
                      "Each folder, or all files together, is one volume of slices.");
  verb.arguments.option("--csv", options.csv_dir, folder_path(),
                        "Write every curve as CSV into this folder.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
