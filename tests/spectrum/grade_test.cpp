// Protects: the grade tells the best known from the passable, and says why; its reference is what our masks
// read.
#include <gtest/gtest.h>

#include <cmath>

#include "bn/judgement.h"
#include "bn/noise.h"
#include "bn/spatiotemporal.h"
#include "direct_dft.h"
#include "raised_floor.h"

namespace bn {
namespace {

std::vector<double> ranks(Extent size, std::uint64_t seed = 1, double sigma_px = 1.9) {
  const auto rank = void_and_cluster({.size = size, .sigma_px = sigma_px, .seed = seed});
  return {rank.begin(), rank.end()};
}

Judgement judged(const std::vector<double>& values, Shape shape, Check kind = Check::blue) {
  const double high = static_cast<double>(shape.count());
  return judge_texture({values, shape, 0.0, high}, analyse(values, shape, 0.0, high), kind);
}

TEST(Grade, ReferenceIsWhatOurMasksRead) {
  for (const int side : {24, 32, 64, 128}) {
    const auto best = best_known_bands({side, side});
    const int seeds = side <= 64 ? 40 : 10;
    std::array<int, 4> above{};
    std::array<double, 4> mean{};
    for (int seed = 1; seed <= seeds; ++seed) {
      auto eight_bit = ranks({side, side}, static_cast<std::uint64_t>(seed));
      for (double& r : eight_bit) r = std::floor(r * 256.0 / (side * side));
      const auto figures = analyse(eight_bit, {side, side}, 0.0, 256.0).figures;
      for (std::size_t b = 0; b < 4; ++b) {
        above[b] += figures.bands.mean[b] > best[b];
        mean[b] += figures.bands.mean[b] / seeds;
      }
    }
    for (std::size_t b = 0; b < 4; ++b) {
      EXPECT_LE(above[b], seeds / 5) << side << " " << b;     // one in twenty is meant
      EXPECT_LT(best[b], 3.0 * mean[b]) << side << " " << b;  // and it is no loose bound
    }
  }
}

TEST(Grade, SlicesForAFilterAreHeldAgainstTheBestOfTheirKind) {
  const auto rank = spatiotemporal_mask({.size = {64, 64, 16}, .preset = SpatiotemporalPreset::filtered});
  const std::vector<double> values(rank.begin(), rank.end());
  const auto figures = analyse(values, rank.shape(), 0.0, 64.0 * 64.0).figures;
  EXPECT_GE(grade(figures, Check::blue).score, 90.0);
  EXPECT_LT(grade(figures, Check::stbn).score, 50.0) << "a pixel's series is white";
}

TEST(Grade, ReferenceFallsWithTheSize) {
  std::array<double, 4> before{1.0, 1.0, 1.0, 1.0};
  for (const int side : {1, 8, 9, 15, 16, 17, 24, 31, 64, 100, 128, 200, 256, 512, 513, 4096}) {
    const auto best = best_known_bands({side, side});
    EXPECT_EQ(std::isnan(best[0]), side <= 8) << side;
    for (std::size_t b = 0; b < 4; ++b) {
      if (std::isnan(best[b])) continue;
      EXPECT_LE(best[b], before[b] * 1.0001) << side << " " << b;
      EXPECT_GT(best[b], 1e-5);
      before[b] = best[b];
    }
  }
}

TEST(Grade, OursAreAsGoodAsTheBestKnown) {
  for (const Extent size : {Extent{32, 32}, {64, 64}, {128, 128}, {96, 48}}) {
    const Judgement judgement = judged(ranks(size), size);
    EXPECT_EQ(judgement.outcome, Judgement::Outcome::good);
    EXPECT_GT(judgement.grade.score, 95.0) << size.width;
    EXPECT_EQ(judgement.headline, "blue noise");
    EXPECT_TRUE(judgement.reasons.empty());
  }
  EXPECT_GT(judged(ranks({64, 64}, 1, 1.5), {64, 64}).grade.score, 90.0);
}

TEST(Grade, SeventyTimesWorseIsWeakAndSaysSo) {
  const Judgement judgement =
      judged(test::with_raised_floor(ranks({128, 128}), 128, 70 * 2.4e-5), {128, 128});
  EXPECT_EQ(judgement.outcome, Judgement::Outcome::weak);
  EXPECT_TRUE(judgement.passed());
  EXPECT_EQ(judgement.headline, "weak blue noise");
  EXPECT_EQ(judgement.grade.weakest, "bands[0]");
  EXPECT_NEAR(judgement.grade.score, 64.0, 3.0);
  ASSERT_EQ(judgement.reasons.size(), 1u);
  EXPECT_NE(judgement.reasons[0].find("power, 0 < f <= 0.0625: 0.0016"), std::string::npos)
      << judgement.reasons[0];
}

TEST(Grade, FallsAsPowerRises) {
  double before = 101.0;
  for (const double power : {1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
    const auto values = test::with_raised_floor(ranks({64, 64}), 64, power);
    const double score = grade(analyse(values, {64, 64}, 0, 4096).figures, Check::blue).score;
    EXPECT_LT(score, before);
    before = score;
  }
}

TEST(Grade, WhiteNoiseAndBayerScoreNothing) {
  const Shape shape{64, 64};
  const Judgement white = judged(test::white_values(4096, 1), shape);
  EXPECT_LT(white.grade.score, 3.0);
  EXPECT_EQ(white.headline, "white noise");
  EXPECT_EQ(white.outcome, Judgement::Outcome::failed);
  const auto bayer = bayer_mask(64);
  const Judgement ordered = judged({bayer.begin(), bayer.end()}, shape);
  EXPECT_EQ(ordered.headline, "not blue noise");
  EXPECT_LT(ordered.grade.score, 30.0);
  EXPECT_EQ(ordered.grade.weakest, "anisotropy_db_mean");
  EXPECT_EQ(judged(std::vector<double>(4096, 1.0), shape).grade.score, 0.0);
}

TEST(Judgement, SaysWhatIsTooSmall) {
  const std::vector<double> four{0, 3, 2, 1};
  const Judgement tiny = judged(four, {2, 2});
  EXPECT_EQ(tiny.outcome, Judgement::Outcome::cannot_tell);
  EXPECT_EQ(tiny.headline, "too small to judge");
  EXPECT_FALSE(tiny.passed());
  EXPECT_TRUE(std::isnan(tiny.grade.score));
  EXPECT_EQ(tiny.not_judged.size(), 6u);
  ASSERT_EQ(tiny.reasons.size(), 1u);
  EXPECT_NE(tiny.reasons[0].find("2 x 2"), std::string::npos);
  const Judgement small = judged(ranks({8, 8}), {8, 8});
  EXPECT_NE(std::find(small.not_judged.begin(), small.not_judged.end(), "bands[0]"), small.not_judged.end());
}

TEST(Judgement, GivesTheLikelyCauseFirst) {
  auto mask = ranks({64, 64});
  for (double& r : mask) r = 4096 * std::pow((r + 0.5) / 4096, 1 / 2.2);
  const Judgement judgement = judged(mask, {64, 64});
  ASSERT_EQ(judgement.reasons.size(), 2u);
  EXPECT_EQ(judgement.reasons[0], "looks gamma-encoded, exponent .45 (1/2.2)");
  EXPECT_TRUE(judgement.reasons[1].starts_with("histogram, largest deviation: ")) << judgement.reasons[1];
  EXPECT_GT(judgement.grade.score, 95.0);  // the ranks are as they were
}

TEST(Judgement, TriangularIsAskedFor) {
  auto mask = ranks({64, 64});
  for (double& r : mask) {
    const double v = (r + 0.5) / 4096;
    r = std::floor(256 * (v < 0.5 ? std::sqrt(v / 2) : 1 - std::sqrt((1 - v) / 2)));
  }
  const auto outcome = [&](Distribution distribution) {
    const Analysis analysis = analyse(mask, {64, 64}, 0, 256, {}, distribution);
    return judge_texture({mask, {64, 64}, 0, 256}, analysis, Check::blue).outcome;
  };
  EXPECT_EQ(outcome(Distribution::triangular), Judgement::Outcome::good);
  EXPECT_EQ(outcome(Distribution::uniform), Judgement::Outcome::failed);
  const Analysis even = analyse(ranks({64, 64}), {64, 64}, 0, 4096, {}, Distribution::triangular);
  EXPECT_FALSE(check(even.figures, Check::blue).empty());
}

TEST(Describe, UsesTheWordsOfTheTable) {
  EXPECT_EQ(describe(JudgedFigure{"bands[0]", 0.015, 0.0, 0.002, false}),
            "power, 0 < f <= 0.0625: 0.015, at most 0.002");
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(describe(JudgedFigure{"anisotropy_db_mean", 11.2, -inf, 1.5, false}),
            "anisotropy, mean, dB: 11.2, at most 1.5");
  EXPECT_EQ(describe(JudgedFigure{"bands[1]", 3, 0.5, 1.5, false}),
            "power, 0.0625 < f <= 0.125: 3, 0.5 to 1.5 is allowed");
  EXPECT_EQ(describe(JudgedFigure{"peak", 0, 0.0, inf, false}),
            "peak of the radial power: 0, more than 0 is needed");
}

}  // namespace
}  // namespace bn
