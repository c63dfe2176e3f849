// Protects: what plots write beside their axes, and that no range of numbers breaks them.
#include <gtest/gtest.h>

#include "ui/plot_scale.h"

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

}  // namespace
}  // namespace bn::ui
