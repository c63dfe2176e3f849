// Protects: every schedule is its published formula, starts and ends where it says, never heats, and is
// refused with its name and range outside them; Hajek's constant decides between converging and sticking.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "anneal/cooling.h"
#include "bn/anneal.h"
#include "bn/error.h"

namespace bn {
using namespace anneal;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double temperature_at(const CoolingSchedule& schedule, std::int64_t step) {
  Cooling cooling(schedule);
  if (step > 0) cooling.advance(step, 0, 0);
  return cooling.temperature();
}

TEST(Cooling, TheFormulas) {
  for (const double k : {0.0, 1.0, 7.0, 1e3, 1e6, 1e10}) {
    EXPECT_NEAR(HajekCooling{5.0}.at(k), 5.0 / std::log(k + 2.0), 1e-13 * 5.0);
    EXPECT_NEAR((LinearCooling{9.0, 1e-6, 0.5}.at(k)), std::max(9.0 - 1e-6 * k, 0.5), 1e-13);
    EXPECT_NEAR((ExponentialCooling{9.0, 0.999}.at(k)), 9.0 * std::pow(0.999, k), 1e-11);
    EXPECT_NEAR((InverseCooling{9.0, 0.01}.at(k)), 9.0 / (1.0 + 0.01 * k), 1e-13);
    EXPECT_EQ(ConstantCooling{3.0}.at(k), 3.0);
    EXPECT_EQ(GreedyCooling{}.at(k), 0.0);
  }
  for (const int s : {0, 1, 2, 50}) {
    EXPECT_NEAR((KirkpatrickCooling{.start = 8.0, .factor = 0.9}.at_stage(s)), 8.0 * std::pow(0.9, s), 1e-13);
  }
}

TEST(Cooling, MadeToCompareTheyMeetStartAndEndAndNeverHeat) {
  constexpr double kStart = 40.0, kEnd = 0.3;
  for (const std::int64_t budget : {std::int64_t{1000}, std::int64_t{1000000000}, std::int64_t{1} << 40}) {
    for (const auto name : schedule_names()) {
      const auto schedule = make_schedule(name, kStart, kEnd, budget);
      EXPECT_EQ(name_of(schedule), name);
      if (name == "greedy") continue;
      const double start = name == "constant" ? kEnd
                           : name == "hajek"
                               ? kEnd * std::log(static_cast<double>(budget) + 2.0) / std::log(2.0)
                               : kStart;
      EXPECT_NEAR(temperature_at(schedule, 0), start, 1e-9) << name;
      Cooling cooling(schedule);
      double previous = kInfinity;
      for (int i = 0; i < 200; ++i) {
        EXPECT_LE(cooling.temperature(), previous) << name << " " << i;
        previous = cooling.temperature();
        cooling.advance(budget / 200, budget / 2000, 1);
      }
      EXPECT_NEAR(cooling.temperature(), kEnd, 1e-4) << name;
    }
  }
}

TEST(Cooling, KirkpatrickStagesEndOnAcceptedOrTriedSwaps) {
  const KirkpatrickCooling schedule{
      .start = 8.0, .factor = 0.5, .accepted_per_stage = 10, .tried_per_stage = 100};
  Cooling cooling(schedule);
  cooling.advance(20, 9, 3);
  EXPECT_EQ(cooling.temperature(), schedule.at_stage(0));
  cooling.advance(20, 1, 0);
  EXPECT_EQ(cooling.temperature(), schedule.at_stage(1)) << "ten accepted";
  cooling.advance(99, 0, 0);
  EXPECT_EQ(cooling.temperature(), schedule.at_stage(1));
  cooling.advance(1, 0, 0);
  EXPECT_EQ(cooling.temperature(), schedule.at_stage(2)) << "a hundred tried";
  EXPECT_EQ(cooling.progress().step, 140);
}

TEST(Cooling, KirkpatrickFreezesAfterStagesWithoutChange) {
  Cooling cooling(
      KirkpatrickCooling{.start = 8.0, .factor = 0.5, .accepted_per_stage = 10, .tried_per_stage = 100});
  for (int i = 0; i < 2; ++i) cooling.advance(100, 5, 0);  // swaps of equal energy are no change
  EXPECT_FALSE(cooling.frozen());
  cooling.advance(100, 5, 1);
  for (int i = 0; i < 2; ++i) cooling.advance(100, 5, 0);
  EXPECT_FALSE(cooling.frozen()) << "the row was broken";
  cooling.advance(100, 5, 0);
  EXPECT_TRUE(cooling.frozen());
}

TEST(Cooling, CountsBeyond32Bits) {
  const auto schedule = make_schedule("exponential", 4.0, 0.25, 10'000'000'000);
  Cooling cooling(schedule);
  for (int i = 0; i < 10; ++i) cooling.advance(1'000'000'000, 1, 1);
  EXPECT_EQ(cooling.progress().step, 10'000'000'000);
  EXPECT_NEAR(cooling.temperature(), 0.25, 1e-6);
}

std::string message_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_input);
    EXPECT_FALSE(error.info().limit.empty());
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(Cooling, BadParametersAreNamed) {
  const auto names = [](const CoolingSchedule& schedule) {
    return message_of([&] { check_schedule(schedule); });
  };
  EXPECT_NE(names(ExponentialCooling{1.0, 1.5}).find("factor"), std::string::npos);
  EXPECT_NE(names(ExponentialCooling{1.0, 0.0}).find("factor"), std::string::npos);
  EXPECT_NE(names(ExponentialCooling{0.0, 0.5}).find("start_temperature"), std::string::npos);
  EXPECT_NE(names(KirkpatrickCooling{.factor = 1.0}).find("factor"), std::string::npos);
  EXPECT_NE(names(KirkpatrickCooling{.accepted_per_stage = 0}).find("accepted"), std::string::npos);
  EXPECT_NE(names(LinearCooling{1.0, 0.0, 2.0}).find("end_temperature"), std::string::npos);
  EXPECT_NE(names(LinearCooling{1.0, -1.0, 0.0}).find("slope"), std::string::npos);
  EXPECT_NE(names(InverseCooling{1.0, -1.0}).find("factor"), std::string::npos);
  EXPECT_NE(names(HajekCooling{0.0}).find("hajek_c"), std::string::npos);
  EXPECT_NE(names(HajekCooling{std::nan("")}).find("hajek_c"), std::string::npos);
  EXPECT_NE(names(ConstantCooling{-1.0}).find("temperature"), std::string::npos);
  EXPECT_NO_THROW(check_schedule(ConstantCooling{kInfinity}));

  const auto make = [](std::string_view name, double start, double end, std::int64_t proposals) {
    return message_of([&] { make_schedule(name, start, end, proposals); });
  };
  EXPECT_NE(make("warp", 1.0, 0.5, 10).find("unknown schedule 'warp'"), std::string::npos);
  EXPECT_NE(make("linear", 1.0, 2.0, 10).find("end_temperature"), std::string::npos);
  EXPECT_NE(make("exponential", 1.0, 0.0, 10).find("end_temperature"), std::string::npos);
  EXPECT_NE(make("exponential", 1.0, 0.5, 0).find("budget"), std::string::npos);
}

TEST(Cooling, ParametersAreUsedOrRefused) {
  const auto made = [](std::string_view name, const ScheduleParameters& parameters) {
    return make_schedule(name, 8.0, 0.5, 1'000'000, parameters);
  };
  EXPECT_EQ(std::get<ExponentialCooling>(made("exponential", {.factor = 0.75})).factor, 0.75);
  EXPECT_EQ(std::get<ExponentialCooling>(made("exponential", {.factor = 1.0})).factor, 1.0);
  EXPECT_EQ(std::get<InverseCooling>(made("inverse", {.factor = 0.25})).factor, 0.25);
  EXPECT_EQ(std::get<LinearCooling>(made("linear", {.slope = 1e-4})).slope, 1e-4);
  EXPECT_EQ(std::get<HajekCooling>(made("hajek", {.hajek_c = 3.0})).c, 3.0);
  const auto shared = std::get<KirkpatrickCooling>(made("kirkpatrick", {.factor = 0.5, .stages = 10}));
  EXPECT_EQ(shared.factor, 0.5);
  EXPECT_EQ(shared.stages, 10);
  EXPECT_EQ(shared.tried_per_stage, 100'000);
  const auto own = std::get<KirkpatrickCooling>(
      made("kirkpatrick", {.accepted_per_stage = 7, .tried_per_stage = 5000, .frozen_stages = 4}));
  EXPECT_EQ(own.stages, 0);
  EXPECT_EQ(own.tried_per_stage, 5000);
  EXPECT_EQ(own.accepted_per_stage, 7);
  EXPECT_EQ(own.frozen_stages, 4);
  EXPECT_NEAR(own.at_stage(199), 0.5, 1e-9) << "200 stages fit the budget";

  const auto names = [&](std::string_view name, const ScheduleParameters& parameters) {
    return message_of([&] { made(name, parameters); });
  };
  for (const auto name : {"exponential", "inverse", "kirkpatrick"}) {
    for (const double bad : {0.0, -0.5, 1.5, std::nan(""), kInfinity})
      EXPECT_NE(names(name, {.factor = bad}).find("factor"), std::string::npos) << name << bad;
  }
  EXPECT_NE(names("kirkpatrick", {.factor = 1.0}).find("factor"), std::string::npos);
  EXPECT_NE(names("linear", {.factor = 0.5}).find("factor: given with the schedule 'linear'"),
            std::string::npos);
  EXPECT_NE(names("linear", {.slope = -1.0}).find("slope"), std::string::npos);
  EXPECT_NE(names("hajek", {.hajek_c = 0.0}).find("hajek_c"), std::string::npos);
  EXPECT_NE(names("kirkpatrick", {.stages = 0}).find("stages"), std::string::npos);
  EXPECT_NE(names("kirkpatrick", {.accepted_per_stage = 0}).find("accepted_per_stage"), std::string::npos);
  EXPECT_NE(names("kirkpatrick", {.tried_per_stage = 0}).find("tried_per_stage"), std::string::npos);
  EXPECT_NE(names("kirkpatrick", {.frozen_stages = 0}).find("frozen_stages"), std::string::npos);
  EXPECT_NE(names("greedy", {.stages = 5}).find("stages"), std::string::npos);
}

/// The chance of standing in the global minimum of a line of states after `steps` of annealing, by exact
/// propagation of the distribution. Energies: global minimum, barrier, local minimum of depth 2.
double chance_of_global_minimum(double c, std::int64_t steps) {
  constexpr std::array<double, 5> kEnergy{0.0, 2.0, 3.0, 2.0, 1.0};  // from the right: climb 2 to leave
  std::array<double, 5> chance{0.0, 0.0, 0.0, 0.0, 1.0};
  const HajekCooling schedule{c};
  for (std::int64_t k = 0; k < steps; ++k) {
    const double t = schedule.at(static_cast<double>(k));
    const auto accept = [&](std::size_t from, std::size_t to) {
      return 0.5 * std::exp(-std::max(0.0, kEnergy[to] - kEnergy[from]) / t);
    };
    auto next = chance;
    for (std::size_t i = 0; i + 1 < chance.size(); ++i) {
      const double flow = chance[i] * accept(i, i + 1) - chance[i + 1] * accept(i + 1, i);
      next[i] -= flow;
      next[i + 1] += flow;
    }
    chance = next;
  }
  return chance[0];
}

TEST(Cooling, HajeksConstantBelowAndAboveTheDepth) {
  // The local minimum's depth is 2. Above it the chance of the global minimum keeps growing towards 1;
  // well below it the chain sticks: the chance stops growing.
  const double above_early = chance_of_global_minimum(2.5, 20'000);
  const double above_late = chance_of_global_minimum(2.5, 2'000'000);
  EXPECT_GT(above_late, 0.985);
  EXPECT_GT(above_late, above_early + 0.02);
  const double below_early = chance_of_global_minimum(0.7, 20'000);
  const double below_late = chance_of_global_minimum(0.7, 2'000'000);
  EXPECT_LT(below_late, 0.5);
  EXPECT_LT(below_late - below_early, 0.005);
}

}  // namespace
}  // namespace bn
