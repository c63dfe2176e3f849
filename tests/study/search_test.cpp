// Protects: the search by swaps lowers the error, more tries more, and finds next to nothing after
// void-and-cluster; equal seeds give equal results.
#include "bn_study/search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace bn {
namespace {

TEST(StudySearch, SwapsImproveWhiteNoiseAndHardlyAFilledVolume) {
  const std::array<std::int64_t, 3> tries{1, 4, 16};
  const auto results = study_search({24, 24, 4}, tries, 1);
  ASSERT_EQ(results.size(), 7u);
  const double white = std::sqrt(1.0 / 6.0) / (2.0 * 1.3435 * std::sqrt(std::numbers::pi));
  double before = white;
  for (std::size_t i = 3; i < 6; ++i) {
    EXPECT_LT(results[i].first_error, before) << results[i].method;
    before = results[i].first_error;
  }
  EXPECT_GT(before, 1.02 * results[2].first_error) << "a search beats void-and-cluster";
  EXPECT_NEAR(results[6].late_error / results[2].late_error, 1.0, 0.05);
}

TEST(StudySearch, IsReproducible) {
  const std::array<std::int64_t, 1> tries{2};
  const auto once = study_search({16, 16, 4}, tries, 5), again = study_search({16, 16, 4}, tries, 5);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].method, again[i].method);
    EXPECT_EQ(once[i].late_error, again[i].late_error);
  }
}

}  // namespace
}  // namespace bn
