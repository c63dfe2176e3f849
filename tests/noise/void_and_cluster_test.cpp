// Protects: every fast path gives the plain reference's mask bit for bit, for any size, option,
// instruction set and thread count; masks are permutations; their bytes never change unnoticed.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bn/noise.h"
#include "noise/tile_schedule.h"
#include "reference_void_and_cluster.h"

namespace bn {
using namespace noise;

// Names a failing case.
void PrintTo(const VoidAndClusterOptions& options, std::ostream* out) {
  *out << options.size.width << "x" << options.size.height << " sigma " << options.sigma_px << " density "
       << options.initial_density << " seed " << options.seed << " cutoff " << options.cutoff_px;
}

namespace {

/// Smaller than the kernel, smaller than a block, with and without partial blocks at the seams, square
/// and not.
const std::vector<Extent> kSizes = {{1, 1},   {1, 2},   {2, 1},   {1, 40},  {33, 1}, {3, 5},
                                    {7, 11},  {8, 8},   {9, 33},  {16, 8},  {17, 9}, {13, 64},
                                    {40, 40}, {61, 47}, {24, 24}, {25, 24}, {1, 700}};

std::vector<VoidAndClusterOptions> option_sets() {
  std::vector<VoidAndClusterOptions> sets;
  for (const Extent size : kSizes) {
    for (const double sigma : {0.3, 1.5, 1.9, 3.0}) sets.push_back({.size = size, .sigma_px = sigma});
    for (const double density : {0.1, 0.5})
      sets.push_back({.size = size, .initial_density = density, .seed = 2});
    for (const int cutoff : {1, 2, 5}) sets.push_back({.size = size, .seed = 3, .cutoff_px = cutoff});
  }
  // First points by several halvings, of odd and of even sides.
  for (const Extent size : {Extent{128, 96}, {101, 75}, {2000, 5}}) {
    for (const double sigma : {0.7, 1.5, 3.0}) sets.push_back({.size = size, .sigma_px = sigma, .seed = 4});
  }
  for (const Extent size : {Extent{1, 1}, {1, 7}, {3, 5}, {13, 12}}) {
    sets.push_back({.size = size, .sigma_px = 16.0, .initial_density = 0.3});
    sets.push_back({.size = size, .sigma_px = 16.0, .seed = UINT64_MAX, .cutoff_px = 64});
  }
  return sets;
}

std::uint64_t hash(const Grid<std::uint32_t>& ranks) {
  std::uint64_t state = 14695981039346656037u;  // FNV-1a
  for (const std::uint32_t rank : ranks) state = (state ^ rank) * 1099511628211u;
  return state;
}

class InstructionSets : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_instruction_set(GetParam()); }
  void TearDown() override { use_instruction_set(""); }
};
INSTANTIATE_TEST_SUITE_P(All, InstructionSets, testing::ValuesIn(instruction_sets()),
                         [](const auto& test) { return test.param; });

TEST_P(InstructionSets, EqualReference) {
  static const std::vector<VoidAndClusterOptions> sets = option_sets();
  static const std::vector<Grid<std::uint32_t>> expected = [] {
    std::vector<Grid<std::uint32_t>> masks;
    for (const auto& options : sets) masks.push_back(reference_void_and_cluster(options));
    return masks;
  }();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    ASSERT_EQ(void_and_cluster(sets[i], {.threads = 1}), expected[i]) << testing::PrintToString(sets[i]);
  }
}

TEST_P(InstructionSets, GoldenBytes) {
  // One of these changed: raise kVoidAndClusterVersion and say so in the changelog.
  EXPECT_EQ(hash(void_and_cluster({.size = {64, 64}})), 13555886203045906801u);
  EXPECT_EQ(hash(void_and_cluster({.size = {128, 128}, .sigma_px = 1.5, .seed = 7})), 4286116088903335171u);
  EXPECT_EQ(hash(void_and_cluster({.size = {96, 50}, .initial_density = 0.1})), 8212467020767819135u);
}

class Threads : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Some, Threads, testing::Values(1, 2, 3, 7));

/// Else the tests below show less than they say.
bool is_cut(Extent size) {
  const EnergyField field(size, 11, kSetMark);
  const BlockRect tile = TileSchedule(field, 1).take()->blocks;
  return tile.columns * tile.rows < field.blocks_x * field.blocks_y;
}

TEST_P(Threads, EqualReferenceOnSeveralTiles) {
  // Long enough for several tiles along one axis, few enough pixels for the plain reference.
  for (const Extent size : {Extent{1040, 8}, {8, 1040}, {1045, 13}}) {
    ASSERT_TRUE(is_cut(size));
    const VoidAndClusterOptions options{.size = size, .initial_density = 0.1};
    static std::vector<std::pair<VoidAndClusterOptions, Grid<std::uint32_t>>> known;
    auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.first.size == size; });
    if (found == known.end())
      found = known.insert(known.end(), {options, reference_void_and_cluster(options)});
    ASSERT_EQ(void_and_cluster(options, {.threads = GetParam()}), found->second)
        << testing::PrintToString(options);
  }
}

TEST_P(Threads, EqualQueueOnTilesInBothAxes) {
  const VoidAndClusterOptions options{.size = {1033, 1030}, .cutoff_px = 2};
  ASSERT_TRUE(is_cut(options.size));
  static const Grid<std::uint32_t> expected = queue_void_and_cluster(options);
  ASSERT_EQ(void_and_cluster(options, {.threads = GetParam()}), expected);
}

TEST(VoidAndCluster, QueueEqualsReference) {
  for (const Extent size : {Extent{1, 580}, {23, 33}, {40, 40}}) {
    const VoidAndClusterOptions options{.size = size, .cutoff_px = 2};
    ASSERT_EQ(queue_void_and_cluster(options), reference_void_and_cluster(options));
  }
}

TEST(VoidAndCluster, IsAPermutation) {
  for (const Extent size : {Extent{512, 300}, {1, 1000}, {129, 64}}) {
    for (const double density : {0.0, 0.25}) {
      const Grid<std::uint32_t> ranks = void_and_cluster({.size = size, .initial_density = density});
      std::vector<std::uint32_t> sorted(ranks.begin(), ranks.end());
      std::sort(sorted.begin(), sorted.end());
      for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
    }
  }
}

TEST(VoidAndCluster, SeedsGiveDifferentMasks) {
  EXPECT_NE(void_and_cluster({.seed = 1}), void_and_cluster({.seed = 2}));
}

}  // namespace
}  // namespace bn
