// Protects: vector masks equal the plain reference bit for bit on any instruction set and number of threads;
// an exchange's gain is the fall of the energy; voxels of a round do not see each other; values are only
// exchanged, never made up; bytes never change unnoticed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "bn/error.h"
#include "bn/random.h"
#include "reference_vector_mask.h"

namespace bn {
using namespace noise;

// Names a failing case.
void PrintTo(const VectorMaskOptions& o, std::ostream* out) {
  *out << name_of(o.values) << " " << name_of(o.energy) << " " << o.mask.size.width << "x"
       << o.mask.size.height << "x" << o.mask.size.depth << " " << name_of(o.mask.preset) << " budget "
       << o.budget << " seed " << o.mask.seed;
}

namespace {

VectorMaskOptions with(VectorValues values, Shape size, std::int64_t budget,
                       SpatiotemporalPreset preset = SpatiotemporalPreset::filtered,
                       RankScope ranks = RankScope::slice) {
  VectorMaskOptions options;
  options.values = values;
  options.budget = budget;
  options.mask.size = size;
  options.mask.preset = preset;
  options.mask.ranks = ranks;
  options.mask.spatial_width = 0.7;
  return options;
}

std::vector<VectorMaskOptions> option_sets() {
  using V = VectorValues;
  using P = SpatiotemporalPreset;
  std::vector<VectorMaskOptions> sets = {
      with(V::vec2, {12, 10, 1}, 3),
      with(V::vec2, {9, 11, 2}, 3, P::both),
      with(V::vec3, {13, 12, 3}, 2),
      with(V::vec4, {8, 8, 8}, 1, P::stbn),
      with(V::circle, {17, 5, 3}, 2, P::filtered, RankScope::volume),
      with(V::sphere, {12, 13, 5}, 1, P::both),
      with(V::hemisphere, {20, 16, 2}, 1),
      with(V::vec2, {1, 1, 37}, 4, P::filtered, RankScope::volume),
      with(V::vec2, {1, 1, 20}, 4, P::both),
      with(V::vec3, {1, 30, 4}, 2, P::both, RankScope::volume),
      with(V::vec4, {3, 2, 18}, 3, P::both, RankScope::volume),
      with(V::sphere, {2, 2, 1}, 5),
      with(V::vec2, {1, 1, 1}, 5),
  };
  for (const V values : {V::vec2, V::vec3, V::vec4, V::circle}) {
    sets.push_back(with(values, {10, 9, 3}, 2, P::stbn));
    sets.back().energy = VectorEnergy::georgiev_fajardo;
  }
  return sets;
}

VectorKernel kernel_of(const VectorMaskOptions& options) {
  const Shape size = options.mask.size;
  return VectorKernel(
      VolumeWeights({size.width, size.height, size.depth, 1}, spatiotemporal_kernel(options.mask)));
}

class VectorInstructionSets : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_instruction_set(GetParam()); }
  void TearDown() override { use_instruction_set(""); }
};
INSTANTIATE_TEST_SUITE_P(All, VectorInstructionSets, testing::ValuesIn(instruction_sets()),
                         [](const auto& test) { return test.param; });

TEST_P(VectorInstructionSets, EqualReference) {
  static const std::vector<VectorMaskOptions> sets = option_sets();
  static const std::vector<Grid<std::uint32_t>> expected = [] {
    std::vector<Grid<std::uint32_t>> masks;
    for (const auto& options : sets) masks.push_back(reference_vector_mask(options));
    return masks;
  }();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const int threads : {1, 2, 3, 7}) {
      ASSERT_EQ(vector_mask(sets[i], {.threads = threads}), expected[i])
          << testing::PrintToString(sets[i]) << " on " << threads << " threads";
    }
  }
}

TEST_P(VectorInstructionSets, SumsEqualPlainOnes) {
  // More slices than a vector has lanes, and some left over.
  for (const int depth : {1, 3, 16, 37}) {
    for (const VectorValues values : {VectorValues::vec2, VectorValues::sphere, VectorValues::vec4}) {
      const VectorEnergy energy = depth % 2 == 0 ? VectorEnergy::half_spaces : VectorEnergy::georgiev_fajardo;
      const VectorMaskOptions options = with(values, {16, 12, depth}, 0);
      const VectorKernel kernel = kernel_of(options);
      const VectorField field(values, energy, curve_mask(options));
      const ScaledVector from = scaled_value(values, 123456789);
      const ScaledVector to = scaled_value(values, 3123456789);
      std::vector<ScaledVector> some;
      for (std::uint32_t i = 0; i < 41; ++i) {
        const Voxel at{static_cast<int>(i) % 16, static_cast<int>(i) % 12, static_cast<int>(i) % depth};
        ASSERT_EQ(gain(field, kernel, at, from, to), gain_plainly(field, kernel, at, from, to));
        some.push_back(field.value(field.index(at)));
      }
      const ValueTable table(some);
      const std::vector<ScaledVector> middles = cell_middles(values);
      std::vector<float> fast(kCells * table.stride()), plain(fast);
      distances_from_cells(middles, table, field, fast);
      distances_from_cells_plainly(middles, table, field, plain);
      std::vector<float> seen, far(11 * table.stride()), plain_far(far);
      for (std::size_t i = 0; i < 11 * kCells; ++i)
        seen.push_back(static_cast<float>(random_bits(1, 0, i) % 64));
      estimate(seen, fast, table.count(), table.stride(), far);
      estimate_plainly(seen, plain, table.count(), table.stride(), plain_far);
      for (std::size_t j = 0; j < 41; ++j) {
        for (std::size_t k = 0; k < kCells; ++k)
          ASSERT_EQ(fast[k * table.stride() + j], plain[k * table.stride() + j]);
        for (std::size_t i = 0; i < 11; ++i)
          ASSERT_EQ(far[i * table.stride() + j], plain_far[i * table.stride() + j]);
      }
    }
  }
}

TEST(VectorMask, GainIsTheFallOfTheEnergy) {
  for (const VectorMaskOptions& options : option_sets()) {
    if (options.mask.size.count() > 500) continue;
    const VectorKernel kernel = kernel_of(options);
    Grid<std::uint32_t> places = curve_mask(options);
    const VectorField field(options.values, options.energy, places);
    const std::vector<Voxel> voxels = all_voxels(places.shape());
    const std::int64_t before = reference_energy(options, places, kernel);
    for (std::uint64_t i = 0; i < 20; ++i) {
      const std::size_t a = random_bits(2, 0, i) % voxels.size();
      const std::size_t b = random_bits(2, 1, i) % voxels.size();
      if (a == b) continue;
      std::swap(places[a], places[b]);
      ASSERT_EQ(exchange_gain(field, kernel, voxels[a], voxels[b]),
                before - reference_energy(options, places, kernel));
      std::swap(places[a], places[b]);
    }
  }
}

TEST(VectorMask, VoxelsOfARoundAreApart) {
  for (const Shape size : {Shape{64, 48, 3}, {37, 41, 2}, {128, 9, 4}}) {
    for (const RankScope scope : {RankScope::slice, RankScope::volume}) {
      const VectorKernel kernel = kernel_of(with(VectorValues::vec2, size, 1));
      const SwapRounds rounds(kernel, size, scope, 1);
      ASSERT_TRUE(rounds.apart());
      for (int round = 0; round < 20; ++round) {
        const std::vector<Voxel> voxels = rounds.voxels(round);
        ASSERT_EQ(static_cast<int>(voxels.size()), rounds.count());
        for (std::size_t i = 0; i < voxels.size(); ++i) {
          ASSERT_TRUE(scope == RankScope::volume || voxels[i].z == voxels[0].z);
          for (std::size_t j = 0; j < i; ++j) {
            const int dx = std::abs(wrap_centred(voxels[i].x - voxels[j].x, size.width));
            const int dy = std::abs(wrap_centred(voxels[i].y - voxels[j].y, size.height));
            ASSERT_TRUE(dx > kernel.reach_x() || dy > kernel.reach_y());
          }
        }
      }
    }
  }
}

TEST(VectorMask, KeepsTheValuesOfEachSlice) {
  const VectorMaskOptions options = with(VectorValues::vec2, {32, 32, 4}, 4);
  Grid<std::uint32_t> before = curve_mask(options);
  Grid<std::uint32_t> after = vector_mask(options);
  EXPECT_NE(before, after);
  const VectorKernel kernel = kernel_of(options);
  EXPECT_LT(reference_energy(options, after, kernel), reference_energy(options, before, kernel));
  for (int z = 0; z < 4; ++z) {
    std::sort(before.slice(z).begin(), before.slice(z).end());
    std::sort(after.slice(z).begin(), after.slice(z).end());
  }
  EXPECT_EQ(before, after);
}

TEST(VectorMask, EqualValuesAreNotExchanged) {
  const VectorMaskOptions options = with(VectorValues::vec3, {24, 24, 2}, 2);
  const Grid<std::uint32_t> same(options.mask.size, 1u << 30);
  VectorField field(options.values, options.energy, same);
  const VectorKernel kernel = kernel_of(options);
  EXPECT_EQ(exchange_gain(field, kernel, {0, 0, 0}, {1, 0, 0}), 0);
  ProgressMeter meter({}, 1);
  exchange_values(field, kernel, options, {}, meter);
  EXPECT_EQ(field.places(), same);
}

TEST(VectorMask, WithoutABudgetIsTheCurves) {
  const VectorMaskOptions options = with(VectorValues::sphere, {16, 16, 4}, 0);
  EXPECT_EQ(vector_mask(options), curve_mask(options));
}

TEST(VectorMask, WithoutAKernelIsTheCurves) {
  VectorMaskOptions options = with(VectorValues::vec2, {16, 16, 1}, 5);
  options.mask.spatial = SpatialFilter::none;
  EXPECT_EQ(vector_mask(options), curve_mask(options));
}

TEST(VectorMask, GoldenBytes) {
  const Grid<std::uint32_t> places = vector_mask(with(VectorValues::vec2, {32, 32, 8}, 2));
  std::uint64_t state = 14695981039346656037u;  // FNV-1a
  for (const std::uint32_t place : places) state = (state ^ place) * 1099511628211u;
  EXPECT_EQ(state, 5339386879880241957u);
}

TEST(VectorMask, RefusesBadOptions) {
  EXPECT_THROW(vector_mask(with(VectorValues::vec2, {16, 16, 4}, -1)), Error);
  EXPECT_THROW(vector_mask(with(VectorValues::vec2, {16, 16, 4}, kMostVectorBudget + 1)), Error);
  EXPECT_THROW(vector_mask(with(VectorValues::vec2, {16, 0, 4}, 1)), Error);
  EXPECT_THROW(vector_mask(with(VectorValues::vec2, {64, 64, 64}, 1), {.memory_limit_bytes = 1 << 20}),
               Error);
}

TEST(VectorMask, StopsWhenAsked) {
  std::stop_source source;
  Execution execution{.stop = source.get_token()};
  execution.progress = [&](double done) {
    if (done > 0.0) source.request_stop();
  };
  try {
    vector_mask(with(VectorValues::vec2, {32, 32, 2}, 10000), execution);
    FAIL() << "not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace bn
