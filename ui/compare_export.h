// Runs as files: the CSV that bn study anneal writes, and their figures.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bn/execution.h"

namespace bn::ui {

/// What is exported of a run, copied so that the run may go on.
struct ExportedRun {
  std::string name;  ///< part of a file name: "1-exponential"
  std::string schedule;
  int radius = 0;
  std::int64_t proposals = 0;
  std::uint64_t seed = 0;
  double seconds = 0.0;
  std::int64_t energy = 0;
  std::int64_t optimum = 0;  ///< 0: none is known
  std::string trace_csv;
};

/// Writes runs.csv, trace_NAME.csv of each run, and their figures (bn/report.h, draw_figures()). Makes
/// `folder` if it is missing. Returns what was done, for the status line. Errors: io, cancelled.
std::string export_runs(const std::vector<ExportedRun>& runs, const std::filesystem::path& folder,
                        const Execution& execution = {});

}  // namespace bn::ui
