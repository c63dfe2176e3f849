// Protects: what start and end temperatures stand for holds for constant, two-level, 8 bit, 16 bit and float
// images: automatic ones grow with the unit of the levels and do not heat images of few levels; a wished
// acceptance is met; "everything" accepts what it says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "bn/texture.h"
#include "reference.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;
namespace {

AnnealProblem problem_of(Grid<std::int32_t> levels) {
  AnnealProblem problem;
  problem.channels = {{std::move(levels)}};
  problem.retarget.step = {23, 17};
  problem.retarget.radius = 3;
  return problem;
}

template <class Sample>
Grid<std::int32_t> levels_of(const Grid<std::int32_t>& values, SampleType type,
                             const std::function<Sample(std::int32_t)>& sample) {
  Image image{.size = values.size(), .channels = 1, .type = type, .samples = {}};
  image.samples.resize(values.count() * sizeof(Sample));
  for (std::size_t i = 0; i < values.count(); ++i) {
    const Sample one = sample(values[i]);
    std::memcpy(image.samples.data() + i * sizeof(Sample), &one, sizeof(Sample));
  }
  return levels_of_channel(image, 0).value;
}

/// 0..count - 1 spread over the range of 8 bit, 16 bit and float samples; count - 1 divides 255.
struct Encodings {
  Grid<std::int32_t> bits8, bits16, floats;
  explicit Encodings(int count) {
    const Grid<std::int32_t> values = random_levels({48, 40}, 4, count);
    const int gap = 255 / (count - 1);
    bits8 = levels_of<std::uint8_t>(values, SampleType::u8,
                                    [&](int v) { return static_cast<std::uint8_t>(v * gap); });
    bits16 = levels_of<std::uint16_t>(values, SampleType::u16,
                                      [&](int v) { return static_cast<std::uint16_t>(v * gap * 257); });
    floats = levels_of<float>(values, SampleType::f32,
                              [&](int v) { return -3.0f + 0.25f * static_cast<float>(v * gap); });
  }
};

TEST(AnnealTemperature, AutomaticOnesGrowWithTheUnit) {
  for (const int count : {2, 4, 16, 256}) {
    SCOPED_TRACE(testing::Message() << count << " levels");
    const Encodings same(count);
    const AnnealProblem bits8 = problem_of(same.bits8);
    const TemperatureRange range = automatic_temperatures(bits8);
    const AnnealResult result = anneal_retarget(bits8, {.proposals = 2'000'000});
    for (const auto& levels : {same.bits16, same.floats}) {
      const AnnealProblem other = problem_of(levels);
      const TemperatureRange scaled = automatic_temperatures(other);
      EXPECT_NEAR(scaled.start, 257.0 * range.start, 1e-9 * scaled.start);
      EXPECT_NEAR(scaled.end, 257.0 * range.end, 1e-9 * scaled.end);
      const AnnealResult same_result = anneal_retarget(other, {.proposals = 2'000'000});
      EXPECT_EQ(same_result.tile.move, result.tile.move);
      EXPECT_EQ(same_result.tile.energy, 257 * result.tile.energy);
    }
    AnnealProblem squares8 = bits8, squares16 = problem_of(same.bits16);
    squares8.retarget.metric = squares16.retarget.metric = Metric::l2;
    EXPECT_NEAR(automatic_temperatures(squares16).start,
                257.0 * 257.0 * automatic_temperatures(squares8).start, 1.0);
    AnnealProblem weighted = bits8;
    weighted.channels[0].weight = 7;
    EXPECT_NEAR(automatic_temperatures(weighted).start, 7.0 * range.start, 1e-9 * 7.0 * range.start);
  }
}

TEST(AnnealTemperature, AutomaticOnesDoNotHeatFewLevels) {
  for (const int count : {2, 4, 16, 256}) {
    SCOPED_TRACE(testing::Message() << count << " levels");
    const AnnealProblem problem = problem_of(random_levels({48, 40}, 4, count));
    const std::int64_t optimum = solve_retarget(problem.channels[0].levels, problem.retarget).energy;
    const auto above = [&](const AnnealOptions& options) {
      return anneal_retarget(problem, options).tile.energy - optimum;
    };
    const auto greedy = static_cast<double>(above({.schedule = "greedy", .proposals = 20'000'000}));
    const auto annealed = static_cast<double>(above({.proposals = 20'000'000}));
    // Where levels are few, plateaus are crossed for nothing and there is little to win by climbing.
    EXPECT_LE(annealed, count <= 16 ? 1.25 * greedy + 8.0 : 0.6 * greedy);
  }
}

TEST(AnnealTemperature, AConstantImageHasOneToo) {
  for (const std::int32_t level : {0, 77, (1 << 24) - 1}) {
    const AnnealProblem problem = problem_of(Grid<std::int32_t>({32, 24}, level));
    const TemperatureRange range = automatic_temperatures(problem);
    EXPECT_GT(range.end, 0.0);
    EXPECT_GT(range.start, range.end);
    EXPECT_LE(range.start, 1.0);
    for (const auto rule : {StartTemperature::Rule::automatic, StartTemperature::Rule::acceptance,
                            StartTemperature::Rule::everything}) {
      const AnnealResult result = anneal_retarget(problem, {.start = {rule, 0.5}, .proposals = 100'000});
      EXPECT_EQ(result.tile.energy, 0);
      EXPECT_GT(result.accepted, 0);
      EXPECT_GE(result.start_temperature, result.end_temperature);
    }
  }
}

/// The accepted share of the worsening swaps in one sweep from the identity, of other random numbers than
/// the library samples with.
double acceptance_at(const AnnealProblem& problem, double temperature) {
  const AnnealInstance instance(problem, 0);
  WorseningCounts counts;
  for (std::uint64_t seed = 100; seed < 140; ++seed)
    make_engine(instance, seed, 0)->round(0, 1, temperature, {.threads = 1}, &counts);
  std::int64_t tried = 0, accepted = 0;
  for (std::size_t i = 0; i < counts.tried.size(); ++i) {
    tried += counts.tried[i];
    accepted += counts.accepted[i];
  }
  EXPECT_GT(tried, 1500);
  return static_cast<double>(accepted) / static_cast<double>(tried);
}

TEST(AnnealTemperature, AWishedAcceptanceIsMet) {
  for (const int count : {2, 16, 256}) {
    const Encodings same(count);
    for (const auto& levels : {same.bits8, same.bits16, same.floats}) {
      const AnnealProblem problem = problem_of(levels);
      for (const double wished : {0.1, 0.5, 0.9}) {
        SCOPED_TRACE(testing::Message() << count << " levels, " << wished);
        const AnnealResult result = anneal_retarget(
            problem, {.start = {StartTemperature::Rule::acceptance, wished}, .proposals = 1000});
        EXPECT_NEAR(acceptance_at(problem, result.start_temperature), wished, 0.025);
        if (count == 2) {
          // Every rise is of two seeds that both leave their level.
          const double gap = *std::max_element(levels.begin(), levels.end());
          EXPECT_NEAR(result.start_temperature, 2.0 * gap / std::log(1.0 / wished),
                      1e-5 * result.start_temperature);
        }
      }
    }
  }
}

TEST(AnnealTemperature, EverythingIsAcceptedWithAChanceOfOneInEAtLeast) {
  for (const int count : {2, 16, 256}) {
    const Encodings same(count);
    for (const auto& levels : {same.bits8, same.bits16, same.floats}) {
      const AnnealProblem problem = problem_of(levels);
      const double start =
          anneal_retarget(problem, {.start = {StartTemperature::Rule::everything}, .proposals = 1000})
              .start_temperature;
      EXPECT_EQ(start, 2.0 * *std::max_element(levels.begin(), levels.end()));
      const double share = acceptance_at(problem, start);
      // With two levels every rise is the largest one.
      if (count == 2) {
        EXPECT_NEAR(share, std::exp(-1.0), 0.04);
      } else {
        EXPECT_GT(share, 0.6);
      }
    }
  }
}

}  // namespace
}  // namespace bn
