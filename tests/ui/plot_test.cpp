// Protects: what plots write beside their axes, that no range of numbers breaks them, and that the planned
// curve of a schedule is the one that the library follows.
#include <gtest/gtest.h>

#include "ui/plot_scale.h"
#include "ui/run_settings.h"

namespace bn::ui {
namespace {

TEST(Plot, WritesShortNumbers) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(3638.0), "3638");
  EXPECT_EQ(short_number(0.25), "0.25");
  EXPECT_EQ(short_number(1e9), "1e9");
  EXPECT_EQ(short_number(2.5e8), "2.5e8");
  EXPECT_EQ(short_number(123456789.0, 3), "1.23e8");
  EXPECT_EQ(short_number(-2e-7), "-2e-7");
  EXPECT_EQ(short_number(0.031623, 2), "0.032");
}

TEST(Plot, NamesRoundNumbersWithinTheRange) {
  for (const bool logarithmic : {false, true}) {
    const Axis axis{.name = "", .logarithmic = logarithmic};
    for (const Interval range : {Interval{3600, 18000}, {0.001, 1.0}, {1e-9, 1e12}, {5.0, 5.1}, {1.0, 2.0}}) {
      const auto ticks = ticks_of(axis, range, 6.0);
      EXPECT_LT(ticks.size(), 250u);
      int named = 0;
      for (const Tick& tick : ticks) {
        EXPECT_GE(tick.value, range.low);
        EXPECT_LE(tick.value, range.high);
        named += !tick.text.empty();
      }
      EXPECT_GE(named, 2) << range.low << ".." << range.high;
      EXPECT_LE(named, 13) << range.low << ".." << range.high;
    }
  }
}

TEST(Plot, EveryDataGivesASoundRange) {
  const double huge = std::numeric_limits<double>::max();
  for (const bool logarithmic : {false, true}) {
    const Axis axis{.name = "", .logarithmic = logarithmic};
    for (const auto& values : std::vector<std::vector<double>>{{},
                                                               {0.0},
                                                               {5.0},
                                                               {-3.0, -3.0},
                                                               {0.0, 1e-12},
                                                               {1.0, 1e9},
                                                               {huge, NAN, -huge, INFINITY},
                                                               {1e-20, 1e20}}) {
      Extremes data;
      for (const double value : values) {
        if (std::abs(value) < 1e29) data.take(clean(axis, value));
      }
      EXPECT_TRUE(is_sound(axis, finish(axis, data, 0.05))) << logarithmic;
    }
  }
  EXPECT_FALSE(is_sound({}, {1.0, 1.0}));
  EXPECT_FALSE(is_sound({}, {0.0, NAN}));
  EXPECT_FALSE(is_sound({}, {1e12, 1e12 + 1e-6}));
}

TEST(Plot, ScalesAndBack) {
  for (const bool logarithmic : {false, true}) {
    const Scale scale(logarithmic, {10.0, 1000.0});
    EXPECT_DOUBLE_EQ(scale.share(10.0), 0.0);
    EXPECT_DOUBLE_EQ(scale.share(1000.0), 1.0);
    EXPECT_NEAR(scale.value(scale.share(77.0)), 77.0, 1e-9);
  }
}

TEST(PlannedCurve, IsTheOneThatTheLibraryFollows) {
  AnnealProblem problem;
  problem.channels = {{Grid<std::int32_t>({16, 16})}};
  for (std::size_t i = 0; i < 256; ++i)
    problem.channels[0].levels[i] = static_cast<std::int32_t>(i * 167 % 256);
  problem.retarget.step = {5, 3};
  problem.retarget.radius = 3;
  for (const auto name : schedule_names()) {
    AnnealOptions options;
    options.schedule = name;
    options.proposals = 1'000'000;
    AnnealTrace trace;
    const AnnealResult result = anneal_retarget(problem, options, {}, &trace);
    const std::int64_t cooled = options.proposals - options.proposals / 64;
    const auto schedule = make_schedule(name, result.start_temperature, result.end_temperature, cooled);
    const PlannedCurve planned = planned_curve(schedule, cooled, 513);
    EXPECT_FALSE(formula_of(schedule).text.empty());
    // Kirkpatrick's stages end when they may; the plan is their longest course.
    if (name == "kirkpatrick") continue;
    for (std::size_t i = 0; i < trace.size(); ++i) {
      if (trace[i].proposals >= cooled) continue;
      const double place = static_cast<double>(trace[i].proposals) / static_cast<double>(cooled) * 512.0;
      const auto at = static_cast<std::size_t>(place);
      const double low =
          std::min(planned.temperature[at], planned.temperature[std::min<std::size_t>(512, at + 1)]);
      EXPECT_GE(trace[i].temperature, low * 0.999) << name << ' ' << trace[i].proposals;
      EXPECT_LE(trace[i].temperature, planned.temperature[at] * 1.001) << name << ' ' << trace[i].proposals;
    }
  }
}

TEST(RunSettings, SayWhatARecipeCannot) {
  RunSettings settings;
  AnnealResult result;
  EXPECT_NO_THROW(settings.entry(result, "t.png"));
  settings.metric = 2;
  EXPECT_THROW(settings.entry(result, "t.png"), Error);
  settings.metric = 0;
  settings.motion_x = 9;
  EXPECT_THROW(settings.entry(result, "t.png"), Error);
}

}  // namespace
}  // namespace bn::ui
