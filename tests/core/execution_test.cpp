// Protects: loops visit every index once on any thread count, exceptions and stops come out, and
// progress keeps its promise (serial, never backwards, ends at 1).
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iterator>
#include <thread>
#include <vector>

#include "bn/error.h"
#include "core/progress.h"

namespace bn {
namespace {

class ParallelFor : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 2, 3, 7));

TEST_P(ParallelFor, VisitsEveryIndexOnce) {
  for (const int count : {0, 1, 2, 1000}) {
    std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
    parallel_for({.threads = GetParam()}, count,
                 [&](std::int64_t i) { ++visits[static_cast<std::size_t>(i)]; });
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& v) { return v == 1; })) << count;
  }
}

// Loops are called thousands of times in a second; threads must not pile up.
TEST_P(ParallelFor, KeepsTheNumberOfThreadsBounded) {
  const auto threads_of_process = [] {
    const auto tasks = std::filesystem::directory_iterator("/proc/self/task");
    return std::distance(begin(tasks), end(tasks));
  };
  for (int call = 0; call < 2000; ++call) parallel_for({.threads = GetParam()}, 8, [](std::int64_t) {});
  EXPECT_LE(threads_of_process(), std::max(8u, std::thread::hardware_concurrency()) + 2);
}

TEST_P(ParallelFor, Nests) {
  std::atomic<int> calls = 0;
  const Execution execution{.threads = GetParam()};
  parallel_for(execution, 6,
               [&](std::int64_t) { parallel_for(execution, 5, [&](std::int64_t) { ++calls; }); });
  EXPECT_EQ(calls, 30);
}

TEST_P(ParallelFor, RethrowsTheBodysException) {
  const auto failing = [](std::int64_t i) {
    if (i == 5) throw Error({.code = ErrorCode::io, .what = "x", .where = "", .limit = "", .remedy = ""});
  };
  EXPECT_THROW(parallel_for({.threads = GetParam()}, 10, failing), Error);
}

TEST_P(ParallelFor, ProgressIsMonotoneAndEndsAtOne) {
  std::vector<double> reports;
  const Execution execution{.threads = GetParam(), .progress = [&](double done) { reports.push_back(done); }};
  ProgressMeter meter(execution, 5000);
  parallel_for(execution, 5000, [&](std::int64_t) { meter.advance(1); });
  meter.finish();
  ASSERT_FALSE(reports.empty());
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_EQ(std::adjacent_find(reports.begin(), reports.end()), reports.end())
      << "a share was reported twice";
  EXPECT_EQ(reports.back(), 1.0);
  EXPECT_LE(reports.size(), 202u);
}

TEST(Execution, RefusesImpossibleThreadCounts) {
  EXPECT_THROW(thread_count({.threads = -1}), Error);
  EXPECT_THROW(thread_count({.threads = 1025}), Error);
  EXPECT_EQ(thread_count({.threads = 1024}), 1024);
  EXPECT_GE(thread_count({.threads = 0}), 1);
}

TEST(Execution, MemoryLimitIsInclusive) {
  const Execution execution{.memory_limit_bytes = 1000};
  EXPECT_NO_THROW(check_memory(execution, 1000, "x"));
  try {
    check_memory(execution, 1001, "mask 3x3");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::over_limit);
    EXPECT_EQ(error.info().where, "mask 3x3");
  }
}

TEST(Execution, StopEndsWithCancelled) {
  std::stop_source source;
  const Execution execution{.stop = source.get_token()};
  EXPECT_NO_THROW(throw_if_stopped(execution));
  source.request_stop();
  try {
    throw_if_stopped(execution);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace bn
