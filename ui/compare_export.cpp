#include "ui/compare_export.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bn/anneal.h"
#include "bn/texture.h"

namespace bn::ui {
namespace {

// The look of scripts/gnuplot/anneal.gp; columns of traces as AnnealTrace::csv() names them.
constexpr const char* kScript =
    R"(# The figures of a comparison: gnuplot compare.gp, in the folder of its CSV files.
set datafile separator ","
set terminal svg size 760,480 dynamic enhanced font "sans-serif,13" background "white"
set style line 1 lc rgb "#0072b2" lw 2
set style line 2 lc rgb "#d55e00" lw 2
set style line 3 lc rgb "#009e73" lw 2
set style line 4 lc rgb "#cc79a7" lw 2
set style line 5 lc rgb "#e69f00" lw 2
set style line 6 lc rgb "#56b4e9" lw 2
set grid lc rgb "#dddddd"
set key outside right top
set border 3
set tics nomirror
set format x "%.1e"
set xtics rotate by -30
set xlabel "proposals"
set logscale y
runs = "{}"
file(i) = "trace_".word(runs, i).".csv"
style(i) = (i - 1) % 6 + 1

set output "energy.svg"
set title "Energy during the runs"
set ylabel "energy"
plot for [i=1:words(runs)] file(i) using 1:4 every ::2 with lines ls style(i) title word(runs, i), \
  for [i=1:words(runs)] file(i) using 1:($6>0?$6:1/0) every ::2 with lines ls style(i) dt 2 notitle
set output "temperature.svg"
set title "Temperature during the runs"
set ylabel "temperature"
plot for [i=1:words(runs)] file(i) using 1:($3>0?$3:1/0) every ::1 with lines ls style(i) title word(runs, i)
set output "acceptance.svg"
set title "Accepted share of all proposals"
set ylabel "accepted share"
plot for [i=1:words(runs)] file(i) using 1:($7>0?$7:1/0) every ::2 with lines ls style(i) title word(runs, i)
)";

/// Whether gnuplot ran well in `folder`; a missing one did not.
bool run_gnuplot(const std::filesystem::path& folder) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  char program[] = "gnuplot", script[] = "compare.gp";
  char* const arguments[] = {program, script, nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 1;
  return failed == 0 && waitpid(child, &status, 0) == child && status == 0;
}

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
  std::string script = kScript;
  script.replace(script.find("{}"), 2, names);
  write_text_file(folder / "compare.gp", script);
  const std::string done = fmt::format("Exported {} runs into {}", runs.size(), folder.string());
  return run_gnuplot(folder) ? done + ": CSV and SVG"
                             : done + ": CSV; for the figures install gnuplot and run compare.gp there";
}

}  // namespace bn::ui
