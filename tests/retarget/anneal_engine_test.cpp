// Protects: the vector sweep equals its plain statement bit for bit on every
// instruction set, thread count, size, reach, border, metric and number of
// channels; running energies equal recomputed ones; every state is a
// permutation within reach.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "reference.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;
namespace {

AnnealProblem problem_of(Extent size, const RetargetOptions& options, std::int32_t bound, int channels = 1) {
  AnnealProblem problem;
  problem.retarget = options;
  for (int c = 0; c < channels; ++c) {
    problem.channels.push_back(
        {random_levels(size, static_cast<std::uint64_t>(17 + c), bound), channels == 1 ? 1 : 1 + 2 * c});
  }
  return problem;
}

/// The energy by bn/anneal.h's formula, from the moves alone.
std::int64_t energy_by_definition(const AnnealProblem& problem, const Grid<Offset>& move) {
  std::int64_t sum = 0;
  for (const auto& channel : problem.channels) {
    sum += channel.weight * retarget_energy(channel.levels, move, problem.retarget);
  }
  return sum;
}

struct Case {
  Extent size;
  RetargetOptions options;
  std::int32_t bound;
  int channels;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.size.width << "x" << c.size.height << " radius " << c.options.radius << " euclidean "
             << (c.options.reach == Reach::euclidean) << " l2 " << (c.options.metric == Metric::l2)
             << " wrap " << c.options.wrap << " levels " << c.bound << " channels " << c.channels;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const std::vector<Extent> sizes{{1, 1},   {1, 7},   {9, 1},   {2, 2},   {3, 3},
                                  {7, 11},  {13, 13}, {14, 12}, {25, 3},  {31, 33},
                                  {32, 32}, {64, 64}, {65, 20}, {100, 7}, {33, 130}};
  int n = 0;
  for (const Extent size : sizes) {
    for (const Reach reach : {Reach::chebyshev, Reach::euclidean}) {
      for (const Metric metric : {Metric::l1, Metric::l2}) {
        for (const bool wraps : {true, false}) {
          RetargetOptions options;
          options.radius = std::array{6, 1, 3, 32}[static_cast<std::size_t>(n % 4)];
          options.reach = reach;
          options.metric = metric;
          options.wrap = wraps;
          options.step = {5 + n, -3};
          options.motion = {n % 5 - 2, n % 3 - 1};
          const auto [bound, channels] = std::array<std::pair<int, int>, 5>{
              {{256, 1}, {2, 1}, {1 << 16, 1}, {1 << 24, 1}, {256, 3}}}[static_cast<std::size_t>(n % 5)];
          cases.push_back({size, options, bound, channels});
          ++n;
        }
      }
    }
  }
  return cases;
}

TEST(AnnealEngine, EveryInstructionSetEqualsThePlainStatement) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const AnnealProblem problem = problem_of(c.size, c.options, c.bound, c.channels);
    const AnnealInstance instance(problem, c.size.height % 2 == 0 ? 0 : 2 * c.options.radius);
    // Hot, warm and cold by the levels' scale.
    const double scale = static_cast<double>(instance.largest_change);
    for (const double temperature : {scale, 0.01 * scale, 0.0}) {
      const auto plain = make_sweep_engine(instance, 5, 2);
      RoundCounts expected;
      WorseningCounts worsenings;
      for (int round = 0; round < 2; ++round)
        expected += plain->round(round, 9, temperature, {}, &worsenings);
      EXPECT_EQ(plain->energy(), energy_by_definition(problem, instance.moves_of(plain->displacements()).xy));
      EXPECT_NO_THROW(check_permutation(instance.moves_of(plain->displacements()).xy, c.options));
      for (const std::string& name : instruction_sets()) {
        use_instruction_set(name);
        const auto engine = make_sweep_engine(instance, 5, 2);
        RoundCounts counts;
        for (int round = 0; round < 2; ++round)
          counts += engine->round(round, 9, temperature, {.threads = 2});
        use_instruction_set("");
        EXPECT_EQ(engine->displacements(), plain->displacements()) << name << " T " << temperature;
        EXPECT_EQ(engine->energy(), plain->energy()) << name;
        EXPECT_EQ(counts.proposals, expected.proposals) << name;
        EXPECT_EQ(counts.accepted, expected.accepted) << name;
        EXPECT_EQ(counts.changed, expected.changed) << name;
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(AnnealEngine, ThreadsChangeNothing) {
  const AnnealProblem problem = problem_of({48, 320}, {.step = {11, 30}}, 256);
  const AnnealInstance instance(problem, 0);
  Placement expected;
  for (const int threads : {1, 2, 3, 7}) {
    const auto engine = make_sweep_engine(instance, 1, 0);
    for (int round = 0; round < 5; ++round) engine->round(round, 20, 10.0, {.threads = threads});
    if (threads == 1) expected = engine->displacements();
    EXPECT_EQ(engine->displacements(), expected) << threads;
    EXPECT_EQ(engine->energy(), anneal_energy(problem, instance.moves_of(engine->displacements()).xy));
  }
}

TEST(AnnealEngine, TheScalarEngineKeepsItsEnergyAndItsReach) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const AnnealProblem problem = problem_of(c.size, c.options, c.bound, c.channels);
    const AnnealInstance instance(problem, 0);
    const auto engine = make_scalar_engine(instance, 5, 2);
    const std::int64_t start = engine->energy();
    EXPECT_EQ(start, energy_by_definition(problem, instance.moves_of(Grid<Offset>(c.size)).xy));
    for (int round = 0; round < 3; ++round) engine->round(round, 9, 0.05 * static_cast<double>(c.bound), {});
    const auto move = instance.moves_of(engine->displacements()).xy;
    EXPECT_EQ(engine->energy(), energy_by_definition(problem, move));
    EXPECT_NO_THROW(check_permutation(move, c.options));
  }
}

TEST(AnnealEngine, PlacedWhereAnotherStopped) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const AnnealProblem problem = problem_of(c.size, c.options, c.bound, c.channels);
    const AnnealInstance instance(problem, 0);
    for (const bool scalar : {false, true}) {
      const auto make = scalar ? make_scalar_engine : make_sweep_engine;
      const auto whole = make(instance, 9, 1), first = make(instance, 9, 1), second = make(instance, 9, 1);
      for (int round = 0; round < 4; ++round) whole->round(round, 3, 8.0, {});
      for (int round = 0; round < 2; ++round) first->round(round, 3, 8.0, {});
      second->place(first->displacements());
      EXPECT_EQ(second->energy(), first->energy());
      for (int round = 2; round < 4; ++round) second->round(round, 3, 8.0, {});
      EXPECT_EQ(second->displacements(), whole->displacements());
      EXPECT_EQ(second->energy(), whole->energy());
      // There and back: moves name the same placement.
      EXPECT_EQ(instance.displacements_of(instance.moves_of(whole->displacements())), whole->displacements());
    }
  }
}

TEST(AnnealEngine, RoundsBeyond32BitsDrawTheirOwnNumbers) {
  const AnnealProblem problem = problem_of({16, 16}, {.step = {5, 7}}, 256);
  const AnnealInstance instance(problem, 0);
  for (const bool scalar : {false, true}) {
    const auto make = scalar ? make_scalar_engine : make_sweep_engine;
    const auto low = make(instance, 1, 0), high = make(instance, 1, 0);
    low->round(3, 8, 100.0, {});
    high->round(3 + (std::int64_t{1} << 32), 8, 100.0, {});
    EXPECT_NE(low->displacements(), high->displacements());
    EXPECT_EQ(high->energy(), anneal_energy(problem, instance.moves_of(high->displacements()).xy));
  }
}

TEST(AnnealEngine, ConstantImageEverySwapIsFree) {
  AnnealProblem problem;
  problem.channels = {{Grid<std::int32_t>({32, 32}, 77)}};
  problem.retarget.step = {3, 4};
  const AnnealInstance instance(problem, 0);
  for (const bool scalar : {false, true}) {
    const auto engine = (scalar ? make_scalar_engine : make_sweep_engine)(instance, 1, 0);
    WorseningCounts worsenings;
    const auto counts = engine->round(0, 50, 0.0, {}, &worsenings);
    EXPECT_EQ(engine->energy(), 0);
    EXPECT_EQ(counts.accepted, worsenings.within_reach);
    EXPECT_EQ(counts.changed, 0);
    EXPECT_GT(counts.accepted, 0);
  }
}

TEST(AnnealEngine, TemperatureZeroNeverClimbsAndInfinityTakesAll) {
  const AnnealProblem problem = problem_of({40, 30}, {.step = {9, 4}}, 256);
  const AnnealInstance instance(problem, 0);
  for (const bool scalar : {false, true}) {
    const auto engine = (scalar ? make_scalar_engine : make_sweep_engine)(instance, 1, 0);
    WorseningCounts hot;
    const auto counts = engine->round(0, 60, std::numeric_limits<double>::infinity(), {}, &hot);
    EXPECT_EQ(counts.accepted, hot.within_reach);
    std::int64_t energy = engine->energy();
    for (int round = 1; round < 50; ++round) {
      WorseningCounts cold;
      engine->round(round, 4, 0.0, {}, &cold);
      EXPECT_LE(engine->energy(), energy);
      energy = engine->energy();
      for (const auto accepted : cold.accepted) EXPECT_EQ(accepted, 0);
    }
    EXPECT_LT(energy, anneal_energy(problem, Grid<Offset>({40, 30})) / 2);
  }
}

TEST(AnnealEngine, AnOptimalStartStaysOptimalAtZero) {
  const AnnealProblem problem = problem_of({24, 24}, {.step = {9, 4}, .radius = 3}, 64);
  const auto exact = solve_retarget(problem.channels[0].levels, problem.retarget);
  const AnnealInstance instance(problem, 0);
  for (const bool scalar : {false, true}) {
    const auto engine = (scalar ? make_scalar_engine : make_sweep_engine)(instance, 1, 0);
    engine->place(instance.displacements_of(exact.move));
    EXPECT_EQ(engine->energy(), exact.energy);
    const auto counts = engine->round(0, 200, 0.0, {});
    EXPECT_EQ(engine->energy(), exact.energy);
    EXPECT_EQ(counts.changed, 0);
  }
}

TEST(AnnealEngine, TheFilteredResidualIsItsDefinition) {
  for (const Extent size : {Extent{20, 17}, Extent{5, 3}, Extent{1, 9}}) {
    AnnealProblem problem = problem_of(size, {.step = {3, 1}, .metric = Metric::l2}, 64, 2);
    problem.residual_sigma_px = 1.5;
    const AnnealInstance instance(problem, 0);
    const auto engine = make_engine(instance, 1, 0);
    const std::int64_t start = engine->energy();
    double temperature = static_cast<double>(start) / 50.0;
    for (int round = 0; round < 40; ++round, temperature *= 0.8) engine->round(round, 5, temperature, {});
    const auto move = instance.moves_of(engine->displacements()).xy;
    EXPECT_EQ(engine->energy(), anneal_energy(problem, move));
    EXPECT_NO_THROW(check_permutation(move, problem.retarget));
    EXPECT_LE(engine->energy(), start);

    // From the formula: blur the difference on the torus, square, add; the
    // integer Gaussian for sigma 1.5 is known by its shares, which are right to
    // half a 256th.
    double sum = 0.0;
    std::vector<double> g;
    for (int i = -5; i <= 5; ++i)
      g.push_back(std::floor(256.0 * std::exp(-i * i / 4.5) / 3.7599424119465 + 0.5));
    for (const auto& channel : problem.channels) {
      Grid<double> residual(size);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const int to_x = wrap(x + move(x, y).x + 3, size.width),
                    to_y = wrap(y + move(x, y).y + 1, size.height);
          residual(to_x, to_y) = channel.levels(x, y) - channel.levels(to_x, to_y);
        }
      }
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          double blurred = 0.0;
          for (int j = -5; j <= 5; ++j) {
            for (int i = -5; i <= 5; ++i) blurred += g[i + 5] * g[j + 5] * residual.torus(x + i, y + j);
          }
          sum += channel.weight * blurred * blurred;
        }
      }
    }
    EXPECT_NEAR(static_cast<double>(engine->energy()), sum, 1e-9 * sum + 0.5)
        << size.width << "x" << size.height;
  }
}

}  // namespace
}  // namespace bn
