// Protects: what bn/noise.h promises besides the mask: options refused, memory limited, stops heeded,
// progress reported, and kernels that cannot overflow.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>
#include <vector>

#include "bn/error.h"
#include "bn/noise.h"
#include "noise/gaussian_kernel.h"

namespace bn {
using namespace noise;
namespace {

void expect_refused(const VoidAndClusterOptions& options, const std::string& where) {
  try {
    void_and_cluster(options);
    ADD_FAILURE() << where << " was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_input);
    EXPECT_EQ(error.info().where, where);
    EXPECT_FALSE(error.info().limit.empty());
  }
}

TEST(Contract, RefusesOptionsOutsideTheirRange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Extent size : {Extent{0, 8}, {8, 0}, {-1, 8}, {16385, 8}, {8, 16385}})
    expect_refused({.size = size}, "size");
  for (const double sigma : {0.0, 0.29, -1.9, 16.1, kNan, kInfinity})
    expect_refused({.sigma_px = sigma}, "sigma_px");
  for (const double density : {-0.1, 0.51, kNan})
    expect_refused({.initial_density = density}, "initial_density");
  for (const int cutoff : {-1, 65}) expect_refused({.cutoff_px = cutoff}, "cutoff_px");
  EXPECT_THROW(void_and_cluster({}, {.threads = -1}), Error);
}

TEST(Contract, SaysWhatWasWrong) {
  try {
    void_and_cluster({.size = {64, 20000}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "size: a mask of 64x20000 pixels (allowed: 1x1..16384x16384)");
  }
}

TEST(Contract, RespectsTheMemoryLimitBeforeWorking) {
  try {
    void_and_cluster({.size = {16384, 16384}}, {.memory_limit_bytes = std::uint64_t{3} << 30});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::over_limit);
  }
  EXPECT_NO_THROW(void_and_cluster({.size = {64, 64}}, {.memory_limit_bytes = std::uint64_t{3} << 20}));
}

TEST(Contract, StopsWhenAsked) {
  for (const int threads : {1, 3}) {
    std::stop_source source;
    const Execution execution{.threads = threads, .stop = source.get_token(), .progress = [&](double done) {
                                if (done > 0.2) source.request_stop();
                              }};
    try {
      void_and_cluster({.size = {512, 512}}, execution);
      ADD_FAILURE() << "it went on to the end";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
  }
}

TEST(Contract, ReportsProgress) {
  for (const int threads : {1, 3}) {
    std::vector<double> reports;
    void_and_cluster({.size = {1024, 512}, .initial_density = 0.2},
                     {.threads = threads, .progress = [&](double done) { reports.push_back(done); }});
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
    EXPECT_GE(reports.size(), 20u);
    EXPECT_EQ(reports.back(), 1.0);
  }
}

TEST(GaussianKernel, NeverOverflowsAndReachesFarEnough) {
  for (double sigma = 0.3; sigma <= 16.0; sigma += 0.05) {
    for (const int cutoff : {0, 1, 2, 7, 30, 64}) {
      const GaussianKernel kernel(sigma, cutoff);
      std::int64_t sum = 0;
      for (int y = -kernel.radius(); y <= kernel.radius(); ++y) {
        for (int x = -kernel.radius(); x <= kernel.radius(); ++x) {
          ASSERT_GE(kernel.weight(x, y), 0);
          ASSERT_EQ(kernel.weight(x, y), kernel.weight(y, -x));
          sum += kernel.weight(x, y);
        }
      }
      ASSERT_EQ(sum, kernel.sum());
      ASSERT_LT(sum + kStartEnergyLimit, kSetMark) << sigma << ", " << cutoff;
      ASSERT_GT(sum, kSetMark / 10 * 9) << sigma << ", " << cutoff;
      ASSERT_LE(kernel.radius(), cutoff == 0 ? kMaxKernelRadius : cutoff);
      ASSERT_GT(kernel.weight(kernel.radius(), 0), 0);
    }
  }
  EXPECT_EQ(GaussianKernel(1.5, 0).radius(), 9);
  EXPECT_EQ(GaussianKernel(1.9, 0).radius(), 11);
  EXPECT_EQ(GaussianKernel(16.0, 0).radius(), 64);
}

}  // namespace
}  // namespace bn
