// Protects: volumes equal the plain reference bit for bit, for any sides, kernel, instruction set and thread
// count; the energies on the way equal those computed from scratch; masks are permutations; their bytes never
// change unnoticed.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bn/noise.h"
#include "bn/spatiotemporal.h"
#include "noise/fill_columns.h"
#include "noise/volume_order.h"
#include "reference_volume_mask.h"

namespace bn {
using namespace noise;

// Names a failing case.
void PrintTo(const VolumeMaskOptions& options, std::ostream* out) {
  const auto& [x, y, z, w] = options.size;
  *out << x << "x" << y << "x" << z << "x" << w << " seed " << options.seed;
  for (const KernelTerm& t : options.kernel) {
    *out << " + " << t.weight;
    for (const AxisFunction& f : {t.x, t.y, t.z, t.w})
      *out << " (" << static_cast<int>(f.form) << ", " << f.width << ")";
  }
}

namespace {

constexpr AxisFunction kDelta{AxisForm::delta};
constexpr AxisFunction kOne{AxisForm::one};
constexpr AxisFunction gauss(double sigma) { return {AxisForm::gauss, sigma}; }
constexpr AxisFunction ema(double alpha) { return {AxisForm::exponential, alpha}; }
constexpr AxisFunction tent(double width) { return {AxisForm::tent, width}; }
constexpr AxisFunction binomial(double order) { return {AxisForm::binomial, order}; }

VolumeKernel gated(double sigma) {
  return {{1.0, gauss(sigma), gauss(sigma), kDelta}, {1.0, kDelta, kDelta, gauss(1.9)}};
}
VolumeKernel filtered(double sigma, double alpha) {
  return {{0.5, gauss(sigma), gauss(sigma), kDelta}, {0.5, gauss(sigma), gauss(sigma), ema(alpha)}};
}
VolumeKernel both() {
  return {{0.6, gauss(1.5), gauss(1.5), kDelta},
          {0.4, gauss(1.5), gauss(1.5), ema(0.1)},
          {0.5, kDelta, kDelta, gauss(1.9)}};
}
/// A box's tent alone has zeros: next to each other, whole patterns cost nothing.
VolumeKernel box(double share) {
  VolumeKernel kernel{{1.0, tent(3), tent(3), tent(4)}};
  if (share > 0.0) kernel.push_back({share, gauss(0.8), gauss(0.8), tent(4)});
  return kernel;
}
/// Two and two axes, and two, one and one.
VolumeKernel gated_pairs() {
  return {{1.0, gauss(1.5), gauss(1.5), kDelta, kDelta}, {1.0, kDelta, kDelta, gauss(1.2), gauss(1.2)}};
}
VolumeKernel gated_each() {
  return {{1.0, gauss(1.5), gauss(1.5), kDelta, kDelta},
          {0.7, kDelta, kDelta, ema(0.2), kDelta},
          {0.4, kDelta, kDelta, kDelta, binomial(3)}};
}
VolumeKernel ball(double sigma) { return {{1.0, gauss(sigma), gauss(sigma), gauss(sigma), gauss(sigma)}}; }

std::vector<VolumeMaskOptions> option_sets() {
  std::vector<VolumeMaskOptions> sets;
  const auto add = [&](TorusSides sides, VolumeKernel kernel) {
    sets.push_back({.size = sides, .kernel = std::move(kernel), .seed = 1 + sets.size() % 3});
  };
  // Depth 2; a pixel by T; 1xN; below the kernel in some axis, or in all; odd factors; more than a vector.
  const std::vector<TorusSides> sides = {{1, 1, 2},  {1, 1, 64},   {1, 1, 37}, {9, 1, 5},   {1, 40, 3},
                                         {5, 7, 3},  {16, 16, 2},  {8, 3, 9},  {13, 12, 7}, {17, 9, 8},
                                         {2, 2, 17}, {12, 12, 16}, {5, 4, 33}, {24, 18, 3}, {3, 3, 70}};
  // With first voxels from a quarter of the size, and more last holes than one a slice.
  const TorusSides large{47, 40, 4};
  for (const TorusSides s : sides) {
    add(s, gated(1.9));
    add(s, filtered(1.6, 0.1));
    add(s, both());
    add(s, box(0.3));
    add(s, ball(1.2));
  }
  add(large, both());
  add(large, gated(1.5));
  for (const TorusSides s : {TorusSides{5, 7, 3}, {12, 12, 4}, {7, 3, 20}}) {
    for (const double sigma : {0.3, 8.0, 16.0}) {
      add(s, gated(sigma));
      add(s, filtered(sigma, 0.1));
    }
    for (const double alpha : {1.0, 0.001}) add(s, filtered(1.5, alpha));
    add(s, box(0.0));
    add(s, {{1.0, kDelta, kDelta, kDelta}});
    add(s, {{1.0, kDelta, kDelta, kOne}});
    add(s, {{1e6, gauss(1.5), gauss(3.0), kOne}, {1e-3, gauss(1.0), kDelta, gauss(1.0)}});
  }
  for (const TorusSides s :
       {TorusSides{4, 4, 2, 2}, {5, 3, 4, 3}, {8, 8, 3, 5}, {6, 6, 1, 7}, {3, 3, 8, 8}, {1, 1, 5, 7}}) {
    add(s, gated_pairs());
    add(s, gated_each());
    add(s, ball(1.0));
    add(s, both());
  }
  for (std::size_t i = 0; i < sets.size(); i += 3) sets[i].ranks = RankScope::volume;
  return sets;
}

std::uint64_t hash(const Grid<std::uint32_t>& ranks) {
  std::uint64_t state = 14695981039346656037u;  // FNV-1a
  for (const std::uint32_t rank : ranks) state = (state ^ rank) * 1099511628211u;
  return state;
}

class VolumeInstructionSets : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_instruction_set(GetParam()); }
  void TearDown() override { use_instruction_set(""); }
};
INSTANTIATE_TEST_SUITE_P(All, VolumeInstructionSets, testing::ValuesIn(instruction_sets()),
                         [](const auto& test) { return test.param; });

TEST_P(VolumeInstructionSets, EqualReference) {
  static const std::vector<VolumeMaskOptions> sets = option_sets();
  static const std::vector<Grid<std::uint32_t>> expected = [] {
    std::vector<Grid<std::uint32_t>> masks;
    for (const auto& options : sets) masks.push_back(reference_volume_mask(options));
    return masks;
  }();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    ASSERT_EQ(volume_mask(sets[i], {.threads = 1}), expected[i]) << testing::PrintToString(sets[i]);
  }
}

TEST_P(VolumeInstructionSets, ThirtyTwoBitsEqualSixteen) {
  for (const TorusSides sides : {TorusSides{40, 40, 16}, {24, 20, 33}, {16, 16, 8, 8}}) {
    for (const VolumeKernel& kernel : {both(), gated(1.9)}) {
      const VolumeWeights weights(sides, kernel);
      const Execution execution{.threads = 1};
      ProgressMeter meter(execution, 1);
      EXPECT_EQ(volume_order(weights, {}, 3, execution, meter).energies,
                volume_order_32_bits(weights, {}, 3, execution, meter).energies);
    }
  }
}

TEST(VolumeMask, IsAPermutation) {
  for (const RankScope scope : {RankScope::slice, RankScope::volume}) {
    const Grid<std::uint32_t> ranks = volume_mask({.size = {32, 24, 10}, .kernel = both(), .ranks = scope});
    const int parts = scope == RankScope::slice ? 10 : 1;
    const std::size_t part = ranks.count() / static_cast<std::size_t>(parts);
    for (int i = 0; i < parts; ++i) {
      std::vector<std::uint32_t> sorted(ranks.begin() + static_cast<std::ptrdiff_t>(part) * i,
                                        ranks.begin() + static_cast<std::ptrdiff_t>(part) * (i + 1));
      std::sort(sorted.begin(), sorted.end());
      for (std::uint32_t rank = 0; rank < part; ++rank) ASSERT_EQ(sorted[rank], rank);
    }
  }
}

TEST(VolumeMask, OneSliceIsTheTwoDimensionalMethod) {
  for (const Extent size : {Extent{64, 64}, {1, 40}, {13, 12}}) {
    EXPECT_EQ(volume_mask(
                  {.size = {size.width, size.height}, .kernel = {{1.0, gauss(1.9), gauss(1.9)}}, .seed = 7}),
              void_and_cluster({.size = size, .seed = 7}));
  }
}

TEST(VolumeMask, SeedsGiveDifferentMasks) {
  EXPECT_NE(volume_mask({.size = {16, 16, 4}, .kernel = both(), .seed = 1}),
            volume_mask({.size = {16, 16, 4}, .kernel = both(), .seed = 2}));
}

/// Stops the filling again and again, and compares the energies of all voxels that are still unset with those
/// computed from scratch.
template <class Lane>
void expect_energies_from_scratch(const TorusSides& sides, const VolumeKernel& kernel) {
  const VolumeWeights weights(sides, kernel);
  const PlainWeights plain(weights);
  const ColumnKernel<Lane> columns(weights);
  constexpr std::uint32_t kUnset = UINT32_MAX;
  struct Enough {};
  for (const std::int64_t wanted : {1, 50, 200, 400}) {
    ColumnField<Lane> field({sides.x, sides.y}, weights.slices());
    for (std::int64_t i = 0; i < field.columns().area(); ++i) field.update_least(i);
    const std::int64_t in_slice = field.columns().area();
    std::vector<std::uint32_t> when_set(static_cast<std::size_t>(in_slice * weights.slices()), kUnset);
    RowLocks locks(sides.y, weights.reach_y(), true);
    std::int64_t set = 0;
    const ColumnJob<Lane> job{.field = field,
                              .kernel = columns,
                              .rows = {0, sides.y},
                              .step = static_cast<std::int32_t>(weights.sum() / weights.slices() / 16 + 1),
                              .locks = locks,
                              .energy_when_set = when_set.data(),
                              .progress = [&](std::int64_t now) {
                                if ((set += now) >= wanted) throw Enough();
                              }};
    EXPECT_THROW(fill_columns(job), Enough);
    EXPECT_EQ(std::count(when_set.begin(), when_set.end(), kUnset), std::ssize(when_set) - set);
    ASSERT_LT(set, std::ssize(when_set) / 10 * 9) << "nearly nothing is left to compare";
    for (std::int64_t i = 0; i < std::ssize(when_set); ++i) {
      if (when_set[static_cast<std::size_t>(i)] != kUnset) continue;
      std::int64_t energy = 0;
      for (std::int64_t j = 0; j < std::ssize(when_set); ++j) {
        if (when_set[static_cast<std::size_t>(j)] != kUnset) energy += plain.between(j, i);
      }
      ASSERT_EQ(field.energy(i % in_slice, static_cast<int>(i / in_slice)), energy) << set << " are set";
    }
  }
}

TEST(ColumnField, EnergiesAreThoseComputedFromScratch) {
  expect_energies_from_scratch<std::uint16_t>({12, 13, 9}, both());
  expect_energies_from_scratch<std::uint16_t>({9, 8, 4, 3}, gated_each());
  expect_energies_from_scratch<std::int32_t>({12, 13, 9}, gated(1.9));
}

TEST(VolumeMask, ThreadsChangeNothing) {
  for (const TorusSides sides : {TorusSides{24, 150, 8}, {16, 203, 3}}) {
    for (const VolumeKernel& kernel : {both(), gated(1.2)}) {
      const VolumeMaskOptions options{.size = sides, .kernel = kernel, .seed = 5};
      const Grid<std::uint32_t> expected = volume_mask(options, {.threads = 1});
      for (const int threads : {2, 3, 7}) {
        EXPECT_EQ(volume_mask(options, {.threads = threads}), expected) << threads << " threads";
      }
    }
  }
}

TEST(VolumeMask, ThreadsEqualReference) {
  const VolumeMaskOptions options{.size = {6, 80, 4}, .kernel = gated(0.8), .seed = 5};
  EXPECT_EQ(volume_mask(options, {.threads = 2}), reference_volume_mask(options));
}

/// Bytes are a promise. Change them only together with kVolumeMaskVersion.
TEST(VolumeMask, GoldenBytes) {
  EXPECT_EQ(hash(volume_mask({.size = {32, 32, 16}, .kernel = both(), .seed = 1})), 3665885916059280085u);
  EXPECT_EQ(hash(volume_mask({.size = {32, 24, 9}, .kernel = gated(1.9), .seed = 2})), 14621378680342347283u);
  EXPECT_EQ(hash(volume_mask({.size = {16, 16, 4, 5}, .kernel = gated_pairs(), .seed = 3})),
            14717344209213695793u);
  EXPECT_EQ(hash(volume_mask({.size = {48, 40}, .kernel = box(0.3), .seed = 4})), 10644070941674739915u);
}

}  // namespace
}  // namespace bn
