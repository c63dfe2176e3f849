// Protects: bn retarget --method anneal makes a tile that verifies, goes on after Ctrl-C with the same bytes,
// and refuses bad settings and foreign checkpoints with exit code 3 before anything is overwritten.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <thread>

#include "process.h"
#include "textures.h"

namespace bn::tools {
namespace {

class AnnealVerb : public testing::Test {
 protected:
  AnnealVerb() { write_image(scratch_ / "m.png", simple_mask(64), {}); }
  std::vector<std::string> arguments(const std::string& budget, const std::string& out) {
    return {"retarget", "m.png", "--step", "13,29", "--method", "anneal",
            "--budget", budget,  "--json", "-o",    out};
  }
  ProcessResult run(const std::vector<std::string>& arguments) {
    return run_bn(arguments, {.folder = scratch_.path()});
  }

  ScratchFolder scratch_;
};

TEST_F(AnnealVerb, MakesATileThatVerifies) {
  auto words = arguments("1e6", "tile.png");
  words.insert(words.end(), {"--schedule", "kirkpatrick", "--seed", "3", "--trace", "trace.csv"});
  const auto result = run(words);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("method"), "anneal");
  EXPECT_EQ(json.at("schedule"), "kirkpatrick");
  EXPECT_EQ(json.at("proposals"), 1000000);
  EXPECT_EQ(json.at("seed"), 3);
  EXPECT_GE(json.at("energy"), json.at("lower_bound"));
  EXPECT_EQ(run({"verify", "tile.png"}).exit_code, 0);
  EXPECT_EQ(read_bytes(scratch_ / "trace.csv").rfind("step,seconds,temperature", 0), 0u);
}

TEST_F(AnnealVerb, AMotionSetVerifies) {
  auto words = arguments("2e5", "atlas.png");
  words.insert(words.end(), {"--motion", "1"});
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(run({"verify", "atlas.png"}).exit_code, 0);
}

TEST_F(AnnealVerb, GoesOnWhereItWasStopped) {
  const std::string budget = "1.5e9";
  // A stop before the run began leaves no checkpoint: wait longer then.
  const auto checkpoint = scratch_ / "tile.png.checkpoint";
  for (int wait_ms = 50; wait_ms < 5000 && !std::filesystem::exists(checkpoint); wait_ms *= 2) {
    Process process(arguments(budget, "tile.png"), {.folder = scratch_.path()});
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    process.send(SIGINT);
    ASSERT_NE(process.wait().exit_code, 0);
  }
  ASSERT_TRUE(std::filesystem::exists(checkpoint));
  ASSERT_EQ(run(arguments(budget, "tile.png")).exit_code, 0);
  EXPECT_EQ(names_in(scratch_.path()), (std::vector<std::string>{"m.png", "tile.png"}))
      << "no checkpoint is left";
  const std::string resumed = read_bytes(scratch_ / "tile.png");
  ASSERT_EQ(run(arguments(budget, "tile.png")).exit_code, 0);
  EXPECT_EQ(resumed, read_bytes(scratch_ / "tile.png"));
}

TEST_F(AnnealVerb, BadSettingsAreNamedAndNothingIsOverwritten) {
  write_bytes(scratch_ / "tile.png", "mine");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& named) {
    auto words = arguments("1e6", "tile.png");
    words.insert(words.end(), more.begin(), more.end());
    const auto result = run(words);
    EXPECT_EQ(result.exit_code, 3) << named;
    EXPECT_NE(result.err.find(named), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("allowed"), std::string::npos) << result.err;
    EXPECT_EQ(read_bytes(scratch_ / "tile.png"), "mine");
  };
  refused({"--schedule", "boil"}, "boil");
  refused({"--start-temperature", "1", "--end-temperature", "2"}, "end_temperature");
  const auto zero = run(arguments("0", "tile.png"));
  EXPECT_EQ(zero.exit_code, 3);
  EXPECT_NE(zero.err.find("budget"), std::string::npos);
  write_bytes(scratch_ / "tile.png.checkpoint", "annlcp01 and then rubbish that is long enough to be read");
  refused({}, "checkpoint");
}

}  // namespace
}  // namespace bn::tools
