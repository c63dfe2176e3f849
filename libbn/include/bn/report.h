// bn/report.h - floor 3: one page that shows textures, and how good they are.
//
// The page is one HTML file without network, script or clock: pictures are embedded PNG, plots are inline SVG
// drawn by gnuplot. Equal files give equal bytes with one version of gnuplot and of the libraries.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "bn/judgement.h"
#include "bn/texture.h"

namespace bn {

/// How a texture is judged where nobody says: a picture as a blue-noise mask, a volume as one that is blue in
/// space and time. But a volume of the preset `filtered` is made for the blurred and averaged picture, and no
/// series of one pixel is meant to be blue: its slices are judged as masks.
Check natural_check(Shape shape, const std::optional<Metadata>& metadata);

struct ReportOptions {
  /// Files, and folders that are searched for textures (in name order, links to folders not followed). A
  /// folder's manifest.json, where there is one, tells which files are encodings of one texture and how long
  /// each job took.
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path out;  ///< the page
  std::filesystem::path csv_dir =
      {};                ///< empty, or the folder for one CSV file a plot; made if its parent exists
  bool compare = false;  ///< begin with all textures side by side and their curves in common plots
  /// The inputs are volumes, as read_volume() takes them: each folder is one; all files given by name are the
  /// slices of one more.
  bool volume = false;
};

/// What came of it, for the command line.
struct ReportSummary {
  int masks = 0;
  int retarget_sets = 0;
  int volumes = 0;
  int failed = 0;      ///< textures that miss a threshold or repeat a channel, sets that are not as recorded
  int weak = 0;        ///< textures that pass with a grade below kGoodGrade (bn/judgement.h)
  int not_judged = 0;  ///< pictures that do not say they are masks, and textures too small to judge
  std::vector<std::string>
      notes;  ///< files that could not be read, plots that could not be drawn; also in the page
};

/// Most textures in one page, and most files read for it; a page of more would open in no browser.
inline constexpr int kMaxReportTextures = 200;
inline constexpr int kMaxReportFiles = 20000;

/// Writes the page, crash-safely. Plots need gnuplot in PATH: without it, and where it fails or takes over 60
/// s, the page has tables and pictures and says so. Errors: io (`out` or `csv_dir` cannot be written, which
/// is checked first); if no input can be read, the first one's error; invalid_input (no inputs, or nothing in
/// them that is a texture), over_limit, cancelled. What cannot be read while something else can is a note, no
/// error. Threads: execution.threads; any number gives the same bytes.
ReportSummary write_report(const ReportOptions& options, const Execution& execution = {});

/// The page of a validation study (`bn validate`), made of the files in its folder: tables,
/// curves and pictures of each scene. Without gnuplot it lacks the curves and says so. Errors: io,
/// invalid_input (no study there), cancelled.
void write_study_report(const std::filesystem::path& study, const std::filesystem::path& out,
                        const Execution& execution = {});

// --- figures as files ------------------------------------------------------------------------------

/// What draw_figures() leaves beside the data.
inline constexpr const char* kFigureScript = "figures.gp";

/// Writes `script` behind the common look of figures (SVG; line styles 1..7) into `folder` as kFigureScript
/// and has gnuplot run it there, twice: `set output figure("x")` makes x.svg for light pages and x-dark.svg
/// for dark ones. Returns why there are no figures, "gnuplot is not installed ..." for one, or
/// nothing if they stand: data without figures are no error. Ended after 60 s. Names in `script` are the
/// caller's to quote. Errors: io, cancelled.
std::string draw_figures(const std::filesystem::path& folder, std::string_view script,
                         const Execution& execution = {});

}  // namespace bn
