// Protects: ranks are those of the definition for every kind of value, thresholds take the right share, and
// histograms lose no value.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bn/error.h"
#include "direct_dft.h"

namespace bn {
namespace {

/// Mean of the ranks of all equal values, by counting the smaller and the equal.
std::vector<double> direct_midranks(const std::vector<double>& values) {
  std::vector<double> ranks;
  for (const double v : values) {
    const auto less = std::count_if(values.begin(), values.end(), [&](double w) { return w < v; });
    const auto equal = std::count(values.begin(), values.end(), v);
    ranks.push_back(static_cast<double>(less) + 0.5 * static_cast<double>(equal - 1));
  }
  return ranks;
}

TEST(Midranks, EqualTheirDefinition) {
  auto uniform = test::white_values(500, 1);
  EXPECT_EQ(midranks(uniform), direct_midranks(uniform));
  auto coarse = uniform, wide = uniform, permutation = uniform;
  for (double& v : coarse) v = std::floor(v * 37) - 11;      // counted
  for (double& v : wide) v = std::pow(10.0, 600 * v - 300);  // nearly all in one place of the sort
  for (std::size_t i = 0; i < wide.size(); i += 3) wide[i] = -wide[i];
  std::iota(permutation.begin(), permutation.end(), -7.0);
  std::reverse(permutation.begin() + 100, permutation.end());
  auto almost = permutation;
  almost[3] = almost[4];  // right range, but not each value once
  for (const auto& values : {coarse, wide, permutation, almost})
    EXPECT_EQ(midranks(values), direct_midranks(values));
  auto near = uniform;  // all but one in one place, many equal
  for (double& v : near) v = 1.0 + std::floor(v * 300) * 0x1p-52;
  near[250] = -1e300;
  EXPECT_EQ(midranks(near), direct_midranks(near));
  for (const double tiny : {0x1p-1074, 0x1p-1060, 0x1p1023}) {
    auto extreme = uniform;
    for (double& v : extreme) v = std::floor(v * 90 - 45) * (tiny > 1.0 ? tiny / 64 : tiny);
    EXPECT_EQ(midranks(extreme), direct_midranks(extreme));
  }
  const std::vector<double> zeros{0.5, -0.0, 0.0, -1e-310, 1e-310, -0.5};
  EXPECT_EQ(midranks(zeros), direct_midranks(zeros));
  EXPECT_TRUE(midranks(std::vector<double>{}).empty());
  EXPECT_THROW(midranks(std::vector<double>{1.0, std::numeric_limits<double>::infinity()}), Error);
}

TEST(Midranks, FloatAndEightBitTakeTheOrder) {
  std::vector<double> floats;
  for (const double v : test::white_values(700, 2))
    floats.push_back(static_cast<double>(static_cast<float>(v)));
  EXPECT_EQ(midranks(floats), direct_midranks(floats));
}

TEST(Thresholded, SetsTheShareOfPixels) {
  const auto values = test::white_values(64 * 64, 3);
  for (int i = 1; i < 16; ++i) {
    const auto picture = thresholded(values, i / 16.0);
    EXPECT_EQ(std::accumulate(picture.begin(), picture.end(), 0.0), 256.0 * i);
  }
  EXPECT_THROW(thresholded(values, 0.0), Error);
  EXPECT_THROW(thresholded(values, 1.0), Error);
  EXPECT_THROW(thresholded(values, std::nan("")), Error);
}

TEST(Histogram, LosesNoValue) {
  const std::vector<double> values{-5.0, 0.0, 0.9, 1.0, 3.99, 4.0, 1e300};
  EXPECT_EQ(histogram(values, 0.0, 4.0, 4), (std::vector<std::int64_t>{3, 1, 0, 3}));
  EXPECT_THROW(histogram(values, 1.0, 1.0, 4), Error);
  EXPECT_THROW(histogram(values, 0.0, 1.0, 0), Error);
}

TEST(Histogram, DeviationIsZeroWhereFlat) {
  std::vector<double> values(1024);
  std::iota(values.begin(), values.end(), 0.0);
  EXPECT_EQ(histogram_max_deviation(histogram(values, 0.0, 1024.0, 256)), 0.0);
  values[1023] = 0.0;  // one bin has 5, one 3
  EXPECT_EQ(histogram_max_deviation(histogram(values, 0.0, 1024.0, 256)), 0.25);
}

}  // namespace
}  // namespace bn
