// Protects: an annealing taken in parts makes the bytes of one taken in one go; what it says of itself
// between two parts is true; one sweep is one sweep.
#include <gtest/gtest.h>

#include <utility>

#include "bn/error.h"
#include "bn/retarget_anneal.h"
#include "reference.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;
namespace {

struct Setting {
  AnnealProblem problem;
  AnnealOptions options;
};

/// One of each kind of engine, schedule and coupling that stops differently.
std::vector<Setting> settings() {
  std::vector<Setting> all(4);
  for (auto& s : all) {
    s.problem.channels = {{random_levels({32, 32}, 4, 256)}};
    s.problem.retarget.step = {11, 7};
    s.options.proposals = 8'000'000;
  }
  all[1].options.schedule = "kirkpatrick";
  all[1].options.chains.count = 2;
  all[2].options.chains = {.count = 3, .coupling = ChainOptions::Coupling::tempering};
  all[2].options.proposals = 2'000'000;
  all[3].problem.retarget.metric = Metric::l2;
  all[3].problem.residual_sigma_px = 1.0;
  all[3].options.proposals = 100'000;
  return all;
}

void expect_true(const AnnealProblem& problem, const Annealing& annealing) {
  EXPECT_EQ(annealing.state().energy, anneal_energy(problem, annealing.move()));
  EXPECT_LE(annealing.state().best_energy, annealing.result().tile.start_energy);
}

TEST(AnnealParts, AnyMixtureOfSlicesAndSweepsEndsTheSame) {
  for (const auto& [problem, options] : settings()) {
    const AnnealResult whole = anneal_retarget(problem, options);
    for (const int pattern : {0, 1, 3, 200}) {
      AnnealTrace trace;
      Annealing annealing(problem, options, {.threads = 2}, &trace);
      expect_true(problem, annealing);
      for (int i = 0; !annealing.state().done; ++i) {
        // Pattern 0: slices only; else so many sweeps, a slice, and so on.
        if (pattern == 0 || i % (pattern + 1) == pattern) {
          annealing.advance();
        } else {
          annealing.sweep();
        }
        if (i % 97 == 0) expect_true(problem, annealing);
      }
      const AnnealResult parts = annealing.result();
      EXPECT_EQ(parts.tile.move, whole.tile.move) << pattern;
      EXPECT_EQ(parts.accepted, whole.accepted) << pattern;
      EXPECT_EQ(parts.proposals, whole.proposals) << pattern;
      EXPECT_EQ(trace[0].proposals, 0);
      EXPECT_EQ(trace[0].energy, whole.tile.start_energy);
      EXPECT_EQ(trace[trace.size() - 1].proposals, annealing.state().proposals);
      annealing.advance();
      annealing.sweep();
      EXPECT_EQ(annealing.result().tile.move, whole.tile.move) << "it went on after its end";
    }
  }
}

TEST(AnnealParts, AStoppedRunIsMadeAgain) {
  for (auto& [problem, options] : settings()) {
    if (options.chains.count > 1) continue;
    Annealing stopped(problem, options);
    std::int64_t before = -1;
    for (int i = 0; i < 40; ++i) {
      i % 3 == 0 ? stopped.advance() : stopped.sweep();
      const AnnealResult result = stopped.result();
      if (result.proposals == std::exchange(before, result.proposals) || result.proposals == 0) continue;
      AnnealOptions again = options;
      again.stop_after = result.proposals;
      const AnnealResult made = anneal_retarget(problem, again);
      EXPECT_EQ(made.tile.move, result.tile.move);
      EXPECT_EQ(made.tile.energy, result.tile.energy);
      EXPECT_EQ(made.proposals, result.proposals);
      EXPECT_EQ(made.accepted, result.accepted);
    }
    for (const std::int64_t outside : {std::int64_t{-1}, options.proposals + 1}) {
      options.stop_after = outside;
      EXPECT_THROW(anneal_retarget(problem, options), Error);
    }
  }
}

TEST(AnnealParts, TellsTheScheduleThatItsOptionsCameTo) {
  auto [problem, options] = settings().front();
  options.start = {StartTemperature::Rule::given, 5.0};
  options.end_temperature = 0.5;
  const auto made = std::get<ExponentialCooling>(Annealing(problem, options).schedule());
  EXPECT_EQ(made.start, 5.0);
  // The last 64th of the budget is spent at temperature 0.
  EXPECT_NEAR(made.at(static_cast<double>(options.proposals - options.proposals / 64)), 0.5, 1e-9);
  options.end_temperature = 0.0;
  options.parameters.factor = 0.5;  // whose end is too cold for a double
  EXPECT_EQ(std::get<ExponentialCooling>(Annealing(problem, options).schedule()).factor, 0.5);
}

TEST(AnnealParts, ASweepProposesAtMostHalfThePixels) {
  for (const auto& [problem, options] : settings()) {
    Annealing annealing(problem, options);
    std::int64_t before = 0, watched = 0;
    for (int i = 0; i < 40; ++i) {
      annealing.sweep();
      const AnnealState state = annealing.state();
      EXPECT_GT(state.proposals, before);
      EXPECT_LE(state.proposals - before, problem.channels[0].levels.size().area() / 2);
      std::int64_t tried = 0;
      for (const auto count : state.worsening_tried) tried += count;
      EXPECT_LE(tried, state.proposals - before);
      watched += tried;  // of one sweep it may be 0: where it swaps farther than the reach
      before = state.proposals;
    }
    EXPECT_GT(watched, 0);
  }
}

TEST(AnnealParts, SweepsOneByOneAreTheRound) {
  for (const auto& [problem, options] : settings()) {
    const AnnealInstance instance(problem, 0);
    const auto whole = make_engine(instance, 5, 0), parts = make_engine(instance, 5, 0);
    for (std::int64_t round = 0; round < 3; ++round) {
      const RoundCounts expected = whole->round(round, 6, 20.0, {.threads = 1});
      RoundCounts counts;
      for (int i = 0; i < 6; ++i) counts += parts->sweeps(round, i, i + 1, 20.0, {.threads = 1});
      EXPECT_EQ(counts.proposals, expected.proposals);
      EXPECT_EQ(counts.accepted, expected.accepted);
      EXPECT_EQ(parts->displacements(), whole->displacements());
      EXPECT_EQ(parts->energy(), whole->energy());
    }
  }
}

TEST(AnnealParts, ResumedFromACheckpointItGoesOn) {
  auto [problem, options] = settings().front();
  std::string last;
  options.checkpoint = {.save = [&](std::string_view bytes) { last = bytes; }, .interval_s = 0.0};
  const AnnealResult whole = anneal_retarget(problem, options);
  options.checkpoint = {.resume = last};
  Annealing annealing(problem, options);
  EXPECT_GT(annealing.state().proposals, 0);
  while (!annealing.state().done) annealing.sweep();
  EXPECT_EQ(annealing.result().tile.move, whole.tile.move);
}

TEST(AnnealParts, RefusesWhatARunRefuses) {
  auto [problem, options] = settings().front();
  options.proposals = 0;
  EXPECT_THROW(Annealing(problem, options), Error);
  options.proposals = 1;
  EXPECT_THROW(Annealing(problem, options, {.threads = -1}), Error);
}

}  // namespace
}  // namespace bn
