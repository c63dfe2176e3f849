// Protects: the cases that break annealers: 1e10 proposals, 16 bit and float
// samples, two levels, tori smaller than the reach. Constant images,
// temperatures 0 and infinite and optimal starts are in anneal_engine_test.cpp,
// Boltzmann's distribution in anneal_balance_test.cpp, Hajek's constant in
// anneal_cooling_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "anneal/checkpoint.h"
#include "bn/random.h"
#include "bn/retarget_anneal.h"
#include "bn/texture.h"
#include "reference.h"
#include "retarget/anneal_task.h"

namespace bn {
using namespace retarget;
namespace {

AnnealProblem problem_of(Grid<std::int32_t> levels, const RetargetOptions& options) {
  AnnealProblem problem;
  problem.channels = {{std::move(levels)}};
  problem.retarget = options;
  return problem;
}

TEST(AnnealHardCases, TenThousandMillionProposals) {
  // A run that has 1e10 proposals behind it, in rounds about to pass 2^32, goes
  // on to its end. The whole way is gone by the command in docs/annealing.md.
  const AnnealProblem problem = problem_of(random_levels({32, 32}, 4, 256), {.step = {11, 7}});
  AnnealOptions options;
  options.proposals = 10'160'000'000;  // the last 64th is spent at 0, so it
                                       // begins just after 1e10
  const AnnealInstance instance(problem, 0);
  anneal::ChainRecord chain;
  chain.proposals = chain.cooling.step = 9'999'000'000;
  chain.accepted = 5'000'000'000;
  chain.round = (std::int64_t{1} << 32) - 20;
  chain.now = chain.best = placement_bytes(instance.identity());
  anneal::RunRecord record{.proposals = options.proposals, .slices = 1000, .chains = {chain}};
  options.checkpoint.resume = anneal::encode_checkpoint(fingerprint_of(problem, options), record);
  Annealing run(problem, options, {.threads = 1});
  const AnnealState before = run.state();
  EXPECT_EQ(before.proposals, 9'999'000'000);
  double temperature = std::numeric_limits<double>::infinity();
  std::int64_t proposals = before.proposals;
  while (proposals < 10'003'000'000) {
    run.sweep();
    const AnnealState state = run.state();
    EXPECT_GT(state.proposals, proposals);
    EXPECT_LE(state.temperature, temperature);
    proposals = state.proposals;
    temperature = state.temperature;
  }
  EXPECT_EQ(temperature, 0.0);
  EXPECT_GT(run.state().accepted, 5'000'000'000);
  EXPECT_EQ(run.state().energy, anneal_energy(problem, run.move()));
  EXPECT_LT(run.state().energy, run.result().tile.start_energy / 4);
  EXPECT_EQ(run.result().tile.energy, anneal_energy(problem, run.result().tile.move));
}

TEST(AnnealHardCases, ALongRunDoesNotDrift) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
  constexpr std::int64_t kProposals = 20'000'000;
#else
  constexpr std::int64_t kProposals = 2'300'000'000;  // beyond 2^31
#endif
  const AnnealProblem problem = problem_of(random_levels({64, 64}, 4, 256), {.step = {11, 7}});
  AnnealOptions options;
  options.proposals = kProposals;
  options.start = {StartTemperature::Rule::given, 1.0};
  options.end_temperature = 0.5;
  const AnnealResult result = anneal_retarget(problem, options);
  EXPECT_GE(result.proposals, kProposals);
  EXPECT_EQ(result.tile.energy, anneal_energy(problem, result.tile.move));
  EXPECT_EQ(result.tile.energy,
            retarget_energy(problem.channels[0].levels, result.tile.move, problem.retarget));
}

TEST(AnnealHardCases, SixteenBitSamplesAreExact) {
  Image image{.size = {24, 20}, .channels = 1, .type = SampleType::u16, .samples = {}};
  std::vector<std::uint16_t> samples;
  for (std::uint64_t i = 0; i < 480; ++i) samples.push_back(static_cast<std::uint16_t>(random_bits(1, 0, i)));
  image.samples.resize(960);
  std::memcpy(image.samples.data(), samples.data(), 960);
  const Levels levels = levels_of_channel(image, 0);
  EXPECT_EQ(levels.rounding_error, 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(levels.value[i], samples[i]);
  for (const Metric metric : {Metric::l1, Metric::l2}) {
    const AnnealProblem problem = problem_of(levels.value, {.step = {7, 5}, .metric = metric});
    const AnnealResult result = anneal_retarget(problem, {.proposals = 5'000'000});
    EXPECT_EQ(result.tile.energy, retarget_energy(levels.value, result.tile.move, problem.retarget));
    EXPECT_LT(result.tile.energy, result.tile.start_energy / 4);
  }
}

TEST(AnnealHardCases, FloatSamplesKeepTheStatedError) {
  const Extent size{24, 20};
  std::vector<float> samples;
  for (std::uint64_t i = 0; i < 480; ++i)
    samples.push_back(-3.0f + 8.0f * static_cast<float>(random_bits(2, 0, i) >> 40) * 0x1p-24f);
  Image image{.size = size, .channels = 1, .type = SampleType::f32, .samples = {}};
  image.samples.resize(480 * 4);
  std::memcpy(image.samples.data(), samples.data(), 480 * 4);
  const Levels levels = levels_of_channel(image, 0);
  EXPECT_GT(levels.rounding_error, 0.0);
  EXPECT_LE(levels.rounding_error, 0.5 * levels.unit * (1.0 + 1e-9));
  const AnnealProblem problem = problem_of(levels.value, {.step = {7, 5}});
  const AnnealResult result = anneal_retarget(problem, {.proposals = 5'000'000});
  double energy = 0.0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Offset r = result.tile.move(x, y);
      const int to_x = wrap(x + r.x + 7, size.width), to_y = wrap(y + r.y + 5, size.height);
      energy += std::fabs(double{samples[static_cast<std::size_t>(y * size.width + x)]} -
                          double{samples[static_cast<std::size_t>(to_y * size.width + to_x)]});
    }
  }
  // Each difference is of two samples, each off by the rounding error at most.
  EXPECT_NEAR(static_cast<double>(result.tile.energy) * levels.unit, energy,
              2.0 * 480.0 * levels.rounding_error);
}

TEST(AnnealHardCases, TwoLevels) {
  const AnnealProblem problem = problem_of(random_levels({32, 32}, 8, 2), {.step = {9, 13}, .radius = 3});
  const RetargetTile exact = solve_retarget(problem.channels[0].levels, problem.retarget);
  for (const auto name : schedule_names()) {
    AnnealOptions options;
    options.schedule = name;
    options.proposals = 4'000'000;
    const AnnealResult result = anneal_retarget(problem, options);
    EXPECT_EQ(result.tile.energy, anneal_energy(problem, result.tile.move));
    EXPECT_GE(result.tile.energy, exact.energy);
    EXPECT_LT(result.tile.energy, result.tile.start_energy / 4) << name;
    // Plateaus are easy to cross: nothing has to be climbed here.
    if (name == "greedy") {
      EXPECT_LE(result.tile.energy, exact.energy + 16);
    }
  }
}

TEST(AnnealHardCases, ToriSmallerThanTheReach) {
  for (const Extent size :
       {Extent{1, 9}, Extent{9, 1}, Extent{1, 40}, Extent{3, 3}, Extent{7, 11}, Extent{13, 13}}) {
    for (const Reach reach : {Reach::chebyshev, Reach::euclidean}) {
      SCOPED_TRACE(testing::Message() << size.width << "x" << size.height);
      const AnnealProblem problem = problem_of(
          random_levels(size, 6, 64), {.step = {2, 4}, .motion = {1, -2}, .radius = 6, .reach = reach});
      const AnnealResult result = anneal_retarget(problem, {.proposals = 300'000});
      EXPECT_NO_THROW(check_permutation(result.tile.move, problem.retarget));
      EXPECT_EQ(result.tile.energy, anneal_energy(problem, result.tile.move));
      const RetargetTile exact = solve_retarget(problem.channels[0].levels, problem.retarget);
      EXPECT_GE(result.tile.energy, exact.energy);
      for (const Offset r : result.tile.move) {
        // Of the offsets that name one pixel the nearest to the motion is
        // stored.
        EXPECT_EQ(r.x - 1, wrap_centred(r.x - 1, size.width));
        EXPECT_EQ(r.y + 2, wrap_centred(r.y + 2, size.height));
      }
    }
  }
}

}  // namespace
}  // namespace bn
