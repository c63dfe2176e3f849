// Protects: the checks pass what is good and fail what is not, naming the figure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bn/noise.h"
#include "direct_dft.h"
#include "raised_floor.h"
#include "reference_mask.h"
#include "reference_stbn.h"

namespace bn {
namespace {

std::vector<std::string> failures(const std::vector<double>& values, Shape shape, double range, Check kind) {
  std::vector<std::string> names;
  for (const CheckFailure& f : check(analyse(values, shape, 0.0, range).figures, kind))
    names.push_back(f.figure);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<double> values_of(const Grid<std::uint32_t>& rank) { return {rank.begin(), rank.end()}; }

std::vector<double> baked_mask(int side, double sigma_px) {
  return values_of(void_and_cluster({.size = {side, side}, .sigma_px = sigma_px}));
}

TEST(CheckBlue, PassesGoodMasks) {
  for (const int side : {32, 64, 128}) {
    for (const double sigma : {1.5, 1.9}) {
      EXPECT_TRUE(failures(baked_mask(side, sigma), {side, side}, side * side, Check::blue).empty()) << side;
    }
  }
}

TEST(CheckBlue, PassesNineOfTenSmallMasks) {
  for (int side = 8; side <= 24; ++side) {
    int passed = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto mask = values_of(void_and_cluster({.size = {side, side}, .seed = seed}));
      passed += failures(mask, {side, side}, side * side, Check::blue).empty() ? 1 : 0;
    }
    EXPECT_GE(passed, 9) << side;
  }
}

TEST(CheckBlue, PassesPetersMasks) {
  for (const char* name :
       {"peters_cc0_128_HDR_L_0.png", "peters_cc0_128_LDR_LLL1_0.png", "peters_cc0_64_HDR_L_0.png"}) {
    const test::Mask mask = test::reference_mask(name);
    EXPECT_TRUE(failures(mask.values, mask.shape, mask.range, Check::blue).empty()) << name;
  }
}

TEST(CheckBlue, FailsARaisedFloor) {
  const auto mask = test::with_raised_floor(baked_mask(128, 1.9), 128, 0.015);
  EXPECT_NEAR(analyse(mask, {128, 128}, 0.0, 128 * 128).figures.bands.mean[0], 0.015, 0.001);
  EXPECT_EQ(failures(mask, {128, 128}, 128 * 128, Check::blue), std::vector<std::string>{"bands[0]"});
}

TEST(CheckBlue, FailsWhiteNoise) {
  for (const int side : {32, 64, 128}) {
    const auto names = failures(test::white_values(side * side, 1), {side, side}, 1.0, Check::blue);
    EXPECT_TRUE(contains(names, "bands[0]") && contains(names, "bands[3]"));
  }
}

TEST(CheckBlue, FailsABayerMatrixForItsIsotropy) {
  for (const int side : {16, 64, 256}) {
    EXPECT_TRUE(contains(failures(values_of(bayer_mask(side)), {side, side}, side * side, Check::blue),
                         "anisotropy_db_mean"))
        << side;
  }
}

TEST(CheckBlue, FailsTheOtherBaselines) {
  const Shape shape{128, 128};
  const auto fails = [&](const Grid<std::uint32_t>& rank, double range) {
    return !failures(values_of(rank), shape, range, Check::blue).empty();
  };
  EXPECT_TRUE(fails(white_noise_mask({128, 128}, 1), 16384));
  EXPECT_TRUE(fails(interleaved_gradient_mask({128, 128}), 16384));
  EXPECT_TRUE(fails(r2_mask({128, 128}), 16384));
  EXPECT_TRUE(fails(tiled(void_and_cluster({.size = {32, 32}}), {128, 128}), 1024));
}

TEST(CheckBlue, FailsASkewedHistogram) {
  auto mask = baked_mask(64, 1.9);
  for (double& rank : mask) rank = rank * rank / 4096.0;
  EXPECT_EQ(failures(mask, {64, 64}, 4096, Check::blue), std::vector<std::string>{"histogram_max_deviation"});
}

TEST(CheckBlue, FailsAConstant) {
  EXPECT_TRUE(contains(failures(std::vector<double>(4096, 1.0), {64, 64}, 4096, Check::blue), "peak"));
}

TEST(CheckWhite, PassesWhiteNoiseOfAnySize) {
  for (const Shape shape :
       {Shape{16, 16}, Shape{32, 48}, Shape{64, 64}, Shape{200, 100}, Shape{32, 32, 16}}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      EXPECT_TRUE(failures(test::white_values(shape.count(), seed), shape, 1.0, Check::white).empty())
          << seed;
    }
  }
}

TEST(CheckWhite, FailsBlueNoise) {
  EXPECT_TRUE(contains(failures(baked_mask(64, 1.9), {64, 64}, 4096, Check::white), "bands[1]"));
}

TEST(CheckStbn, PassesSpatiotemporalMasks) {
  for (const Shape shape : {Shape{32, 32, 16}, Shape{32, 32, 8}, Shape{24, 40, 12}}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto volume = test::spatiotemporal_mask(shape, 1.9, 1.9, seed);
      const double range = static_cast<double>(shape.count());
      EXPECT_EQ(failures(volume, shape, range, Check::stbn), std::vector<std::string>{}) << shape.depth;
    }
  }
}

TEST(CheckStbn, FailsMasksThatAreIndependentInTime) {
  const Shape shape{32, 32, 16};
  std::vector<double> volume;
  for (std::uint64_t z = 0; z < 16; ++z) {
    const auto rank = void_and_cluster({.size = {32, 32}, .seed = z + 1});
    volume.insert(volume.end(), rank.begin(), rank.end());
  }
  EXPECT_EQ(failures(volume, shape, 1024.0, Check::stbn),
            (std::vector<std::string>{"temporal_power_at_0", "temporal_power_low", "filtered_residual_db"}));
}

TEST(CheckStbn, FailsSlicesOutOfOrder) {
  const Shape shape{32, 32, 16};
  const auto volume = test::spatiotemporal_mask(shape, 1.9, 1.9, 1);
  std::vector<double> shuffled;
  for (std::ptrdiff_t z = 0; z < 16; ++z) {
    const auto slice = volume.begin() + z * 5 % 16 * 1024;
    shuffled.insert(shuffled.end(), slice, slice + 1024);
  }
  EXPECT_EQ(failures(shuffled, shape, 16384.0, Check::stbn), std::vector<std::string>{"temporal_power_low"});
}

TEST(CheckStbn, FailsWhiteNoise) {
  const Shape shape{32, 32, 16};
  const auto names = failures(test::white_values(shape.count(), 1), shape, 1.0, Check::stbn);
  for (const char* name : {"bands[0]", "bands[3]", "temporal_power_at_0", "temporal_power_low"}) {
    EXPECT_TRUE(contains(names, name)) << name;
  }
}

TEST(CheckStbn, FailsAMaskShiftedByTheGoldenRatio) {
  const Shape shape{32, 32, 16};
  std::vector<double> volume;
  for (const auto& slice : golden_ratio_slices(void_and_cluster({.size = {32, 32}}), 16)) {
    volume.insert(volume.end(), slice.begin(), slice.end());
  }
  EXPECT_TRUE(contains(failures(volume, shape, 1024.0, Check::stbn), "bands[0]"));
}

TEST(CheckStbn, FailsAPicture) {
  EXPECT_TRUE(contains(failures(baked_mask(32, 1.9), {32, 32}, 1024.0, Check::stbn), "depth"));
}

TEST(Judge, ListsEveryFigureAndAgreesWithCheck) {
  const Shape shape{64, 64};
  const auto figures = analyse(test::white_values(shape.count(), 1), shape, 0.0, 1.0).figures;
  std::vector<std::string> missed;
  std::size_t kept = 0;
  for (const auto& [figure, value, low, high, passed] : judge(figures, Check::blue)) {
    EXPECT_EQ(passed, value >= low && value <= high) << figure;
    passed ? void(++kept) : missed.push_back(figure);
  }
  std::vector<std::string> failed;
  for (const auto& failure : check(figures, Check::blue)) failed.push_back(failure.figure);
  EXPECT_EQ(missed, failed);
  EXPECT_GE(kept, 2u);  // white noise is isotropic
}

}  // namespace
}  // namespace bn
