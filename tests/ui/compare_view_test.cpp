// Protects: runs are held against each other by the library's figures, and exported as it writes them,
// through the real program without a display.

#include <cstdio>
#include <fstream>
#include <sstream>

#include "bn/bake.h"
#include "bn/noise.h"
#include "bn/palette.h"
#include "ui/inspector.h"

namespace bn::ui {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(CompareView, MarksTheBestAndSortsByColumns) {
  const Workplace here;
  const Outcome outcome = here.script(R"(
key ctrl+2
wait 3
click "Go to Run"
wait 3
expect Run = on
set Proposals 1e7
click Start
wait-for State = finished
set Proposals 1e5
click Start
wait-for State = finished
key ctrl+2
wait-for "Gap 2" contains %
expect "Energy 1" contains best
expect "Row 1" = 1
click "Sort by Gap"
wait 3
expect "Row 1" = 1
click "Sort by Gap"
wait 3
expect "Row 1" = 2
click "Sort by Proposals"
wait 3
expect "Row 1" = 2
click "B 1"
wait 3
expect "B 1" = on
choose B "#2 exponential"
wait 3
expect "B 2" = on
expect "Energies cursor" gone
)");
  expect_success(outcome);
}

TEST(CompareView, HoldsRunsAgainstEachOtherAndExportsThem) {
  const Workplace here;
  expect_success(here.script(R"(wait 2
set Proposals 1e7
click Start
wait-for State = finished
choose Schedule kirkpatrick
click Start
wait-for State = finished
key ctrl+2
wait-for "Energy 2" > 0
wait-for "Gap 1" contains %
expect "A 1" = on
expect "B 2" = on
expect Energies contains "2 curves"
click "Energies: #1 exponential"
expect "Energies: #1 exponential" = off
expect Energies contains "1 curves"
expect "Picture A" = "64 × 64"
click Flip
wait 3
expect "Shown picture" contains "A: #1"
key x
wait 3
expect "Shown picture" contains "B: #2"
click Split
wait 3
expect "Shown picture" contains "|"
screenshot compare.png
click "Export …"
set Path )" + here.path("out") +
                             R"(
click "Take this folder"
wait-for Status contains Exported
click "Remove 1"
wait-for "Energy 1" gone
)"));
  AnnealProblem problem;
  problem.channels = {
      {levels_of_channel(encode_mask(void_and_cluster({.size = {64, 64}}), SampleType::u8), 0).value}};
  problem.retarget.step = auto_step({64, 64}).step;
  std::string runs = "schedule,radius,proposals,seed,seconds,energy\n";
  const std::string written = text_of(here / "out/runs.csv");
  EXPECT_TRUE(written.starts_with(runs)) << written;
  for (const char* schedule : {"exponential", "kirkpatrick"}) {
    AnnealOptions options;
    options.schedule = schedule;
    options.proposals = 10'000'000;
    const std::string energy = std::to_string(anneal_retarget(problem, options).tile.energy);
    EXPECT_NE(written.find("," + energy + "\n"), std::string::npos) << written;
  }
  const std::string trace = text_of(here / "out/trace_1-exponential.csv");
  std::string columns = AnnealTrace().csv();  // those of every trace, and a line's end
  columns.pop_back();
  EXPECT_TRUE(trace.starts_with(columns)) << trace.substr(0, 100);
  EXPECT_GT(std::count(trace.begin(), trace.end(), '\n'), 100);
  EXPECT_TRUE(std::filesystem::exists(here / "out/figures.gp"));
  // Where gnuplot is there, schedules have their colours.
  if (std::filesystem::exists(here / "out/energy.svg")) {
    const std::string figure = text_of(here / "out/energy.svg");
    for (const int number : {schedule_colour_number("exponential"), schedule_colour_number("kirkpatrick")}) {
      const Rgb8 colour = kCurvePalette[static_cast<std::size_t>(number)];
      char words[32];
      std::snprintf(words, sizeof words, "rgb(%3d, %3d, %3d)", colour.red, colour.green, colour.blue);
      EXPECT_NE(figure.find(words), std::string::npos) << words;
    }
  }
  const Image shot = read_image(here / "compare.png").image;
  EXPECT_GT(contrast(shot, {0.55, 0.45, 0.95, 0.9}), 50.0) << "the split picture";
}

}  // namespace
}  // namespace bn::ui
