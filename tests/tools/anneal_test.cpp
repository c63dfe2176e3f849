// Protects: bn retarget --method anneal makes a tile that verifies, goes on after Ctrl-C with the same bytes,
// and refuses bad settings and foreign checkpoints with exit code 3 before anything is overwritten; the study
// of annealing makes its figures where gnuplot is installed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <csignal>

#include "bn/bake.h"
#include "bn/error.h"
#include "bn/retarget_anneal.h"
#include "process.h"
#include "textures.h"

namespace bn::tools {
namespace {

class AnnealVerb : public testing::Test {
 protected:
  AnnealVerb() { write_image(scratch_ / "m.png", simple_mask(64), {}); }
  std::vector<std::string> arguments(const std::string& budget, const std::string& out) {
    return {"retarget",
            "m.png",
            "--step",
            "13,29",
            "--method",
            "anneal",
            budget.ends_with('s') ? "--seconds" : "--proposals",
            budget.substr(0, budget.find('s')),
            "--json",
            "-o",
            out};
  }
  ProcessResult run(const std::vector<std::string>& arguments) {
    return run_bn(arguments, {.folder = scratch_.path()});
  }

  /// Begins what arguments() begin, and stops it at its first report of progress, inside this process.
  void leave_checkpoint(const std::string& proposals, const std::string& keys, const std::string& out) {
    const std::string recipe =
        "version = 1\n[[retarget]]\nname = \"r\"\nimage = \"m.png\"\nstep = [13, 29]\nmethod = \"anneal\"\n"
        "proposals = " +
        proposals + "\n" + keys + "outputs = [{ path = \"" + out + "\", kind = \"" +
        (keys.empty() ? "tile" : "atlas") + "\" }]\n";
    std::stop_source stop;
    const auto stop_it = [&](const BakeEvent& event) {
      if (std::holds_alternative<BakeProgress>(event)) stop.request_stop();
    };
    const ScratchFolder elsewhere;
    EXPECT_THROW(bake(parse_recipe(recipe, "recipe", scratch_.path()), {.out_dir = elsewhere.path()},
                      {.threads = 1, .stop = stop.get_token()}, stop_it),
                 Error);
    ASSERT_TRUE(std::filesystem::exists(elsewhere / (out + ".checkpoint")));
    std::filesystem::copy(elsewhere / (out + ".checkpoint"), scratch_ / (out + ".checkpoint"));
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
  EXPECT_EQ(json.at("recomputed_energy"), json.at("energy"));
  EXPECT_EQ(run({"verify", "tile.png"}).exit_code, 0);
  EXPECT_EQ(read_bytes(scratch_ / "trace.csv").rfind("proposals,seconds,temperature", 0), 0u);
}

TEST_F(AnnealVerb, AMotionSetVerifies) {
  auto words = arguments("2e5", "atlas.png");
  words.insert(words.end(), {"--motion", "1"});
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(run({"verify", "atlas.png"}).exit_code, 0);
}

TEST_F(AnnealVerb, AnnealsWhatTheExactSolverCannot) {
  Image three = simple_mask(32, SampleType::u16);
  three.size = {16, 16};
  three.channels = 3;
  three.samples.resize(16 * 16 * 3 * 2);
  write_image(scratch_ / "rgb.png", three, {});
  const auto words = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"retarget", "rgb.png", "--step", "5,3",   "--radius",    "3",  "--method",
                                 "anneal",   "--json",  "-o",     "o.png", "--proposals", "2e5"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  auto result = run(words({"--channels", "2,0", "--weights", "3,1"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("channels"), (std::vector<int>{2, 0}));
  EXPECT_GT(json.at("lower_bound"), 0) << "the sum of the channels' bounds";
  EXPECT_GE(json.at("energy"), json.at("lower_bound"));
  EXPECT_EQ(run({"verify", "o.png"}).exit_code, 0) << run({"verify", "o.png"}).out;
  // Single channels weigh as they should.
  const auto start_of = [&](const std::vector<std::string>& more) {
    return nlohmann::json::parse(run(words(more)).out).at("start_energy").get<std::int64_t>();
  };
  EXPECT_EQ(json.at("start_energy"),
            3 * start_of({"--channels", "2"}) + start_of({"--channels", "0", "--weights", "1"}));

  result = run(words({"--metric", "l2", "--residual-sigma", "1.5", "--chains", "2"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(nlohmann::json::parse(result.out).at("energy"),
            nlohmann::json::parse(result.out).at("start_energy"));
  EXPECT_EQ(run({"verify", "o.png"}).exit_code, 0) << run({"verify", "o.png"}).out;

  result = run(words(
      {"--chains", "3", "--coupling", "tempering", "--swap-distance", "2", "--initial-acceptance", "1"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(run({"verify", "o.png"}).exit_code, 0);
  result = run(words({"--schedule", "kirkpatrick", "--factor", "0.9", "--accepted-per-stage", "500",
                      "--tried-per-stage", "10000", "--frozen-stages", "2", "--stages", "30", "--stop-after",
                      "100000"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  // What the file carries makes it again.
  const auto recipe = nlohmann::json::parse(run({"info", "o.png", "--json"}).out)
                          .at("metadata")
                          .at("recipe")
                          .get<std::string>();
  EXPECT_NE(recipe.find("tried_per_stage = 10000"), std::string::npos) << recipe;
  EXPECT_NE(recipe.find("stop_after = 100000"), std::string::npos) << recipe;
  write_bytes(scratch_ / "again.toml", recipe);
  ASSERT_EQ(run({"bake", "again.toml", "--out", "again"}).exit_code, 0);
  const auto hash_of = [&](const std::string& file) {
    return nlohmann::json::parse(run({"info", file, "--json"}).out).at("metadata").at("pixel_hash");
  };
  EXPECT_EQ(hash_of("again/o.png"), hash_of("o.png"));
}

// Stopping and going on. Where a run is when a signal arrives is the scheduler's choice, so a run that must
// be finished later is stopped from inside, at its first report of progress; signals go to runs that nobody
// could finish.

TEST_F(AnnealVerb, AMotionSetGoesOnWhereItWasStopped) {
  auto words = arguments("2e6", "atlas.png");
  words.insert(words.end(), {"--motion", "1"});
  leave_checkpoint("2000000", "motion = 1\n", "atlas.png");
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(names_in(scratch_.path()), (std::vector<std::string>{"atlas.png", "m.png"}))
      << "no checkpoint is left";
  const std::string resumed = read_bytes(scratch_ / "atlas.png");
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(resumed, read_bytes(scratch_ / "atlas.png"));
}

TEST_F(AnnealVerb, ABudgetInSecondsIsKeptByItsCheckpoint) {
  leave_checkpoint("30000000", "", "tile.png");
  ASSERT_EQ(checkpoint_proposals(read_bytes(scratch_ / "tile.png.checkpoint")), 30'000'000);
  // Measured anew, a thousand seconds would be far more.
  const auto result = run(arguments("1000s", "tile.png"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out).at("proposals"), 30'000'000);
}

TEST_F(AnnealVerb, GoesOnWhereItWasStopped) {
  leave_checkpoint("30000000", "", "tile.png");
  ASSERT_EQ(run(arguments("3e7", "tile.png")).exit_code, 0);
  EXPECT_EQ(names_in(scratch_.path()), (std::vector<std::string>{"m.png", "tile.png"}))
      << "no checkpoint is left";
  const std::string resumed = read_bytes(scratch_ / "tile.png");
  ASSERT_EQ(run(arguments("3e7", "tile.png")).exit_code, 0);
  EXPECT_EQ(resumed, read_bytes(scratch_ / "tile.png"));
}

TEST_F(AnnealVerb, CtrlCLeavesACheckpointAndAKillTheOneThatThereWas) {
  auto words = arguments("1e11", "tile.png");
  words.insert(words.end(), {"--progress", "json"});
  const auto checkpoint = scratch_ / "tile.png.checkpoint";
  const auto end_at_work = [&](int signal) {
    Process process(words, {.folder = scratch_.path()});
    EXPECT_TRUE(process.wait_for_message(R"("event":"progress")"));
    process.send(signal);
    return process.wait();
  };
  const auto stopped = end_at_work(SIGINT);
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_EQ(names_in(scratch_.path()), (std::vector<std::string>{"m.png", "tile.png.checkpoint"}));
  EXPECT_EQ(checkpoint_proposals(read_bytes(checkpoint)), 100'000'000'000);
  EXPECT_EQ(end_at_work(SIGKILL).signal, SIGKILL);
  EXPECT_EQ(checkpoint_proposals(read_bytes(checkpoint)), 100'000'000'000) << "whole, if not the same";
}

TEST_F(AnnealVerb, BadSettingsAreNamedAndNothingIsOverwritten) {
  write_bytes(scratch_ / "tile.png", "mine");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& named,
                           int exit_code = 3) {
    auto words = arguments("1e6", "tile.png");
    words.insert(words.end(), more.begin(), more.end());
    const auto result = run(words);
    EXPECT_EQ(result.exit_code, exit_code) << named << result.err;
    EXPECT_NE(result.err.find(named), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("allowed"), std::string::npos) << result.err;
    EXPECT_EQ(read_bytes(scratch_ / "tile.png"), "mine");
  };
  // What cannot be a value of its option is a wrong command line, whatever the option.
  refused({"--schedule", "boil"}, "boil", 1);
  for (const char* factor : {"0", "1.5"}) refused({"--factor", factor}, "factor", 1);
  refused({"--schedule", "kirkpatrick", "--factor", "1"}, "factor");
  refused({"--schedule", "linear", "--factor", "0.5"}, "factor");
  refused({"--coupling", "tempering"}, "chains");
  refused({"--residual-sigma", "1.5"}, "l2");
  refused({"--channels", "0,0", "--weights", "1,2,3"}, "weights");
  refused({"--channels", "0,7"}, "channel");
  refused({"--motion", "1", "--trace", "t.csv"}, "--trace");
  refused({"--gap", "1%"}, "--gap");
  refused({"--start-temperature", "1", "--end-temperature", "2"}, "--end-temperature");
  const auto zero = run(arguments("0", "tile.png"));
  EXPECT_EQ(zero.exit_code, 1);
  EXPECT_NE(zero.err.find("--proposals"), std::string::npos);
  write_bytes(scratch_ / "tile.png.checkpoint", "annlcp01 and then rubbish that is long enough to be read");
  refused({}, "checkpoint");
  // Of another run, and of this one cut short.
  std::filesystem::remove(scratch_ / "tile.png.checkpoint");
  leave_checkpoint("30000000", "", "other.png");
  const std::string bytes = read_bytes(scratch_ / "other.png.checkpoint");
  write_bytes(scratch_ / "tile.png.checkpoint", bytes);
  refused({}, "another problem or other options");
  write_bytes(scratch_ / "tile.png.checkpoint", bytes.substr(0, bytes.size() / 2));
  refused({}, "cut short");
  write_bytes(scratch_ / "tile.png.checkpoint", "");
  refused({}, "cut short");
}

TEST_F(AnnealVerb, NamesOfVersion01GoOnWorking) {
  const auto result = run({"retarget", "m.png", "--step", "13,29", "--method", "anneal", "--budget", "1e5",
                           "--no-wrap", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("--budget is --proposals now"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--no-wrap is --wrap false now"), std::string::npos) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("proposals"), 100'000);
  EXPECT_EQ(json.at("wrap"), false);
}

TEST_F(AnnealVerb, FlagsOfAnnealingNeedIt) {
  const auto result = run({"retarget", "m.png", "--schedule", "linear"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("--schedule: does not apply (allowed: only with --method anneal)"),
            std::string::npos)
      << result.err;
}

TEST_F(AnnealVerb, TheStudyMakesItsFigures) {
  write_image(scratch_ / "small.png", simple_mask(8), {});
  const std::vector<std::string> words{"study",   "anneal", "small.png", "--step", "3,1",
                                       "--radii", "2",      "--budgets", "1",      "--seeds",
                                       "2",       "-o",     "study",     "--part", "runs"};
  auto result = run_bn(words, {.folder = scratch_.path(), .shell_prefix = "export PATH=/nowhere"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("no figures: gnuplot is not installed"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, read_bytes(scratch_ / "study/table.md"));
  result = run(words);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  if (result.err.find("gnuplot is not installed") == std::string::npos) {
    EXPECT_EQ(result.err.find("no figures"), std::string::npos) << result.err;
    for (const char* file : {"study/error_against_time.svg", "study/error_against_time-dark.svg"})
      EXPECT_NE(read_bytes(scratch_ / file).find("kirkpatrick"), std::string::npos) << file;
  }

  // What stands is kept; another subject is not mixed in.
  const std::string runs = read_bytes(scratch_ / "study/runs.csv");
  EXPECT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(read_bytes(scratch_ / "study/runs.csv"), runs);
  auto other = words;
  other[4] = "1,3";
  EXPECT_EQ(run(other).exit_code, 3);
  EXPECT_EQ(read_bytes(scratch_ / "study/runs.csv"), runs);
}

TEST_F(AnnealVerb, TracesTooShortToCountAnythingMakeTheirFigures) {
  write_image(scratch_ / "small.png", simple_mask(8), {});
  const auto result = run({"study", "anneal", "small.png", "--step", "3,1", "--radii", "2", "--schedules",
                           "inverse", "--budgets", "1e3", "--part", "traces", "-o", "study"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  if (result.err.find("gnuplot is not installed") != std::string::npos) GTEST_SKIP() << result.err;
  EXPECT_EQ(result.err.find("no figures"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "study/acceptance_surface.svg")) << "it would be empty";
}

TEST_F(AnnealVerb, TheStudyTakesSchedulesAndBudgets) {
  write_image(scratch_ / "small.png", simple_mask(8), {});
  const std::vector<std::string> words{"study",   "anneal", "small.png", "--step", "3,1",
                                       "--radii", "2",      "--seeds",   "2",      "-o",
                                       "study",   "--part", "runs",      "--json"};
  const auto with = [&](std::initializer_list<std::string> more) {
    auto all = words;
    all.insert(all.end(), more);
    return run(all);
  };
  const auto result = with({"--schedules", "inverse,linear", "--budgets", "1e3,2e3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json.at("medians").size(), 4u);
  EXPECT_EQ(json.at("medians")[0].at("schedule"), "linear");
  EXPECT_EQ(json.at("medians")[1].at("proposals"), 2000);
  EXPECT_EQ(json.at("exact").size(), 1u);
  EXPECT_NE(read_bytes(scratch_ / "study/medians.md").find("| 2e3 | inverse |"), std::string::npos);
  // Runs of other schedules stay in the file; a lone small number is a count of budgets.
  ASSERT_EQ(with({"--schedules", "greedy", "--budgets", "1"}).exit_code, 0);
  const std::string runs = read_bytes(scratch_ / "study/runs.csv");
  EXPECT_NE(runs.find("linear,2,1000,1,"), std::string::npos) << runs;
  EXPECT_NE(runs.find("greedy,2,1000000,2,"), std::string::npos) << runs;
  for (const auto& [option, value] :
       {std::pair("--schedules", "expnential"), std::pair("--budgets", "1e7,1e6"),
        std::pair("--budgets", "12"), std::pair("--budgets", "1e3.5")})
    EXPECT_EQ(with({option, value}).exit_code, 1) << option << " " << value;
}

}  // namespace
}  // namespace bn::tools
