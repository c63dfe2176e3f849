// Protects: the first signal asks for a stop, the second ends the process at once, whatever it is doing.
#include "tools/signals.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>

namespace bn::tools {
namespace {

using namespace std::chrono_literals;

bool wait_until(const std::function<bool()>& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(Signals, TheFirstAsksForAStop) {
  std::atomic<int> calls = 0;
  StopOnSignal signals([&] { ++calls; });
  EXPECT_EQ(signals.signal(), 0);
  EXPECT_FALSE(signals.token().stop_requested());
  ::kill(::getpid(), SIGTERM);
  EXPECT_TRUE(wait_until([&] { return calls == 1; }));
  EXPECT_TRUE(signals.token().stop_requested());
  EXPECT_EQ(signals.signal(), SIGTERM);
}

TEST(Signals, WithoutAnyItEndsQuietly) {
  StopOnSignal signals([] { FAIL(); });
}

TEST(SignalsDeathTest, TheSecondEndsAtOnceEvenWhileTheNoteHangs) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto stuck = [] {
    StopOnSignal signals([] { std::this_thread::sleep_for(60s); });
    ::kill(::getpid(), SIGINT);
    wait_until([&] { return signals.token().stop_requested(); });
    ::kill(::getpid(), SIGINT);
    std::this_thread::sleep_for(60s);
  };
  EXPECT_EXIT(stuck(), testing::ExitedWithCode(130), "");
}

}  // namespace
}  // namespace bn::tools
