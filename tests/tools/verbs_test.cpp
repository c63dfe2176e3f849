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
  ProcessResult run(const std::vector<std::string>& arguments) {
    const auto result = run_bn(arguments, {.folder = scratch_.path()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
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
}

}  // namespace
}  // namespace bn::tools
