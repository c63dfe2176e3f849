// Protects: who anneals in the inspector, through the real program without a display, sees the library's
// figures, saves what bn verify proves, and gets a message where there is nothing to do.

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "bn/bake.h"
#include "bn/error.h"
#include "bn/noise.h"
#include "ui/inspector.h"

namespace bn::ui {
namespace {

void expect_success(const Outcome& outcome) { EXPECT_EQ(outcome.exit_code, 0) << outcome.output; }

/// The number after "NAME: " in what `print NAME` wrote.
std::int64_t printed(const Outcome& outcome, const std::string& name) {
  const std::size_t at = outcome.output.find(name + ": ");
  return at == std::string::npos ? -1 : std::atoll(outcome.output.c_str() + at + name.size() + 2);
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Runs, saves, and holds all of it against the library.
void expect_a_proven_run(const std::string& choose_image, const AnnealProblem& problem) {
  const Workplace here;
  const Outcome outcome = here.script("wait 2\n" + choose_image + R"(
set Proposals 2e7
set Seed 7
click Start
wait-for State = finished
wait-for Gap contains %
print Energy
print Optimum
click "Save texture …"
set Path )" + here.path("tile.png") + R"(
click Save
wait-for Status contains Saved
hover Status 0.9 0.5
wait 5
screenshot shot.png
)");
  expect_success(outcome);
  AnnealOptions options;
  options.proposals = 20'000'000;
  options.seed = 7;
  const AnnealResult expected = anneal_retarget(problem, options);
  EXPECT_EQ(printed(outcome, "Energy"), expected.tile.energy);
  EXPECT_EQ(printed(outcome, "Optimum"), solve_retarget(problem.channels[0].levels, problem.retarget).energy);

  for (const VerifyItem& item : verify_path(here / "tile.png"))
    EXPECT_TRUE(item.pass) << item.check << item.detail;
  const FileContent tile = read_image(here / "tile.png");
  EXPECT_EQ(decode_moves(tile.image), expected.tile.move);
  EXPECT_EQ(tile.metadata->tiles.at(0).energy, expected.tile.energy);

  // What the file says of itself makes it again.
  bake(parse_recipe(tile.metadata->recipe, "embedded", here / ""), {.out_dir = here / "again"});
  EXPECT_EQ(read_image(here / "again/tile.png").metadata->pixel_hash, tile.metadata->pixel_hash);

  const Image shot = read_image(here / "shot.png").image;
  ASSERT_EQ(shot.size, (Extent{1280, 800}));
  EXPECT_GT(contrast(shot, {0.02, 0.08, 0.26, 0.9}), 10.0) << "the settings";
  EXPECT_GT(contrast(shot, {0.30, 0.30, 0.41, 0.48}), 50.0) << "the permuted mask";
  EXPECT_GT(contrast(shot, {0.72, 0.30, 0.83, 0.48}), 20.0) << "the offsets";
  EXPECT_GT(contrast(shot, {0.86, 0.30, 0.97, 0.48}), 20.0) << "the spectrum";
  EXPECT_GT(contrast(shot, {0.33, 0.60, 0.50, 0.71}), 5.0) << "the energy";
  EXPECT_GT(contrast(shot, {0.55, 0.79, 0.93, 0.92}), 5.0) << "the acceptance surface";
}

TEST(RunView, AnnealsABakedMaskAndSavesWhatIsProven) {
  AnnealProblem problem;
  const Image mask = encode_mask(void_and_cluster({.size = {64, 64}, .seed = 3}), SampleType::u8);
  problem.channels = {{levels_of_channel(mask, 0).value}};
  problem.retarget.step = auto_step({64, 64}).step;
  expect_a_proven_run("set \"Mask seed\" 3\n", problem);
}

TEST(RunView, AnnealsTheReferenceImageAndSavesWhatIsProven) {
  const std::string path = BN_TEST_DATA "/peters_cc0_64_LDR_RGBA_0.png";
  AnnealProblem problem;
  problem.channels = {{levels_of_channel(read_image(path).image, 0).value}};
  problem.retarget.step = {48, 36};
  expect_a_proven_run("click \"From: File\"\nset \"Image file\" " + path +
                          "\nclick \"Auto step\"\nset \"Step x\" 48\nset \"Step y\" 36\n",
                      problem);
}

TEST(RunView, EveryConstantOfAScheduleIsTheUsersAndTheLibraryJudgesIt) {
  const Workplace here;
  expect_success(here.script(R"s(wait 2
wait-for Where contains "a = 1 − "
expect "Factor a" contains "auto: 1 − "
set "Factor a" 0.999999
wait-for Where contains "a = 1 − 1e-6"
set "Factor a" 1.5
wait-for Refused contains "factor: 1.5 (allowed: above 0, at most 1)"
expect Formula gone
click Start
wait-for Error contains "factor: 1.5"
expect State = "no run yet"
click Dismiss
key ctrl+z
wait-for "Factor a" = 0.999999
wait-for Refused gone
set "End T" 0.5
wait-for Refused contains "one of the two"
set "End T" ""
wait-for Refused gone

choose Schedule kirkpatrick
wait-for Stages = "auto: 100"
expect "Factor a" contains auto
set "Factor a" 0.9
set Stages 50
set "Accepted cap" 1000
set "Tried cap" 1e5
set "Frozen after" 2
wait-for Where contains "a = 0.9"
expect Where contains "a stage ends after 1000 accepted or 1e5 tried"
expect Where contains "the run ends after 2 stages without a change"
set Stages 0
wait-for Refused contains "1..1000000"
set Stages 20

choose Schedule hajek
wait-for Formula = "T(k) = c / ln(k + 2)"
set "Constant c" 3
wait-for Where = "c = 3"
choose Schedule linear
wait-for "Slope μ" contains auto
set "Slope μ" -1
wait-for Refused contains "slope: -1"
set "Slope μ" ""
click "Start: T"
set "Start T" -1
wait-for Refused contains "above 0, finite"
set "Start T" 4
set "End T" 5
wait-for Refused contains "at most 4"
set "End T" 0.25
wait-for Where contains "start = 4, end = 0.25"
click "Start: Accept"
set Acceptance 0.9999
wait-for Refused contains "0.001..0.999"
set Acceptance 0.5
wait-for Refused gone
click "Start: All"
wait-for Where contains "start = 510"
click "Metric: Blurred"
wait-for Refused contains "accept everything"
click "Metric: L1"
set Proposals 0
wait-for Refused contains "1..2^62"
set Proposals 1e6
wait-for Refused gone
)s",
                             "--session s.json"));
  // Each schedule keeps its own, from session to session.
  expect_success(here.script(R"s(wait 2
expect Schedule = linear
expect "End T" = 0.25
choose Schedule kirkpatrick
wait-for "Factor a" = 0.9
expect Stages = 20
expect "Tried cap" = 100000
choose Schedule exponential
wait-for "Factor a" = 0.999999
)s",
                             "--session s.json"));
}

TEST(RunView, APlanMayBeLookedAtFromAnyDistance) {
  const Workplace here;
  // Zoomed in far, its dashed line is longer than floats of pixels can count.
  expect_success(here.script(R"s(wait 2
wait-for Where contains "a ="
wheel "Temperature plot" 8
wheel "Temperature plot" 8
wheel "Temperature plot" 8
wheel "Temperature plot" 40
wait 3
wheel "Temperature plot" -200
wait 3
click "Start: T"
set "Start T" 1e300
set "Factor a" 0.001
wait 20
wheel "Temperature plot" 30
wait 3
expect State = "no run yet"
)s"));
}

/// A tile that the window saved passes bn verify, and what it says of itself makes it again.
void expect_it_is_made_again(const Workplace& here, const std::string& name,
                             const std::vector<std::string>& recipe_says) {
  for (const VerifyItem& item : verify_path(here / name)) EXPECT_TRUE(item.pass) << item.check << item.detail;
  const Metadata saved = read_image(here / name).metadata.value();
  EXPECT_EQ(saved.algorithm, "retarget-anneal");
  for (const std::string& line : recipe_says)
    EXPECT_NE(saved.recipe.find(line), std::string::npos) << line << " in\n" << saved.recipe;
  bake(parse_recipe(saved.recipe, "embedded", here / ""), {.out_dir = here / "again"});
  EXPECT_EQ(read_image(here / ("again/" + name)).metadata->pixel_hash, saved.pixel_hash);
}

TEST(RunView, SavesFilteredResidualsAndOwnConstants) {
  const Workplace here;
  expect_success(here.script(R"s(wait 2
click "Metric: Blurred"
set Proposals 2e6
choose Schedule kirkpatrick
set "Factor a" 0.9
set "Tried cap" 20000
click Start
wait-for State = finished
click "Save texture …"
set Path blurred.png
click Save
wait-for Status contains Saved
)s"));
  expect_it_is_made_again(
      here, "blurred.png",
      {"residual_sigma = 1.0", "metric = \"l2\"", "factor = 0.9", "tried_per_stage = 20000"});
}

TEST(RunView, SavesTheBestOfARunThatIsPausedOrStopped) {
  const Workplace here;
  expect_success(here.script(R"s(wait 2
set Proposals 1e12
click Start
wait-for Speed > 1e6
expect "Save texture …" disabled
click Pause
wait-for State = paused
wait-for "Save texture …" enabled
click "Save texture …"
set Path paused.png
click Save
wait-for Status contains "of 1e12 proposals"
click "Go on"
wait-for State = running
click Stop
wait-for State = stopped
click "Save texture …"
set Path stopped.png
click Save
wait-for Status contains "stopped.png"
open stopped.png
wait-for Annealed contains "exponential, stopped after"
wait-for Verified contains pass
)s"));
  for (const char* name : {"paused.png", "stopped.png"})
    expect_it_is_made_again(here, name, {"proposals = 1000000000000", "stop_after = "});
}

TEST(RunView, PausesStepsRestartsAndStops) {
  const Workplace here;
  expect_success(here.script(R"(wait 2
set Proposals 1e13
click "One sweep"
wait-for State = paused
expect Progress contains "of 1e13 proposals"
click "One sweep"
wait-for State = paused
click "Go on"
wait-for State = running
wait-for Speed > 1e6
expect Left contains " "
click Pause
wait-for State = paused
expect Pause disabled
click Restart
wait-for State = running
click Stop
wait-for State = stopped
expect Stop disabled
click Start
wait-for State = running
key space
wait-for State = paused
key space
wait-for State = running
)"));
}

TEST(RunView, SaysWhyAConstantImageIsNotAnnealed) {
  const Workplace here;
  Image flat{.size = {16, 16}, .channels = 1, .type = SampleType::u8, .samples = std::vector<std::byte>(256)};
  Metadata metadata;
  metadata.algorithm = metadata.kind = "test";
  metadata.algorithm_version = 1;
  write_image(here / "flat.png", flat, metadata);
  expect_success(here.script(R"(wait 2
click "From: File"
set "Image file" flat.png
click Start
wait-for Error contains "constant"
expect State = "no run yet"
click "From: Bake"
click Start
wait-for State = finished
)"));
}

TEST(RunView, TellsWhatCannotBeReadAndLivesOn) {
  const Workplace here;
  std::ofstream(here / "text.png") << "no image";
  expect_success(here.script(R"(wait 2
click "From: File"
set "Image file" text.png
wait-for Error contains "text.png"
click Start
wait 5
expect State = "no run yet"
click "From: Bake"
set Proposals 1e6
click Start
wait-for State = finished
click "Save texture …"
set Path /proc/none/tile.png
click Save
wait-for Error contains "/proc/none"
)"));
}

TEST(RunView, TellsAFolderWithoutWriteAccessAndLivesOn) {
  namespace fs = std::filesystem;
  const Workplace here;
  fs::create_directory(here / "locked");
  fs::permissions(here / "locked", fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                       fs::perms::others_exec);
  fs::create_directory(here / "open");
  fs::permissions(here / "open", fs::perms::all);
  expect_success(here.script(R"s(wait 2
set Proposals 1e6
click Start
wait-for State = finished
click "Save texture …"
set Path locked/tile.png
click Save
wait-for Error contains "locked"
expect Error contains "ermission"
click Dismiss
key ctrl+2
click "Export …"
set Path locked
click "Take this folder"
wait-for Error contains "locked"
expect Error contains "ermission"
click Dismiss
wait-for "Export …" enabled
click "Export …"
set Path locked/new
click "Take this folder"
wait-for Error contains "locked/new"
click Dismiss
key f12
set Path locked/shot.png
click Save
wait-for Error contains "locked/shot.png"
click Dismiss
key ctrl+1
click "Save texture …"
set Path open/tile.png
click Save
wait-for Status contains Saved
expect Error gone
)s",
                             "", here.as_stranger()));
  EXPECT_TRUE(fs::is_empty(here / "locked"));
  for (const VerifyItem& item : verify_path(here / "open/tile.png")) EXPECT_TRUE(item.pass) << item.detail;
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
  const Image shot = read_image(here / "compare.png").image;
  EXPECT_GT(contrast(shot, {0.55, 0.45, 0.95, 0.9}), 50.0) << "the split picture";
}

}  // namespace
}  // namespace bn::ui
