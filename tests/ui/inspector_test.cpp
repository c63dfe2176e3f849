// Protects: what a user of the inspector sees and gets, driven through the real program without a display.

#include "ui/inspector.h"

#include <fstream>
#include <sstream>

#include "bn/bake.h"
#include "bn/error.h"

namespace bn::ui {
namespace {

TEST(Inspector, BakesARecipeAndOpensItsResult) {
  const Workplace here;
  std::ofstream(here / "recipe.toml") << R"s(version = 1
[[mask]]
name = "mask"
size = [32, 32]
outputs = ["mask.png"]
[[retarget]]
name = "moves"
mask = "mask"
radius = 4
motion = 1
outputs = [{ path = "atlas.png", kind = "atlas" }]
)s";
  expect_success(here.script(R"s(
open recipe.toml
wait-for Bake enabled
expect Jobs = 3
expect "mask mask" = "to bake"
set "Into folder" baked
wait-for Bake enabled
click Bake
wait-for Status contains "Baked into baked"
expect "retarget moves" = baked
expect Progress contains "100 %"
wait-for "Contact sheet shown" = yes
screenshot bake.png
click "Read again"
wait-for "mask mask" = "up to date"
click atlas.png
wait-for Size = "32 × 32, 9 motions"
expect Columns = 3
expect Motion = "(0, 0)"
expect Optimum = proven
wait-for Verified contains pass
)s"));
  for (const VerifyItem& item : verify_path(here / "baked"))
    EXPECT_TRUE(item.pass) << item.check << item.detail;
  EXPECT_GT(contrast(read_image(here / "bake.png").image, {0.28, 0.1, 0.7, 0.4}), 10.0);
}

TEST(Inspector, TellsErrorsAndLivesOn) {
  const Workplace here;
  here.write_mask("mask.png", 32);
  write_image(here / "grey.png", {.size = {16, 16}, .channels = 1, .samples = std::vector<std::byte>(256)},
              {});
  std::ofstream(here / "broken.png") << "no image at all";
  std::ofstream(here / "bad.toml") << "version = 1\n[[mask]]\nsize = [0, 64]\n";
  std::ofstream(here / "good.toml")
      << "version = 1\n[[mask]]\nname = \"m\"\nsize = [8, 8]\noutputs = [\"m.png\"]\n";
  expect_success(here.script(R"s(
open broken.png
wait-for Error contains broken.png
click Dismiss
wait-for Error gone
open nowhere.png
wait-for Error contains nowhere.png
click Dismiss
open bad.toml
wait-for Error contains "bad.toml:3"
click Dismiss
open good.toml
wait-for Bake enabled
set "Into folder" broken.png/out        # a folder that cannot be made
wait-for Error contains broken.png
click Dismiss
open grey.png                            # constant: no spectrum, but a picture
wait-for Size = "16 × 16"
wait-for "Peak power" = 0
open mask.png
wait-for Name = mask.png
wait-for Verified contains pass
expect Error gone
)s"));
}

TEST(Inspector, UndoesAndRedoesChangesOfSettings) {
  const Workplace here;
  std::ofstream(here / "recipe.toml")
      << "version = 1\n[[mask]]\nname = \"m\"\nsize = [8, 8]\noutputs = [\"m.png\"]\n";
  expect_success(here.script(R"s(
open recipe.toml
wait-for Bake enabled
set Threads 3
wait-for Threads = 3
set Threads 5
wait-for Threads = 5
key ctrl+z
wait-for Threads = 3
key ctrl+z
wait-for Threads = 0
key ctrl+y
wait-for Threads = 3
)s"));
}

TEST(Inspector, HasMenusForViewsRecentFilesAndHelp) {
  const Workplace here;
  here.write_mask("one.png", 16);
  here.write_mask("two.png", 32);
  expect_success(here.script(R"s(
wait 3
click File
wait 3
expect "Open again" disabled
key escape
open one.png
wait-for Size = "16 × 16"
open two.png
wait-for Size = "32 × 32"
click View
wait 3
expect "View: Texture" = on
click "View: Bake"
wait-for Bake = on
key ctrl+3
wait 3
click File
wait 3
hover "Open again"
wait 30
click )s" + here.path("one.png") +
                             R"s(
wait-for Size = "16 × 16"
key f1
wait 3
expect S = "one sweep"
expect X = "Compare, Flip: change over"
screenshot keys.png
key escape
wait 3
expect S gone
key f1
wait 3
key f1
wait 3
expect S gone
click Help
wait 3
click "About and documentation"
wait 3
expect Documentation contains docs/inspector.md
click Close
wait 3
expect Documentation gone
)s"));
  // Dimmed: the menu's words behind the page are less bright than before.
  const Image keys = read_image(here / "keys.png").image;
  EXPECT_LT(contrast(keys, {0.0, 0.0, 0.2, 0.03}), 30.0);
}

TEST(Inspector, KeepsItsSessionAndShrugsOffADamagedOne) {
  const Workplace here;
  here.write_mask("mask.png", 32);
  expect_success(
      here.script("open mask.png\nwait-for Size = \"32 × 32\"\nkey ctrl+d\nwait 3", "--session s.json"));
  expect_success(here.script(
      "wait-for Size = \"32 × 32\"\nexpect Texture = on\nclick View\nexpect Dark = off", "--session s.json"));
  for (const char* text :
       {"", "{", "[1,2]",
        "{\"tab\": 7, \"scale\": \"-1\", \"dark\": \"maybe\", \"texture.slice\": \"1e99\"}"}) {
    std::ofstream(here / "s.json") << text;
    expect_success(here.script("wait 3\nexpect Run = on", "--session s.json"));
  }
}

TEST(Inspector, SaysWhereItsSettingsCannotBeKeptAndLivesOn) {
  namespace fs = std::filesystem;
  const Workplace here;
  here.write_mask("mask.png", 32);
  fs::create_directory(here / "locked");
  fs::permissions(here / "locked", fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                       fs::perms::others_exec);
  for (const std::string session :
       {"locked/s.json", "locked/new/s.json", "/proc/none/s.json", "mask.png/s.json"}) {
    expect_success(here.script("wait-for Error contains " + session.substr(0, 6) + R"s(
expect Status contains "will not be kept"
click Dismiss
open mask.png
wait-for Size = "32 × 32"
key ctrl+q
)s",
                               "--session " + session, here.as_stranger()));
  }
}

TEST(Inspector, SaysWhyItCannotStart) {
  const Workplace here;
  const Outcome no_display = here.shell("env -u DISPLAY -u WAYLAND_DISPLAY " BN_INSPECTOR);
  EXPECT_EQ(no_display.exit_code, 2);
  EXPECT_NE(no_display.output.find("--headless"), std::string::npos) << no_display.output;
  const Outcome old = here.script("wait 1", "", "MESA_GL_VERSION_OVERRIDE=2.1");
  EXPECT_EQ(old.exit_code, 2);
  EXPECT_NE(old.output.find("OpenGL is older than 3.3"), std::string::npos) << old.output;
  const auto refusal = [&](const std::string& arguments, int exit_code, const char* message) {
    const Outcome outcome = here.shell(BN_INSPECTOR " " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
    EXPECT_NE(outcome.output.find(message), std::string::npos) << outcome.output;
  };
  refusal("--headless", 1, "add --screenshot OUT.png or --script FILE");
  refusal("--hlp", 1, "did you mean --help?");
  refusal("one two", 1, "unexpected argument");
  refusal("--headless --screenshot shot.png missing.png", 2, "missing.png: does not exist");
  refusal("missing.toml", 2, "missing.toml: does not exist");
  refusal("--width 10", 1, "320..8192");
  EXPECT_EQ(here.shell(BN_INSPECTOR " --headless --screenshot nowhere/shot.png").exit_code, 2);
  EXPECT_EQ(here.shell(BN_INSPECTOR " --headless --script nowhere.script").exit_code, 2);
}

TEST(Inspector, DrawsAPictureWithoutAScript) {
  const Workplace here;
  here.write_mask("mask.png", 64);
  expect_success(here.shell(BN_INSPECTOR " --headless --screenshot run.png"));
  expect_success(here.shell(BN_INSPECTOR " --headless --screenshot mask_view.png mask.png"));
  const Image run = read_image(here / "run.png").image, mask = read_image(here / "mask_view.png").image;
  EXPECT_GT(contrast(run, {0.28, 0.2, 0.6, 0.5}), 20.0) << "the pictures of a run to be";
  EXPECT_GT(contrast(mask, {0.05, 0.2, 0.40, 0.8}), 50.0) << "the mask";
  EXPECT_GT(contrast(mask, {0.47, 0.1, 0.69, 0.45}), 20.0) << "its spectrum is there";
  // What the window says of a bad file is said to whoever has no window, and the picture shows it too.
  std::ofstream(here / "broken.png") << "no image at all";
  const Outcome broken = here.shell(BN_INSPECTOR " --headless --screenshot broken_view.png broken.png");
  EXPECT_EQ(broken.exit_code, 3);
  EXPECT_NE(broken.output.find("broken.png"), std::string::npos) << broken.output;
  EXPECT_TRUE(std::filesystem::exists(here / "broken_view.png"));
}

TEST(Inspector, HelpsAsBnDoes) {
  const Workplace here;
  const Outcome help = here.shell(BN_INSPECTOR " --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_TRUE(help.output.starts_with("Examples\n")) << help.output;
  EXPECT_NE(help.output.find("Usage: bn-inspector [FILE] [OPTIONS]\n"), std::string::npos) << help.output;
  std::istringstream lines(help.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(Inspector, ScriptsFailWithTheirLine) {
  const Workplace here;
  const auto failure = [&](const char* script, int exit_code, const char* message) {
    const Outcome outcome = here.script(script);
    EXPECT_EQ(outcome.exit_code, exit_code) << script;
    EXPECT_NE(outcome.output.find(message), std::string::npos) << script << outcome.output;
  };
  failure("wait 1\njump", 3, "test.script:2: there is no command \"jump\"");
  failure("click", 3, "test.script:1: click takes");
  failure("wait 2\nclick Nothing", 3, "nothing on the screen is called \"Nothing\"");
  failure("wait 2\nexpect Run = off", 5, "test.script:2: expected Run = off; it is: on");
  failure("wait-for Run = off 0.2", 5, "waited in vain");
  failure("key strange", 3, "there is no key");
}

TEST(Inspector, IsReadableAtTwiceTheSizeInBothThemes) {
  const Workplace here;
  here.write_mask("mask.png", 64);
  for (const std::string theme : {"dark", "light"}) {
    expect_success(here.script("theme " + theme +
                               "\nscale 2\nopen mask.png\nwait-for Size shown\nwait 3\nscreenshot shot.png"));
    const Image shot = read_image(here / "shot.png").image;
    EXPECT_GT(contrast(shot, {0.05, 0.35, 0.50, 0.7}), 50.0) << theme;
    EXPECT_GT(contrast(shot, {0.56, 0.2, 0.95, 0.8}), 10.0) << theme;
  }
}

TEST(Inspector, ShowsPicturesFirstWhereThereIsLittleRoom) {
  const Workplace here;
  here.write_mask("mask.png", 64);
  const Outcome outcome = here.script(R"s(
open mask.png
wait-for "Peak power" > 0
resize 800 600
wait 5
expect Spectrum shown
expect "Radial power" shown
expect Name shown
resize 1280 800
scale 2
wait 5
expect Spectrum shown
click Run
wait 5
expect Permuted shown
expect Spectrum shown
screenshot run.png
)s");
  expect_success(outcome);
  EXPECT_GT(contrast(read_image(here / "run.png").image, {0.45, 0.4, 0.95, 0.6}), 30.0) << "the pictures";
}

TEST(Inspector, SurvivesRandomEvents) {
  const Workplace here;
  here.write_mask("mask.png", 32);
  expect_success(here.shell(BN_TESTS "/ui/random " BN_INSPECTOR " mask.png 200 1"));
}

}  // namespace
}  // namespace bn::ui
