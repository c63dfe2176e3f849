// Protects: every rank comes exactly once.
#include <gtest/gtest.h>

#include <vector>

#include "bn/noise.h"

namespace bn {
namespace {

TEST(VoidAndCluster, IsAPermutation) {
  const Grid<std::uint32_t> ranks = void_and_cluster({.size = {13, 22}, .initial_density = 0.1});
  std::vector<int> seen(ranks.count());
  for (const std::uint32_t rank : ranks) ++seen.at(rank);
  for (const int times : seen) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace bn
