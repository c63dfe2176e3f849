// Protects: the verbs do what their help says, from a mask to a verified folder, with the documented JSON.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "process.h"
#include "textures.h"

namespace bn::tools {
namespace {

using Json = nlohmann::json;

constexpr char kRecipe[] = R"(version = 1
[[mask]]
name = "m"
size = [16, 16]
outputs = [{ path = "m.png" }]
[[retarget]]
name = "r"
mask = "m"
radius = 3
motion = 1
outputs = [{ path = "tile.png", kind = "tile" }, { path = "atlas.png" }]
)";

class Verbs : public testing::Test {
 protected:
  ProcessResult run(const std::vector<std::string>& arguments, int exit_code = 0) {
    const auto result = run_bn(arguments, {.folder = scratch_.path()});
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return result;
  }
  Json json(const std::vector<std::string>& arguments) { return Json::parse(run(arguments).out); }

  ScratchFolder scratch_;
};

TEST_F(Verbs, NoiseWritesAMaskAndSaysWhatItIs) {
  const Json result = json({"noise", "void-and-cluster", "--size", "32x16", "--seed", "7", "--type", "16bit",
                            "-o", "m.png", "--json"});
  EXPECT_EQ(result.at("size"), Json({32, 16}));
  EXPECT_EQ(result.at("seed"), 7);
  EXPECT_EQ(result.at("sigma"), 1.9);
  const Json info = json({"info", "m.png", "--json"});
  EXPECT_EQ(info.at("size"), Json({32, 16}));
  EXPECT_EQ(info.at("type"), "16bit");
  EXPECT_EQ(info.at("pixel_hash"), result.at("pixel_hash"));
  EXPECT_EQ(info.at("pixels_as_recorded"), true);
  EXPECT_EQ(info.at("metadata").at("algorithm"), "void-and-cluster");
  EXPECT_EQ(info.at("metadata").at("seed"), 7);
}

TEST_F(Verbs, ASeriesHasAFolderOfItsOwn) {
  const auto series = [&](const char* path, int exit_code) {
    run({"noise", "void-and-cluster", "--size", "8", "--count", "2", "-o", path}, exit_code);
  };
  series("set/m%02d.png", 0);
  EXPECT_EQ(names_in(scratch_ / "set"), (std::vector<std::string>{"m00.png", "m01.png"}));
  series("no/such/m%02d.png", 2);  // only the last folder is made
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "no"));
}

TEST_F(Verbs, HelpNamesTheSchedules) {
  const auto help = run({"retarget", "--help"});
  for (const char* schedule : {"kirkpatrick", "hajek", "inverse"})
    EXPECT_NE(help.out.find(std::string(" ") + schedule + ","), std::string::npos) << schedule;
}

TEST_F(Verbs, ManyMoreThreadsThanCoresAreNothingToWarnOf) {
  const ProcessResult result =
      run({"noise", "void-and-cluster", "--size", "64x64", "--threads", "1024", "-o", "m.png"});
  EXPECT_EQ(result.err, "");
}

TEST_F(Verbs, RetargetPrintsItsFiguresWithAndWithoutAFile) {
  write_image(scratch_ / "m.png", simple_mask(16), {});
  const Json one = json({"retarget", "m.png", "--step", "5,-3", "--radius", "3", "--json"});
  for (const char* name : {"start_energy", "energy", "lower_bound", "seconds", "orbit_length"})
    EXPECT_TRUE(one.at(name).is_number()) << name;
  EXPECT_EQ(one.at("optimal"), true);
  EXPECT_EQ(one.at("step"), Json({5, -3}));
  EXPECT_FALSE(one.contains("tiles"));
  EXPECT_EQ(names_in(scratch_.path()), std::vector<std::string>{"m.png"});

  const Json set = json(
      {"retarget", "m.png", "--step", "5,-3", "--radius", "3", "--motion", "1", "-o", "a.png", "--json"});
  ASSERT_EQ(set.at("tiles").size(), 9u);
  EXPECT_EQ(set.at("tiles")[4].at("motion"), Json({0, 0}));
  EXPECT_EQ(set.at("tiles")[4].at("energy"), one.at("energy"));
  EXPECT_EQ(set.at("energy"), one.at("energy"));
  const Json info = json({"info", "a.png", "--json"});
  EXPECT_EQ(info.at("size"), Json({48, 48}));
  ASSERT_EQ(info.at("metadata").at("tiles").size(), 9u);
  EXPECT_EQ(info.at("metadata").at("tiles")[7].at("energy"), set.at("tiles")[7].at("energy"));
  EXPECT_EQ(info.at("metadata").at("radius"), 3);

  const auto text = run({"retarget", "m.png", "--step", "5,-3", "--radius", "3"});
  EXPECT_NE(text.out.find("energy        " + one.at("energy").dump() + "\n"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("optimal       yes\n"), std::string::npos) << text.out;
}

TEST_F(Verbs, TheReferenceInstanceHasItsProvenOptimum) {
  const std::string reference = BN_TEST_DATA "/peters_cc0_64_LDR_RGBA_0.png";
  const Json result =
      json({"retarget", reference, "--channel", "0", "--step", "48,36", "--radius", "6", "--json"});
  EXPECT_EQ(result.at("start_energy"), 348180);
  EXPECT_EQ(result.at("energy"), 3638);
  EXPECT_EQ(result.at("lower_bound"), 3638);
  EXPECT_EQ(result.at("optimal"), true);
}

TEST_F(Verbs, BakeMakesSkipsAndVerifies) {
  write_bytes(scratch_ / "r.toml", kRecipe);
  const Json plan = json({"bake", "r.toml", "--out", "out", "--dry-run", "--json"});
  EXPECT_EQ(plan.at("jobs").size(), 3u);
  EXPECT_EQ(plan.at("jobs")[0].at("up_to_date"), false);
  EXPECT_EQ(names_in(scratch_.path()), std::vector<std::string>{"r.toml"}) << "a dry run writes nothing";

  const Json made = json({"bake", "r.toml", "--out", "out", "--json"});
  EXPECT_EQ(made.at("jobs")[1].at("tiles").size(), 9u);
  for (const auto& job : made.at("jobs")) EXPECT_EQ(job.at("skipped"), false) << job;
  EXPECT_EQ(names_in(scratch_ / "out"), (std::vector<std::string>{"atlas.png", "contact_sheet.png", "m.png",
                                                                  "manifest.json", "tile.png"}));

  const Json again = json({"bake", "r.toml", "--out", "out", "--json"});
  for (const auto& job : again.at("jobs")) EXPECT_EQ(job.at("skipped"), true) << job;
  const auto in_words = run({"bake", "r.toml", "--out", "out"});
  EXPECT_NE(in_words.out.find("up to date mask "), std::string::npos) << in_words.out;
  EXPECT_EQ(in_words.out.find(" s  m.png"), std::string::npos) << "no time of an earlier run:\n"
                                                               << in_words.out;
  const Json forced = json({"bake", "r.toml", "--out", "out", "--json", "--force"});
  for (const auto& job : forced.at("jobs")) EXPECT_EQ(job.at("skipped"), false) << job;

  const Json verdict = json({"verify", "out", "--json"});
  EXPECT_EQ(verdict.at("pass"), true);
  EXPECT_EQ(verdict.at("failed"), 0);
  EXPECT_EQ(verdict.at("checked"), verdict.at("items").size());
  const auto text = run({"verify", "out/tile.png"});
  EXPECT_NE(text.out.find("pass  "), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("FAIL"), std::string::npos) << text.out;
}

TEST_F(Verbs, JsonKeepsAListOfNumbersOnOneLine) {
  const auto made = run({"noise", "void-and-cluster", "--size", "12x8", "-o", "m.png", "--json"});
  EXPECT_NE(made.out.find("\n  \"size\": [12, 8],\n"), std::string::npos) << made.out;
}

TEST_F(Verbs, InfoPrintsEveryFileThatCanBeRead) {
  run({"noise", "void-and-cluster", "--size", "12x8", "-o", "a.png"});
  run({"noise", "void-and-cluster", "--size", "16x8", "-o", "b.png"});
  write_bytes(scratch_ / "rubbish.png", "no picture");
  const Json two = json({"info", "a.png", "b.png", "--json"});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[1].at("size"), Json::array({16, 8}));
  const auto all = run({"info", "."}, 3);
  EXPECT_NE(all.out.find("a.png"), std::string::npos);
  EXPECT_NE(all.out.find("b.png"), std::string::npos);
  EXPECT_NE(all.err.find("rubbish.png"), std::string::npos);
}

TEST_F(Verbs, WhatIsNotOursIsNothingToVerify) {
  write_bytes(scratch_ / "README.md", "no texture");
  std::filesystem::create_directory(scratch_ / "empty");
  for (const char* path : {"README.md", "empty"}) {
    const auto result = run({"verify", path}, 3);
    EXPECT_NE(result.err.find("nothing here was written by bn"), std::string::npos) << result.err;
  }
}

TEST_F(Verbs, SeveralPathsAreVerifiedAsOne) {
  for (const char* name : {"a.png", "b.png"})
    run({"noise", "void-and-cluster", "--size", "12x8", "-o", name});
  const Json verdict = json({"verify", "a.png", "b.png", "--json"});
  EXPECT_EQ(verdict.at("paths"), Json({"a.png", "b.png"}));
  EXPECT_EQ(verdict.at("checked"), 8);
  write_bytes(scratch_ / "b.png", "no picture");
  run({"verify", "a.png", "b.png"}, 5);
  EXPECT_NE(
      run({"verify", "a.png", "b.png", "--mask", "a.png", "--step", "1,1"}, 1).err.find("one retarget tile"),
      std::string::npos);
}

TEST_F(Verbs, ATileWithoutItsMaskAsksForTheMask) {
  run({"noise", "void-and-cluster", "--size", "12x8", "-o", "m.png"});
  run({"retarget", "m.png", "--radius", "2", "-o", "t.png"});
  std::filesystem::remove(scratch_ / "m.png");
  const auto result = run({"verify", "t.png"}, 5);
  EXPECT_NE(result.err.find("1 of 6 checks failed; put the mask where the tile names it"), std::string::npos)
      << result.err;
}

TEST_F(Verbs, HelpOfAMisspeltVerbNamesTheNearest) {
  EXPECT_NE(run({"help", "nois"}, 1).err.find("did you mean bn help noise?"), std::string::npos);
}

TEST_F(Verbs, EveryLineOfHelpFitsEightyColumns) {
  for (const std::string verb : {"", "noise", "retarget", "spectrum", "study"}) {
    std::istringstream lines(
        run(verb.empty() ? std::vector<std::string>{"help"} : std::vector<std::string>{"help", verb}).out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST_F(Verbs, AQuietVerifyNamesWhatFails) {
  run({"noise", "void-and-cluster", "--size", "12x8", "-o", "m.png"});
  EXPECT_EQ(run({"verify", "m.png", "-q"}).out, "");
  std::string bytes = read_bytes(scratch_ / "m.png");
  write_bytes(scratch_ / "cut.png", bytes.substr(0, bytes.size() / 2));
  const auto failed = run({"verify", "-q", "."}, 5);
  EXPECT_NE(failed.out.find("FAIL  ./cut.png"), std::string::npos) << failed.out;
  EXPECT_EQ(failed.out.find("pass"), std::string::npos) << failed.out;
}

TEST_F(Verbs, ARetargetTileOfAnotherProgramIsMeasured) {
  run({"noise", "void-and-cluster", "--size", "16x16", "-o", "m.png"});
  const Json made = json({"retarget", "m.png", "--step", "5,3", "--radius", "3", "-o", "t.png", "--json"});
  const Json verdict = json({"verify", "t.png", "--mask", "m.png", "--step", "5,3", "--json"});
  EXPECT_EQ(verdict.at("failed"), 0);
  const std::string energy = std::to_string(made.at("energy").get<int>());
  EXPECT_TRUE(verdict.at("items")[2].at("detail").get<std::string>().starts_with(energy + ", ")) << verdict;
  EXPECT_NE(verdict.at("items")[3].at("detail").get<std::string>().find("is 0.00 % above it"),
            std::string::npos);
  const auto wrong = run({"verify", "t.png", "--mask", "m.png", "--step", "5,3", "--encoding", "plus3"}, 5);
  EXPECT_NE(wrong.out.find("stored as plus128?"), std::string::npos) << wrong.out;
  run({"verify", "t.png", "--mask", "m.png"}, 1);  // the step is needed
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{"--step", "5,3"},
                                             {"--to", "m.png"},
                                             {"--form", "gather"},
                                             {"--radius", "3"},
                                             {"--encoding", "plus3"}}) {
    const auto alone = run({"verify", "t.png", option[0], option[1]}, 1);
    EXPECT_NE(alone.err.find(option[0] + ": does not apply (allowed: only with --mask)"), std::string::npos)
        << alone.err;
  }
  run({"verify", "t.png", "--mask", "m.png", "--step", "5,3", "--encoding", "minus3"}, 1);
}

TEST_F(Verbs, ARecipeThatIsAPictureIsNamedOnce) {
  run({"noise", "void-and-cluster", "--size", "12x8", "-o", "m.png"});
  const auto result = run({"bake", "m.png"}, 3);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(Verbs, ProgressAsJsonTellsTheWholeBake) {
  write_bytes(scratch_ / "r.toml", kRecipe);
  const auto result = run({"bake", "r.toml", "--out", "out", "--progress", "json"});
  std::vector<std::string> events;
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line);) {
    const Json event = Json::parse(line);
    if (event.at("event") != "progress" && event.at("event") != "note") events.push_back(event.at("event"));
  }
  EXPECT_EQ(events, (std::vector<std::string>{"job_started", "file_written", "job_finished", "job_started",
                                              "file_written", "file_written", "job_finished", "job_started",
                                              "file_written", "job_finished"}));
  const auto quiet = run({"bake", "r.toml", "--out", "out", "--quiet", "--force"});
  EXPECT_EQ(quiet.err, "");
  EXPECT_EQ(quiet.out, "");
}

}  // namespace
}  // namespace bn::tools
