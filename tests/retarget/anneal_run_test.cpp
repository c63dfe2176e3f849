// Protects: a run gives the same bytes whatever threads, instruction set, trace or interruption; its figures
// are true; every option outside its range and every foreign or damaged checkpoint is refused by name.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "bn/error.h"
#include "bn/retarget_anneal.h"
#include "reference.h"

namespace bn {
namespace {

AnnealProblem small_problem(Extent size = {32, 32}, std::int32_t bound = 256) {
  AnnealProblem problem;
  problem.channels = {{random_levels(size, 4, bound)}};
  problem.retarget.step = {11, 7};
  return problem;
}

void expect_true(const AnnealProblem& problem, const AnnealResult& result) {
  EXPECT_NO_THROW(check_permutation(result.tile.move, problem.retarget));
  EXPECT_EQ(result.tile.energy, anneal_energy(problem, result.tile.move));
  EXPECT_EQ(result.tile.start_energy,
            anneal_energy(problem, Grid<Offset>(result.tile.move.size(), problem.retarget.motion)));
  EXPECT_LE(result.tile.energy, result.tile.start_energy);
}

TEST(Anneal, EveryScheduleComesNearTheOptimum) {
  const AnnealProblem problem = small_problem();
  const auto exact = solve_retarget(problem.channels[0].levels, problem.retarget);
  for (const auto name : schedule_names()) {
    AnnealOptions options;
    options.schedule = name;
    options.proposals = 40'000'000;
    const auto result = anneal_retarget(problem, options);
    SCOPED_TRACE(std::string(name));
    expect_true(problem, result);
    EXPECT_GE(result.tile.energy, exact.energy);
    EXPECT_LE(static_cast<double>(result.tile.energy),
              (name == "greedy" ? 2.5 : 1.5) * static_cast<double>(exact.energy));
    EXPECT_EQ(result.tile.lower_bound, 0) << "annealing proves nothing";
  }
}

TEST(Anneal, SameBytesForThreadsInstructionSetsAndTraces) {
  AnnealProblem problem = small_problem({40, 200});
  AnnealOptions options;
  options.proposals = 3'000'000;
  for (const auto coupling : {ChainOptions::Coupling::independent, ChainOptions::Coupling::tempering}) {
    options.chains = {.count = 3, .coupling = coupling};
    const auto expected = anneal_retarget(problem, options, {.threads = 1});
    expect_true(problem, expected);
    for (const int threads : {2, 5}) {
      AnnealTrace trace;
      EXPECT_EQ(anneal_retarget(problem, options, {.threads = threads}, &trace).tile.move,
                expected.tile.move);
    }
    for (const auto& name : instruction_sets()) {
      use_instruction_set(name);
      const auto result = anneal_retarget(problem, options, {.threads = 2});
      use_instruction_set("");
      EXPECT_EQ(result.tile.move, expected.tile.move) << name;
      EXPECT_EQ(result.accepted, expected.accepted) << name;
    }
  }
}

TEST(Anneal, ResumedFromAnyCheckpointItEndsTheSame) {
  struct Setting {
    AnnealProblem problem;
    AnnealOptions options;
  };
  std::vector<Setting> settings(4);
  for (auto& s : settings) {
    s.problem = small_problem();
    s.options.proposals = 30'000'000;
  }
  settings[1].options.schedule = "kirkpatrick";
  settings[1].options.chains.count = 2;
  settings[2].options.chains = {.count = 4, .coupling = ChainOptions::Coupling::tempering};
  settings[2].options.proposals = 3'000'000;
  settings[3].problem.retarget.metric = Metric::l2;
  settings[3].problem.residual_sigma_px = 1.0;
  settings[3].options.proposals = 200'000;
  for (auto& [problem, options] : settings) {
    const auto whole = anneal_retarget(problem, options);
    // Each checkpoint is kept, as if the process were killed right after it.
    std::vector<std::string> checkpoints;
    options.checkpoint.interval_s = 0.0;
    options.checkpoint.save = [&](std::string_view bytes) { checkpoints.emplace_back(bytes); };
    EXPECT_EQ(anneal_retarget(problem, options).tile.move, whole.tile.move);
    ASSERT_FALSE(checkpoints.empty());
    options.checkpoint.save = {};
    const std::size_t step = std::max<std::size_t>(1, checkpoints.size() / 3);
    for (std::size_t i = 0; i < checkpoints.size(); i += step) {
      options.checkpoint.resume = checkpoints[i];
      const auto resumed = anneal_retarget(problem, options);
      EXPECT_EQ(resumed.tile.move, whole.tile.move) << i;
      EXPECT_EQ(resumed.proposals, whole.proposals);
      EXPECT_EQ(resumed.accepted, whole.accepted);
    }
  }
}

TEST(Anneal, AStopSavesAndTheRunGoesOn) {
  const AnnealProblem problem = small_problem();
  AnnealOptions options;
  options.proposals = 30'000'000;
  const auto whole = anneal_retarget(problem, options);
  std::string checkpoint;
  std::stop_source source;
  options.checkpoint.save = [&](std::string_view bytes) { checkpoint = bytes; };
  Execution execution;
  execution.stop = source.get_token();
  execution.progress = [&](double share) {
    if (share > 0.3) source.request_stop();
  };
  try {
    anneal_retarget(problem, options, execution);
    ADD_FAILURE() << "went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
  ASSERT_FALSE(checkpoint.empty());
  options.checkpoint.resume = checkpoint;
  EXPECT_EQ(anneal_retarget(problem, options).tile.move, whole.tile.move);
}

std::string message_of(const AnnealProblem& problem, const AnnealOptions& options) {
  try {
    anneal_retarget(problem, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_input);
    EXPECT_FALSE(error.info().limit.empty());
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(Anneal, ForeignAndDamagedCheckpointsAreRefused) {
  const AnnealProblem problem = small_problem();
  AnnealOptions options;
  options.proposals = 2'000'000;
  std::string checkpoint;
  options.checkpoint.interval_s = 0.0;
  Execution stopped;
  std::stop_source source;
  source.request_stop();
  stopped.stop = source.get_token();
  options.checkpoint.save = [&](std::string_view bytes) { checkpoint = bytes; };
  EXPECT_THROW(anneal_retarget(problem, options, stopped), Error);
  ASSERT_FALSE(checkpoint.empty());
  options.checkpoint.save = {};

  AnnealOptions other = options;
  other.checkpoint.resume = checkpoint;
  other.seed = 2;
  EXPECT_NE(message_of(problem, other).find("another problem"), std::string::npos);
  AnnealProblem moved = problem;
  moved.retarget.motion = {1, 0};
  other.seed = 1;
  EXPECT_NE(message_of(moved, other).find("another problem"), std::string::npos);
  EXPECT_NO_THROW(anneal_retarget(problem, other));

  for (std::size_t length = 0; length < checkpoint.size(); length = length < 64 ? length + 1 : length + 97) {
    other.checkpoint.resume = length == 0 ? std::string(1, 'x') : checkpoint.substr(0, length);
    EXPECT_NE(message_of(problem, other).find("checkpoint"), std::string::npos) << length;
  }
  for (std::size_t at = 0; at < checkpoint.size(); at += 61) {
    std::string damaged = checkpoint;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    other.checkpoint.resume = damaged;
    EXPECT_NE(message_of(problem, other).find("checkpoint"), std::string::npos) << at;
  }
}

TEST(Anneal, BadOptionsAreNamed) {
  const AnnealProblem problem = small_problem({8, 8});
  const auto names = [&](auto change) {
    AnnealOptions options;
    options.proposals = 1000;
    change(options);
    return message_of(problem, options);
  };
  EXPECT_NE(names([](auto& o) { o.schedule = "boil"; }).find("unknown schedule 'boil'"), std::string::npos);
  EXPECT_NE(names([](auto& o) { o.proposals = 0; }).find("budget"), std::string::npos);
  EXPECT_NE(names([](auto& o) { o.chains.count = 0; }).find("chains"), std::string::npos);
  EXPECT_NE(names([](auto& o) {
              o.chains = {1, ChainOptions::Coupling::tempering};
            }).find("chains"),
            std::string::npos);
  EXPECT_NE(names([](auto& o) { o.swap_distance_px = 13; }).find("swap_distance"), std::string::npos);
  EXPECT_NE(names([](auto& o) { o.parameters.factor = 1.1; }).find("factor"), std::string::npos);
  EXPECT_NE(names([](auto& o) { o.parameters.slope = 1.0; }).find("slope"), std::string::npos);
  EXPECT_NE(names([](auto& o) {
              o.parameters.factor = 0.9;
              o.end_temperature = 0.1;
            }).find("end_temperature"),
            std::string::npos);
  EXPECT_NE(names([](auto& o) { o.checkpoint.interval_s = -1.0; }).find("interval"), std::string::npos);
  EXPECT_NE(names([](auto& o) {
              o.start = {StartTemperature::Rule::acceptance, 1.5};
            }).find("initial_acceptance"),
            std::string::npos);
  EXPECT_NE(names([](auto& o) {
              o.start = {StartTemperature::Rule::given, 1.0};
              o.end_temperature = 2.0;
            }).find("end_temperature"),
            std::string::npos);

  AnnealOptions options;
  AnnealProblem bad = problem;
  bad.channels.clear();
  EXPECT_NE(message_of(bad, options).find("channels"), std::string::npos);
  bad = problem;
  bad.residual_sigma_px = 1.0;
  EXPECT_NE(message_of(bad, options).find("metric"), std::string::npos);
  bad.retarget.metric = Metric::l2;
  bad.residual_sigma_px = 99.0;
  EXPECT_NE(message_of(bad, options).find("residual_sigma"), std::string::npos);
  bad = problem;
  bad.channels.push_back({random_levels({8, 9}, 1, 5)});
  EXPECT_NE(message_of(bad, options).find("channels"), std::string::npos);
  bad = problem;
  bad.channels[0].weight = 0;
  EXPECT_NE(message_of(bad, options).find("weights"), std::string::npos);
  bad = problem;
  bad.channels[0].levels[3] = 1 << 24;
  EXPECT_NE(message_of(bad, options).find("levels"), std::string::npos);
}

TEST(Anneal, TraceIsReadWhileItGrows) {
  const AnnealProblem problem = small_problem();
  AnnealOptions options;
  options.proposals = 60'000'000;
  AnnealTrace trace;
  std::atomic<bool> over{false};
  std::size_t seen = 0;
  std::thread reader([&] {
    while (!over) {
      const std::size_t count = trace.size();
      EXPECT_GE(count, seen);
      for (std::size_t p = seen; p < count; ++p) {
        EXPECT_LE(trace[p].best_energy, trace[p].energy);
        EXPECT_TRUE(p == 0 || trace[p].proposals > trace[p - 1].proposals);
      }
      seen = count;
    }
  });
  const auto result = anneal_retarget(problem, options, {.threads = 1}, &trace);
  over = true;
  reader.join();
  EXPECT_GT(trace.size(), 100u);
  EXPECT_LE(trace.size(), AnnealTrace::kCapacity);
  EXPECT_EQ(trace[trace.size() - 1].best_energy, result.tile.energy);
  const std::string csv = trace.csv(7);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), trace.size() + 1);
  EXPECT_EQ(csv.rfind("proposals,seconds,temperature,energy,best,lower_bound,accepted,worse_1_tried", 0), 0u);
  EXPECT_EQ(csv.find("worse_8388608_tried"), std::string::npos) << "nobody tried so much";

  // Sweeps were watched, few of them, and they are what they would have been.
  int watched = 0;
  for (std::size_t p = 0; p < trace.size(); ++p) watched += trace[p].worsening_tried[1] > 0;
  EXPECT_GT(watched, 1);
  EXPECT_LE(watched, 1 + options.proposals / (problem.channels[0].levels.size().area() / 2) / 8192);
  EXPECT_EQ(anneal_retarget(problem, options, {.threads = 1}).tile.move, result.tile.move);
}

TEST(Anneal, TheMotionSetIsItsVariants) {
  const AnnealProblem problem = small_problem({20, 18});
  AnnealOptions options;
  options.proposals = 400'000;
  const auto set = anneal_motion_set(problem, options, 1, {.threads = 3});
  ASSERT_EQ(set.size(), 9u);
  for (int i = 0; i < 9; ++i) {
    AnnealProblem variant = problem;
    variant.retarget.motion = {i % 3 - 1, i / 3 - 1};
    const auto alone = anneal_retarget(variant, options);
    EXPECT_EQ(set[static_cast<std::size_t>(i)].tile.move, alone.tile.move);
    expect_true(variant, set[static_cast<std::size_t>(i)]);
  }
}

TEST(Anneal, AParameterLeadsTheSchedule) {
  const AnnealProblem problem = small_problem();
  AnnealOptions options;
  options.proposals = 1'000'000;
  options.start = {StartTemperature::Rule::given, 4.0};
  options.parameters.factor = 0.999999;
  const auto result = anneal_retarget(problem, options);
  expect_true(problem, result);
  EXPECT_EQ(result.start_temperature, 4.0);
  EXPECT_NEAR(result.end_temperature, 4.0 * std::exp(-0.984375), 1e-3) << "63/64 of the budget cool";
  // Even where it underflows.
  options.parameters.factor = 1e-3;
  expect_true(problem, anneal_retarget(problem, options));
}

TEST(Anneal, AStoppedMotionSetGoesOn) {
  const AnnealProblem problem = small_problem({20, 18});
  AnnealOptions options;
  options.proposals = 4'000'000;
  options.chains.count = 2;
  const auto whole = anneal_motion_set(problem, options, 1, {.threads = 2});
  // Stopped again and again, as soon as there is something new, until it comes to its end.
  std::string checkpoint;
  options.checkpoint.interval_s = 0.0;
  int stops = 0;
  std::vector<AnnealResult> resumed;
  while (resumed.empty() && stops < 2000) {
    std::stop_source source;
    int saves = 0;
    options.checkpoint.save = [&](std::string_view bytes) {
      checkpoint = bytes;
      if (++saves == 15) source.request_stop();
    };
    options.checkpoint.resume = checkpoint;
    try {
      resumed = anneal_motion_set(problem, options, 1, {.threads = 2, .stop = source.get_token()});
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ErrorCode::cancelled) << error.what();
      ++stops;
    }
  }
  EXPECT_GT(stops, 10);
  ASSERT_EQ(resumed.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(resumed[i].tile.move, whole[i].tile.move) << i;
    EXPECT_EQ(resumed[i].tile.energy, whole[i].tile.energy);
    EXPECT_EQ(resumed[i].proposals, whole[i].proposals);
    EXPECT_EQ(resumed[i].accepted, whole[i].accepted);
    EXPECT_EQ(resumed[i].end_temperature, whole[i].end_temperature);
  }
  EXPECT_EQ(checkpoint_proposals(checkpoint), options.proposals);

  // The last checkpoint is of a finished set: going on from it has nothing left to do.
  options.checkpoint.save = {};
  options.checkpoint.resume = checkpoint;
  EXPECT_EQ(anneal_motion_set(problem, options, 1)[4].tile.move, whole[4].tile.move);

  const auto refused = [&](const AnnealProblem& of, const AnnealOptions& with, int range) {
    try {
      anneal_motion_set(of, with, range);
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      EXPECT_NE(std::string(error.what()).find("checkpoint"), std::string::npos) << error.what();
    }
  };
  refused(problem, options, 2);
  AnnealOptions other = options;
  other.seed = 9;
  refused(problem, other, 1);
  AnnealProblem moved = problem;
  moved.retarget.step = {1, 2};
  refused(moved, options, 1);
  for (std::size_t length = 1; length < checkpoint.size(); length += length < 64 ? 1 : 997) {
    other = options;
    other.checkpoint.resume = checkpoint.substr(0, length);
    refused(problem, other, 1);
    EXPECT_THROW(checkpoint_proposals(other.checkpoint.resume), Error);
  }
  for (std::size_t at = 0; at < checkpoint.size(); at += 397) {
    other = options;
    other.checkpoint.resume[at] = static_cast<char>(checkpoint[at] ^ 16);
    refused(problem, other, 1);
  }
}

TEST(Anneal, SeveralChannelsAndResiduals) {
  AnnealProblem problem = small_problem();
  problem.channels.push_back({random_levels({32, 32}, 5, 256), 2});
  problem.channels.push_back({random_levels({32, 32}, 6, 65536), 1});
  AnnealOptions options;
  options.proposals = 10'000'000;
  auto result = anneal_retarget(problem, options);
  expect_true(problem, result);
  EXPECT_LT(result.tile.energy, result.tile.start_energy / 2);

  problem.channels.pop_back();
  problem.retarget.metric = Metric::l2;
  problem.residual_sigma_px = 1.5;
  options.proposals = 300'000;
  result = anneal_retarget(problem, options);
  expect_true(problem, result);
  EXPECT_LT(result.tile.energy, result.tile.start_energy / 20);
}

TEST(Anneal, BetweenTwoMasksComesNearTheOptimum) {
  const auto from = random_levels({24, 24}, 31, 256), to = random_levels({24, 24}, 32, 256);
  for (const double sigma : {0.0, 1.5}) {
    AnnealProblem problem;
    problem.channels = {{.levels = from, .to = to}};
    problem.retarget = {.motion = {1, -2}, .radius = 5, .metric = sigma > 0.0 ? Metric::l2 : Metric::l1};
    problem.residual_sigma_px = sigma;
    const AnnealResult result = anneal_retarget(problem, {.proposals = 2'000'000, .seed = 3});
    EXPECT_EQ(result.tile.energy, anneal_energy(problem, result.tile.move));
    EXPECT_LT(result.tile.energy, result.tile.start_energy / 3);
    EXPECT_NO_THROW(check_permutation(result.tile.move, problem.retarget));
    if (sigma > 0.0) continue;
    EXPECT_EQ(result.tile.energy, retarget_energy({from, to}, result.tile.move, problem.retarget));
    EXPECT_LT(static_cast<double>(result.tile.energy),
              1.10 * static_cast<double>(solve_retarget({from, to}, problem.retarget).energy));
  }
}

TEST(Anneal, TheSecondMaskBelongsToTheCheckpoint) {
  const auto from = random_levels({16, 16}, 33, 256), to = random_levels({16, 16}, 34, 256);
  AnnealProblem problem;
  problem.channels = {{.levels = from, .to = to}};
  problem.retarget.radius = 4;
  AnnealOptions options{.proposals = 100'000, .seed = 1};
  const std::string checkpoint = Annealing(problem, options).checkpoint();
  options.checkpoint.resume = checkpoint;
  EXPECT_NO_THROW(Annealing(problem, options));
  problem.channels[0].to = from;
  EXPECT_THROW(Annealing(problem, options), Error);
}

TEST(Anneal, TinyTilesEnd) {
  for (const Extent size : {Extent{1, 1}, Extent{1, 2}, Extent{5, 1}, Extent{2, 2}}) {
    const AnnealProblem problem = small_problem(size, 3);
    AnnealOptions options;
    options.proposals = 1000;
    expect_true(problem, anneal_retarget(problem, options));
  }
}

TEST(Anneal, GoldenBytes) {
  // Any change of these is a change of algorithm: raise kAnnealVersion and say so in the changelog.
  const AnnealProblem problem = small_problem({37, 29});
  AnnealOptions options;
  options.proposals = 2'000'000;
  const auto hash_of = [](const Grid<Offset>& move) {
    std::uint64_t hash = 0;
    for (const Offset r : move)
      hash = hash * 6364136223846793005u + static_cast<std::uint64_t>((r.x + 128) * 256 + r.y + 128);
    return hash;
  };
  EXPECT_EQ(hash_of(anneal_retarget(problem, options).tile.move), 4075691360301219352u);
  options.schedule = "kirkpatrick";
  EXPECT_EQ(hash_of(anneal_retarget(problem, options).tile.move), 7425575669555666376u);
}

TEST(Anneal, ABudgetInSecondsBecomesProposals) {
  const std::int64_t proposals = proposals_for(0.2, small_problem(), {});
  EXPECT_GT(proposals, 0);
  EXPECT_THROW(proposals_for(0.0, small_problem(), {}), Error);
}

}  // namespace
}  // namespace bn
