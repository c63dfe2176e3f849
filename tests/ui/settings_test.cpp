// Protects: the planned curve of a schedule is the one that the library follows, also with constants of the
// user's; what is typed is read whole or not at all; what a recipe cannot hold is refused.
#include <gtest/gtest.h>

#include <limits>

#include "bn/error.h"
#include "ui/parameters.h"
#include "ui/recipe_text.h"
#include "ui/run_settings.h"

namespace bn::ui {
namespace {

TEST(PlannedCurve, IsTheOneThatTheLibraryFollows) {
  AnnealProblem problem;
  problem.channels = {{Grid<std::int32_t>({16, 16})}};
  for (std::size_t i = 0; i < 256; ++i)
    problem.channels[0].levels[i] = static_cast<std::int32_t>(i * 167 % 256);
  problem.retarget.step = {5, 3};
  problem.retarget.radius = 3;
  for (const auto name : schedule_names()) {
    for (const bool own : {false, true}) {
      AnnealOptions options;
      options.schedule = name;
      options.proposals = 1'000'000;
      if (own && (name == "exponential" || name == "inverse")) options.parameters.factor = 0.99999;
      if (own && name == "linear") options.parameters.slope = 1e-5;
      if (own && name == "hajek") options.parameters.hajek_c = 20.0;
      AnnealTrace trace;
      anneal_retarget(problem, options, {}, &trace);
      const Plan plan = plan_of(problem, options);
      const PlannedCurve planned = planned_curve(plan, 513);
      EXPECT_FALSE(formula_of(plan.schedule).text.empty());
      // Kirkpatrick's stages end when they may; the plan is their longest course.
      if (name == "kirkpatrick") continue;
      for (std::size_t i = 0; i < trace.size(); ++i) {
        if (trace[i].proposals >= plan.proposals) continue;
        const double place =
            static_cast<double>(trace[i].proposals) / static_cast<double>(plan.proposals) * 512.0;
        const auto at = static_cast<std::size_t>(place);
        const double low =
            std::min(planned.temperature[at], planned.temperature[std::min<std::size_t>(512, at + 1)]);
        EXPECT_GE(trace[i].temperature, low * 0.999) << name << own << ' ' << trace[i].proposals;
        EXPECT_LE(trace[i].temperature, planned.temperature[at] * 1.001)
            << name << own << ' ' << trace[i].proposals;
      }
    }
  }
}

TEST(Numbers, AreReadWholeOrNotAtAll) {
  int small = 7;
  std::int64_t count = 7;
  double real = 7.0;
  EXPECT_TRUE(read_number("1e9", count));
  EXPECT_EQ(count, 1'000'000'000);
  EXPECT_TRUE(read_number("9223372036854775807", count));
  EXPECT_EQ(count, std::numeric_limits<std::int64_t>::max());
  EXPECT_TRUE(read_number("-1", small));
  EXPECT_EQ(small, -1);
  EXPECT_TRUE(read_number("1e-6", real));
  EXPECT_EQ(real, 1e-6);
  for (const char* text : {"", " ", "1x", "0.5", "1e10", "nan", "inf", "99999999999", "--1"})
    EXPECT_FALSE(read_number(text, small)) << text;
  EXPECT_EQ(small, -1);
  for (const char* text : {"1e19", "9223372036854775808", "nan"})
    EXPECT_FALSE(read_number(text, count)) << text;
}

TEST(RecipeText, WrapsCommentsWithinTheirHash) {
  EXPECT_EQ(wrapped_recipe("# one two three four five six", 16), "# one two three\n# four five six\n");
  EXPECT_EQ(wrapped_recipe("short = 1\n\nx = 2\n", 16), "short = 1\n\nx = 2\n");
  EXPECT_EQ(wrapped_recipe("outputs = [\"a.png\", \"b.png\"]", 20),
            "outputs = [\"a.png\",\n    \"b.png\"]\n");
  EXPECT_EQ(wrapped_recipe("# " + std::string(20, 'x'), 16),
            "# " + std::string(14, 'x') + "\n# " + std::string(6, 'x') + "\n");
  EXPECT_EQ(wrapped_recipe("# ÄÄÄÄÄÄÄÄÄÄÄÄÄÄ", 16), "# ÄÄÄÄÄÄÄÄÄÄÄÄÄÄ\n") << "characters, not bytes";
  EXPECT_EQ(wrapped_recipe("", 16), "");
}

TEST(RunSettings, SayWhatARecipeCannot) {
  RunSettings settings;
  AnnealResult result;
  EXPECT_NO_THROW(settings.entry(result, "t.png"));
  settings.motion_x = 9;
  EXPECT_THROW(settings.entry(result, "t.png"), Error);
}

}  // namespace
}  // namespace bn::ui
