// Protects: the sources are the sequences they are called after; the integrands have the integrals that are
// stated; what is measured equals sums written out; white noise has its closed forms; resets mean what the
// header says.
#include "bn_study/convergence_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bn/error.h"
#include "bn/offsets.h"

namespace bn {
namespace {

const std::vector<SampleSource>& small_sources() {
  static const std::vector<SampleSource> sources = sample_sources({32, 32, 16}, 1, {.threads = 1});
  return sources;
}

const SampleSource& source(const std::string& name) {
  return *std::find_if(small_sources().begin(), small_sources().end(),
                       [&](const SampleSource& s) { return s.name == name; });
}

TEST(SampleSources, LieInTheUnitInterval) {
  EXPECT_EQ(small_sources().size(), 9u);
  for (const SampleSource& s : small_sources()) {
    for (const Grid<float>* numbers : {&s.first, &s.second}) {
      EXPECT_EQ(numbers->shape(), (Shape{32, 32, 16})) << s.name;
      for (const float v : *numbers) ASSERT_TRUE(v >= 0.0f && v < 1.0f) << s.name << " " << v;
    }
  }
}

/// From frame to frame a rotated source moves by the sequence's differences, the same at every pixel.
TEST(SampleSources, RotatedOnesFollowTheirSequence) {
  struct Case {
    const char* name;
    std::array<double, 4> first, second;
  };
  // Halton in bases 2 and 3, Sobol's first two dimensions: the textbook's first points.
  const std::vector<Case> cases{
      {"rotated Halton", {0.0, 1.0 / 2, 1.0 / 4, 3.0 / 4}, {0.0, 1.0 / 3, 2.0 / 3, 1.0 / 9}},
      {"rotated Sobol", {0.0, 1.0 / 2, 1.0 / 4, 3.0 / 4}, {0.0, 1.0 / 2, 3.0 / 4, 1.0 / 4}}};
  for (const Case& c : cases) {
    const SampleSource& s = source(c.name);
    for (const auto& [numbers, sequence] : {std::pair{&s.first, &c.first}, std::pair{&s.second, &c.second}}) {
      for (int frame = 1; frame < 4; ++frame) {
        for (std::size_t pixel = 0; pixel < 40; ++pixel) {
          double moved = numbers->slice(frame)[pixel] - numbers->slice(0)[pixel];
          moved -= std::floor(moved);
          EXPECT_NEAR(moved, (*sequence)[static_cast<std::size_t>(frame)], 1e-5) << c.name << " " << frame;
        }
      }
    }
  }
}

TEST(Integrands, HaveTheirIntegrals) {
  constexpr int kSide = 1500;
  for (const Integrand& f : integrands()) {
    double sum = 0.0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x)
        sum += f.value((static_cast<float>(x) + 0.5f) / kSide, (static_cast<float>(y) + 0.5f) / kSide);
    }
    EXPECT_NEAR(sum / kSide / kSide, f.integral, 5e-4) << f.name;
  }
}

const Convergence& of(const std::vector<Convergence>& all, std::string_view integrand) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const Convergence& c) { return c.integrand == integrand; });
}

TEST(StudyConvergence, WhiteNoiseHasItsClosedForms) {
  const auto all = study_convergence(sample_sources({64, 64, 32}, 3)[0], {.frames = 32, .reset = 8});
  const double blurred = 1.0 / (2.0 * 1.3435 * std::sqrt(std::numbers::pi));
  const auto expect = [&](const char* integrand, double deviation) {
    const Convergence& c = of(all, integrand);
    EXPECT_NEAR(c.mean[0] / deviation, 1.0, 0.04) << integrand;
    EXPECT_NEAR(c.mean[31] * std::sqrt(32.0) / deviation, 1.0, 0.04) << integrand;
    EXPECT_NEAR(c.filtered[0] / (deviation * blurred), 1.0, 0.07) << integrand;
    EXPECT_NEAR(c.later[31] / (deviation * blurred * std::sqrt(0.1 / 1.9)), 1.0, 0.25) << integrand;
    EXPECT_NEAR(c.denoised[0] / (deviation / 3.0 * std::sqrt(0.1 / 1.9)), 1.0, 0.2) << integrand;  // box 3
  };
  expect("heavisides", std::sqrt(1.0 / 6.0));
  expect("step", 0.5);
  expect("ramp", std::sqrt(1.0 / 12.0));
  expect("triangle", 0.5);
  expect("disk", 0.5);
  expect("bilinear", std::sqrt(1.0 / 9.0 - 1.0 / 16.0));
}

TEST(StudyConvergence, EqualsTheMeasureOfPresets) {
  const SampleSource& both = source("both");
  const Convergence steps = study_convergence(both, {.frames = 16})[0];
  const std::vector<double> error = filtered_error(both.first, {}, 16);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(steps.filtered[i] / error[i], 1.0, 2e-3) << i;
  const std::vector<double> later = filtered_error(both.first, {}, 16, 5);
  EXPECT_NEAR(steps.later[15] / later[15], 1.0, 2e-3);
}

/// Two pixels side by side, nothing blurred, written out by hand.
TEST(StudyConvergence, EqualsSumsWrittenOut) {
  SampleSource s = source_of_stack("tiny", Grid<float>({2, 1, 2}));
  const std::array<float, 4> samples{0.25f, 0.75f, 0.5f, 1.0f / 1024};
  std::copy(samples.begin(), samples.end(), s.first.begin());
  const Convergence ramp =
      of(study_convergence(s, {.filter = {.taps = {}, .alpha = 0.5}, .frames = 3, .reset = 1}), "ramp");
  const auto rms = [](double a, double b) {
    return std::sqrt(((a - 0.5) * (a - 0.5) + (b - 0.5) * (b - 0.5)) / 2.0);
  };
  const double last = 1.0 / 1024;
  EXPECT_NEAR(ramp.mean[0], rms(0.25, 0.75), 1e-6);
  EXPECT_NEAR(ramp.mean[1], rms(0.375, (0.75 + last) / 2.0), 1e-6);
  EXPECT_NEAR(ramp.filtered[2], rms(0.3125, ((0.75 + last) / 2.0 + 0.75) / 2.0), 1e-6);
  EXPECT_NEAR(ramp.moving, rms(0.25, 0.75), 1e-6);    // every frame begins anew, and the last is slice 0
  EXPECT_NEAR(ramp.later[0], rms(0.25, 0.75), 1e-6);  // a third of two slices: none
}

TEST(StudyConvergence, AnAverageThatIsLostLeavesMore) {
  const auto all = study_convergence(source("both"), {.frames = 16, .reset = 8});
  EXPECT_GT(all[0].moving, all[0].filtered[15] * 1.2);
  EXPECT_LT(all[0].moving, all[0].filtered[0]);
}

TEST(StudyConvergence, NamesBadInput) {
  EXPECT_THROW(study_convergence(source("both"), {.frames = 1}), Error);
  EXPECT_THROW(study_convergence(source("both"), {.frames = 8, .reset = 9}), Error);
  EXPECT_THROW(study_convergence(source("both"), {.filter = {.alpha = 0.0}, .frames = 16}), Error);
  SampleSource unlike{"unlike", Grid<float>({4, 4, 2}), Grid<float>({4, 4, 3})};
  EXPECT_THROW(study_convergence(unlike, {.frames = 4, .reset = 2}), Error);
}

TEST(StudyConvergence, ThreadsChangeNothing) {
  const auto one = study_convergence(source("stbn"), {.frames = 16}, {.threads = 1});
  EXPECT_EQ(convergence_csv(one),
            convergence_csv(study_convergence(source("stbn"), {.frames = 16}, {.threads = 3})));
  EXPECT_EQ(denoised_csv(one),
            denoised_csv(study_convergence(source("stbn"), {.frames = 16}, {.threads = 3})));
}

}  // namespace
}  // namespace bn
