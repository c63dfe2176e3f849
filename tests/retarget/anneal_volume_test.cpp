// Protects: on volumes the vector sweep equals its plain statement on every
// instruction set and thread count, running energies equal those of the
// definition, every state is a bijection within reach on three axes, both
// engines sample Boltzmann's distribution, and runs resume; a depth that does
// not fit is refused.
#include <gtest/gtest.h>

#include <ostream>

#include "bn/error.h"
#include "boltzmann.h"

namespace bn {
using namespace retarget;
namespace {

struct Box {
  int width;
  int height;
  int depth;
};

AnnealProblem volume_of(Box box, const RetargetOptions& options, std::int32_t bound, int channels = 1) {
  AnnealProblem problem;
  problem.retarget = options;
  problem.depth = box.depth;
  problem.step_z = 5;
  for (int c = 0; c < channels; ++c) {
    problem.channels.push_back(
        {random_levels({box.width, box.height * box.depth}, static_cast<std::uint64_t>(3 + c), bound),
         1 + 2 * c});
  }
  return problem;
}

/// By the formula, pixel by pixel; also checks reach and bijection in words of
/// its own.
std::int64_t energy_by_definition(const AnnealProblem& problem, const Placement& move) {
  const int width = problem.channels[0].levels.width(), depth = problem.depth;
  const int height = problem.channels[0].levels.height() / depth;
  const RetargetOptions& o = problem.retarget;
  std::vector<int> arrived(move.xy.count(), 0);
  std::int64_t sum = 0;
  for (int z = 0; z < depth; ++z) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Offset r = move.xy(x, z * height + y);
        const int r_z = move.z(x, z * height + y);
        const int k_x = r.x - o.motion.x, k_y = r.y - o.motion.y;
        if (o.reach == Reach::euclidean) {
          EXPECT_LE(k_x * k_x + k_y * k_y + r_z * r_z, o.radius * o.radius);
        } else {
          EXPECT_LE(std::max({std::abs(k_x), std::abs(k_y), std::abs(r_z)}), o.radius);
        }
        const int to_z = wrap(z + r_z, depth), to_y = wrap(y + r.y, height), to_x = wrap(x + r.x, width);
        ++arrived[static_cast<std::size_t>((to_z * height + to_y) * width + to_x)];
        const int at_z = wrap(to_z + problem.step_z, depth), at_y = wrap(to_y + o.step.y, height),
                  at_x = wrap(to_x + o.step.x, width);
        for (const auto& channel : problem.channels) {
          const std::int64_t difference =
              std::int64_t{channel.levels(x, z * height + y)} - channel.levels(at_x, at_z * height + at_y);
          sum += channel.weight * (o.metric == Metric::l2 ? difference * difference : std::abs(difference));
        }
      }
    }
  }
  for (const int count : arrived) EXPECT_EQ(count, 1);
  return sum;
}

struct Case {
  Box box;
  RetargetOptions options;
  std::int32_t bound;
  int channels;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.box.width << "x" << c.box.height << "x" << c.box.depth << " radius " << c.options.radius
             << " euclidean " << (c.options.reach == Reach::euclidean) << " l2 "
             << (c.options.metric == Metric::l2) << " wrap " << c.options.wrap << " levels " << c.bound;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  int n = 0;
  for (const Box box :
       {Box{3, 3, 3}, Box{1, 1, 9}, Box{5, 4, 2}, Box{7, 11, 3}, Box{33, 2, 20}, Box{16, 16, 40}}) {
    for (const Reach reach : {Reach::chebyshev, Reach::euclidean}) {
      for (const Metric metric : {Metric::l1, Metric::l2}) {
        for (const bool wraps : {true, false}) {
          RetargetOptions options;
          options.radius = std::array{6, 1, 3, 2, 32}[static_cast<std::size_t>(n % 5)];
          options.reach = reach;
          options.metric = metric;
          options.wrap = wraps;
          options.step = {5 + n, -3};
          options.motion = {n % 5 - 2, n % 3 - 1};
          const auto [bound, channels] = std::array<std::pair<int, int>, 4>{
              {{256, 1}, {1 << 16, 1}, {256, 3}, {1 << 20, 1}}}[static_cast<std::size_t>(n % 4)];
          cases.push_back({box, options, bound, channels});
          ++n;
        }
      }
    }
  }
  return cases;
}

TEST(AnnealVolume, EveryInstructionSetAndThreadCountEqualsThePlainStatement) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const AnnealProblem problem = volume_of(c.box, c.options, c.bound, c.channels);
    const AnnealInstance instance(problem, 0);
    for (const double temperature : {0.1 * static_cast<double>(instance.largest_change), 0.0}) {
      const auto plain = make_sweep_engine(instance, 5, 2);
      RoundCounts expected;
      WorseningCounts worsenings;
      for (int round = 0; round < 2; ++round)
        expected += plain->round(round, 9, temperature, {}, &worsenings);
      EXPECT_EQ(plain->energy(), energy_by_definition(problem, instance.moves_of(plain->displacements())));
      EXPECT_NO_THROW(instance.check_moves(instance.moves_of(plain->displacements())));
      EXPECT_EQ(instance.displacements_of(instance.moves_of(plain->displacements())), plain->displacements());
      for (const std::string& name : instruction_sets()) {
        use_instruction_set(name);
        const auto engine = make_sweep_engine(instance, 5, 2);
        RoundCounts counts;
        for (int round = 0; round < 2; ++round)
          counts += engine->round(round, 9, temperature, {.threads = 3});
        use_instruction_set("");
        EXPECT_EQ(engine->displacements(), plain->displacements()) << name << " T " << temperature;
        EXPECT_EQ(engine->energy(), plain->energy()) << name;
        EXPECT_EQ(counts.accepted, expected.accepted) << name;
        EXPECT_EQ(counts.changed, expected.changed) << name;
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(AnnealVolume, TheScalarEngineKeepsItsEnergyAndItsReach) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const AnnealProblem problem = volume_of(c.box, c.options, c.bound, c.channels);
    const AnnealInstance instance(problem, 0);
    const auto engine = make_scalar_engine(instance, 5, 2);
    for (int round = 0; round < 3; ++round) engine->round(round, 9, 0.05 * static_cast<double>(c.bound), {});
    EXPECT_EQ(engine->energy(), energy_by_definition(problem, instance.moves_of(engine->displacements())));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(AnnealVolume, BothEnginesSampleBoltzmannsDistribution) {
  constexpr double kTemperature = 4.0;
  struct Setting {
    Box box;
    RetargetOptions options;
  };
  for (const Setting& s : {Setting{{2, 2, 2}, {.step = {1, 0}, .radius = 1}},
                           Setting{{2, 1, 4}, {.step = {1, 0}, .radius = 2, .reach = Reach::euclidean}},
                           Setting{{4, 1, 2}, {.step = {1, 0}, .radius = 1, .wrap = false}}}) {
    const AnnealProblem problem = volume_of(s.box, s.options, 6);
    const AnnealInstance instance(problem, 2 * s.options.radius);
    const std::size_t n = instance.identity().xy.count();
    std::vector<std::vector<std::int64_t>> cost(n, std::vector<std::int64_t>(n, kForbidden));
    for (std::size_t q = 0; q < n; ++q) {
      for (std::size_t w = 0; w < n; ++w) {
        const Shift from = instance.position(q), to = instance.position(w);
        Shift k{to.x - from.x, to.y - from.y, to.z - from.z};
        if (s.options.wrap) {
          k = {wrap_centred(k.x, s.box.width), wrap_centred(k.y, s.box.height),
               wrap_centred(k.z, s.box.depth)};
        }
        if (!within_reach(k, s.options)) continue;
        cost[q][w] = std::abs(instance.seed_level[0][q] - instance.landing_level[0][w]);
      }
    }
    const auto shares = boltzmann(cost, kTemperature);
    for (const bool scalar : {false, true}) {
      SCOPED_TRACE(testing::Message() << "scalar " << scalar << ", depth " << s.box.depth);
      expect_samples(*(scalar ? make_scalar_engine : make_sweep_engine)(instance, 1, 0), shares, kTemperature,
                     3);
    }
  }
}

TEST(AnnealVolume, RunsCoolTraceAndResume) {
  for (const auto coupling : {ChainOptions::Coupling::independent, ChainOptions::Coupling::tempering}) {
    const AnnealProblem problem = volume_of({16, 12, 10}, {.step = {7, 5}, .radius = 3}, 256);
    AnnealOptions options;
    options.proposals = 6'000'000;
    options.chains = {.count = 2, .coupling = coupling};
    const AnnealResult whole = anneal_retarget(problem, options, {.threads = 2});
    EXPECT_NO_THROW(check_anneal_permutation(problem, whole.tile.move, whole.move_z));
    EXPECT_EQ(whole.tile.energy, anneal_energy(problem, whole.tile.move, whole.move_z));
    EXPECT_EQ(whole.tile.energy, energy_by_definition(problem, {whole.tile.move, whole.move_z}));
    EXPECT_LT(whole.tile.energy, whole.tile.start_energy / 20);
    std::vector<std::string> checkpoints;
    options.checkpoint.interval_s = 0.0;
    options.checkpoint.save = [&](std::string_view bytes) { checkpoints.emplace_back(bytes); };
    anneal_retarget(problem, options);
    options.checkpoint.save = {};
    options.checkpoint.resume = checkpoints.at(checkpoints.size() / 2);
    const AnnealResult resumed = anneal_retarget(problem, options);
    EXPECT_EQ(resumed.tile.move, whole.tile.move);
    EXPECT_EQ(resumed.move_z, whole.move_z);
  }
}

TEST(AnnealVolume, WhatDoesNotFitIsRefused) {
  const auto message_of = [](const AnnealProblem& problem) {
    try {
      anneal_retarget(problem, {.proposals = 1000});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  AnnealProblem problem = volume_of({4, 4, 3}, {.step = {1, 1}, .radius = 1}, 9);
  for (const int depth : {0, -3, 5, 24, 1 << 20}) {
    problem.depth = depth;
    EXPECT_NE(message_of(problem).find("depth"), std::string::npos) << depth;
  }
  problem.depth = 3;
  problem.retarget.metric = Metric::l2;
  problem.residual_sigma_px = 1.0;
  EXPECT_NE(message_of(problem).find("residual_sigma: a filtered residual of a volume"), std::string::npos);
  problem.residual_sigma_px = 0.0;
  const AnnealResult result = anneal_retarget(problem, {.proposals = 1000});
  EXPECT_THROW(anneal_energy(problem, result.tile.move), Error) << "without its third axis";
  Grid<std::int8_t> wrong = result.move_z;
  wrong[5] = static_cast<std::int8_t>(wrong[5] == 1 ? 0 : 1);
  EXPECT_THROW(check_anneal_permutation(problem, result.tile.move, wrong), Error);
}

}  // namespace
}  // namespace bn
