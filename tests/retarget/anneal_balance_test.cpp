// Protects: acceptance follows exp(-change / T), and both engines sample Boltzmann's distribution, which
// enumeration knows on tiny tiles. Seeds are fixed.
#include <gtest/gtest.h>

#include <cmath>

#include "boltzmann.h"
#include "retarget/sweep.h"

namespace bn {
using namespace retarget;
namespace {

TEST(Metropolis, ThresholdsFollowTheExponential) {
  // The thresholds as sweeps draw them, by size: P(threshold = k) = exp(-k/T) - exp(-(k+1)/T).
  for (const float temperature : {0.3f, 1.0f, 7.5f, 900.0f}) {
    const int step = std::max(1, static_cast<int>(temperature / 4.0f));
    constexpr int kBins = 60;
    std::array<double, kBins + 1> count{};
    Sweep sweep;
    sweep.key_even = 0x1234567u;
    sweep.key_odd = 0x89abcdefu;
    constexpr int kWidth = 1001, kHeight = 2000;
    for (int y = 0; y < kHeight; ++y) {
      if (y % 100 == 0)
        sweep.key_even = mix(sweep.key_even + 1, 3), sweep.key_odd = mix(sweep.key_odd + 1, 5);
      for (int x = 0; x < kWidth; ++x) {
        const std::int64_t threshold =
            anneal::metropolis_threshold(pair_bits(sweep, kWidth, x, y), temperature);
        ++count[static_cast<std::size_t>(std::min<std::int64_t>(threshold / step, kBins))];
      }
    }
    constexpr double kDraws = double{kWidth} * kHeight;
    double chi_square = 0.0;
    int bins = 0;
    for (int k = 0; k < kBins; ++k) {
      const double expected = kDraws * (std::exp(-k * step / double{temperature}) -
                                        std::exp(-(k + 1) * step / double{temperature}));
      if (expected < 10.0) break;
      const double difference = count[static_cast<std::size_t>(k)] - expected;
      chi_square += difference * difference / expected;
      ++bins;
    }
    EXPECT_LT(chi_square, critical_chi_square(bins)) << temperature;
  }
}

TEST(Metropolis, EnginesAcceptAsOftenAsTheyShould) {
  // Two levels: every worsening is 2 units under L1.
  AnnealProblem problem;
  problem.channels = {{random_levels({64, 64}, 3, 2)}};
  problem.retarget.step = {13, 7};
  const AnnealInstance instance(problem, 0);
  for (const bool scalar : {false, true}) {
    for (const double temperature : {0.4, 1.0, 5.0}) {
      const auto engine = (scalar ? make_scalar_engine : make_sweep_engine)(instance, 1, 0);
      WorseningCounts worsenings;
      engine->round(0, 60, temperature, {});
      for (int round = 1; round <= 10; ++round) engine->round(round, 60, temperature, {}, &worsenings);
      const double chance = std::exp(-2.0 / temperature);
      const auto tried = static_cast<double>(worsenings.tried[1]);
      ASSERT_GT(tried * chance, 100.0);
      const double deviation = (static_cast<double>(worsenings.accepted[1]) - tried * chance) /
                               std::sqrt(tried * chance * (1.0 - chance));
      EXPECT_LT(std::fabs(deviation), 4.42) << scalar << " " << temperature;
    }
  }
}

/// Samples energies at a constant temperature and compares with all permutations within reach.
void expect_boltzmann(Extent size, RetargetOptions options, double temperature, bool scalar) {
  SCOPED_TRACE(testing::Message() << size.width << "x" << size.height << " radius " << options.radius
                                  << " euclidean " << (options.reach == Reach::euclidean) << " wrap "
                                  << options.wrap << " scalar " << scalar);
  AnnealProblem problem;
  problem.channels = {{random_levels(size, 5, 6)}};
  problem.retarget = options;
  const auto matrix = cost_matrix(problem.channels[0].levels, options);
  const AnnealInstance instance(problem, 2 * options.radius);
  const auto engine = (scalar ? make_scalar_engine : make_sweep_engine)(instance, 1, 0);
  expect_samples(*engine, boltzmann(matrix, temperature), temperature, 5);
}

TEST(DetailedBalance, BothEnginesSampleBoltzmannsDistribution) {
  for (const bool scalar : {false, true}) {
    expect_boltzmann({3, 3}, {.step = {1, 1}, .radius = 1}, 4.0, scalar);
    expect_boltzmann({3, 3}, {.step = {1, 2}, .radius = 6, .metric = Metric::l2}, 9.0, scalar);
    expect_boltzmann({1, 8}, {.step = {0, 3}, .radius = 1}, 3.0, scalar);
    expect_boltzmann({8, 1}, {.step = {3, 0}, .radius = 2}, 3.0, scalar);
    expect_boltzmann({8, 1}, {.step = {3, 0}, .radius = 1, .wrap = false}, 3.0, scalar);
    expect_boltzmann({4, 2}, {.step = {2, 1}, .radius = 2, .reach = Reach::euclidean}, 3.0, scalar);
    expect_boltzmann({3, 3}, {.step = {1, 1}, .radius = 1, .reach = Reach::euclidean, .wrap = false}, 3.0,
                     scalar);
  }
}

}  // namespace
}  // namespace bn
