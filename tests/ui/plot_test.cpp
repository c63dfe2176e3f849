// Protects: what plots write beside their axes, that no range of numbers breaks them, and that they draw what
// is in sight and no more.
#include <gtest/gtest.h>

#include "ui/keys.h"
#include "ui/loop.h"
#include "ui/plot.h"
#include "ui/plot_scale.h"
#include "ui/theme.h"

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

// Found by random events: zoomed in far, a dashed line is longer than floats of pixels can count.
TEST(Plot, DrawsOnlyTheDashesInSight) {
  const ImGuiSession session;
  apply_theme(true, 1.0f);
  ImGuiIO& io = ImGui::GetIO();
  map_keys(io);
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  io.DisplaySize = {800, 600};
  io.DeltaTime = 1.0f / 60.0f;
  Figure figure;
  Curve& curve = figure.curves.emplace_back();
  curve.name = "planned";
  curve.colour = IM_COL32_WHITE;
  curve.dashed = true;
  curve.x = {0.0, 0.5, 1.0};
  curve.y = {3.0, 2.0, 1.0};
  Plot plot;
  int all = 0;
  for (const double span : {1.0, 1e-3, 1e-6, 1e-9}) {
    PlotLink link{.x = Interval{0.5 - 0.3 * span, 0.5 + 0.7 * span}};
    figure.y.low = 2.0 - 0.3 * span;
    figure.y.high = 2.0 + 0.7 * span;
    ImGui::NewFrame();
    ImGui::SetNextWindowSize({700, 500});
    ImGui::Begin("window");
    plot.draw("plot", figure, {600, 400}, link);
    ImGui::End();
    ImGui::Render();
    const int drawn = ImGui::GetDrawData()->TotalVtxCount;
    if (all == 0) all = drawn;
    EXPECT_GT(drawn, 100) << span;
    EXPECT_LT(drawn, 3 * all) << span;
  }
}

}  // namespace
}  // namespace bn::ui
