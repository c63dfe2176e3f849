// Protects: ranks are the order of (energy, index), whatever the energies, the threads and the size.

#include "noise/rank_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "bn/random.h"

namespace bn {
using namespace noise;
namespace {

/// The definition: a stable sort.
Grid<std::uint32_t> plain_ranks(const Grid<std::uint32_t>& energies) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < energies.count(); ++i) {
    if (energies[i] != kUnranked) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return energies[i]; });
  Grid<std::uint32_t> ranks(energies.size(), kUnranked);
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  return ranks;
}

void expect_plain_ranks(Extent size, const auto& energy_of, const char* what) {
  Grid<std::uint32_t> energies(size);
  for (std::size_t i = 0; i < energies.count(); ++i) energies[i] = energy_of(i);
  const Grid<std::uint32_t> plain = plain_ranks(energies);
  for (const int threads : {1, 3}) {
    Grid<std::uint32_t> ranks = energies;
    std::vector<std::uint32_t> room(energies.count());
    replace_by_ranks(ranks, room, {.threads = threads});
    EXPECT_EQ(ranks, plain) << what << ", " << threads << " threads";
  }
}

TEST(RankOrder, EqualsAStableSort) {
  constexpr std::uint32_t kEnergies = kSetMark;
  const auto random = [](std::size_t i) { return random_bits(1, 2, i); };
  // The last is three chunks of pixels and a bit.
  for (const Extent size : {Extent{1, 1}, Extent{7, 11}, Extent{256, 3}, Extent{1021, 800}}) {
    expect_plain_ranks(
        size, [&](std::size_t i) { return static_cast<std::uint32_t>(random(i) % kEnergies); }, "any energy");
    expect_plain_ranks(
        size, [&](std::size_t i) { return static_cast<std::uint32_t>(random(i) % 5); }, "many equal ones");
    expect_plain_ranks(
        size, [](std::size_t) { return kEnergies - 1; }, "all equal, the greatest");
    expect_plain_ranks(
        size,
        [&](std::size_t i) {
          return random(i) % 3 == 0 ? kUnranked : static_cast<std::uint32_t>(random(i) >> 34);
        },
        "some unranked");
    expect_plain_ranks(
        size, [](std::size_t) { return kUnranked; }, "none ranked");
    // Where a bucket ends and a digit carries.
    expect_plain_ranks(
        size,
        [&](std::size_t i) {
          return static_cast<std::uint32_t>((random(i) % 4 << 20) + (random(i) >> 8) % 3 - 1) % kEnergies;
        },
        "about the limits of buckets");
  }
}

}  // namespace
}  // namespace bn
