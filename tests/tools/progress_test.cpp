// Protects: what a person and a program see of progress: nothing for short work, errors always, JSON lines
// that parse, a bar that fits the line and leaves it clean, durations that read well.
#include "tools/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bn/error.h"

namespace bn::tools {
namespace {

/// A clock that goes when it is told to.
ProgressDisplay::Clock::time_point now{};
ProgressDisplay::Clock::time_point clock() { return now; }

template <class Act>
std::string shown(ProgressStyle style, Act act) {
  testing::internal::CaptureStderr();
  {
    ProgressDisplay display(clock);
    display.set_style(style);
    act(display);
  }
  return testing::internal::GetCapturedStderr();
}

const Error kMistake(
    {.code = ErrorCode::invalid_input, .what = "too large", .where = "a\nb", .limit = "", .remedy = ""});

TEST(Progress, ShortWorkIsSilentForPeople) {
  const auto work = [](ProgressDisplay& display) {
    display.start("task");
    for (double share : {0.1, 0.5, 1.0}) display.update(share);
    display.finish();
  };
  EXPECT_EQ(shown(ProgressStyle::plain, work), "");
  EXPECT_EQ(shown(ProgressStyle::bar, work), "");
  EXPECT_EQ(shown(ProgressStyle::none, work), "");
  EXPECT_EQ(shown(ProgressStyle::automatic, work), "") << "stderr is no terminal here";
  // A program hears at once that work has begun.
  EXPECT_NE(shown(ProgressStyle::json, work).find(R"("done":0.1)"), std::string::npos);
}

TEST(Progress, NotesAreForPeopleWhoWantThem) {
  const auto say = [](ProgressDisplay& display) { display.note("the source is constant"); };
  EXPECT_EQ(shown(ProgressStyle::plain, say), "bn: the source is constant\n");
  EXPECT_EQ(shown(ProgressStyle::bar, say), "bn: the source is constant\n");
  EXPECT_EQ(shown(ProgressStyle::none, say), "");
}

TEST(Progress, ErrorsAreAlwaysShown) {
  const auto fail = [](ProgressDisplay& display) { display.error(kMistake, 3); };
  EXPECT_EQ(shown(ProgressStyle::none, fail), "bn: a\nbn: b: too large\n");
  EXPECT_EQ(shown(ProgressStyle::plain, fail), "bn: a\nbn: b: too large\n");
}

TEST(Progress, JsonLinesParse) {
  const std::string text = shown(ProgressStyle::json, [](ProgressDisplay& display) {
    display.start("bake");
    display.note("a \"note\" \xff");
    display.event({{"event", "file_written"}, {"path", "a.png"}});
    display.finish();
    display.error(kMistake, 3);
  });
  std::istringstream lines(text);
  std::vector<std::string> events;
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    events.push_back(json.at("event"));
    if (events.back() == "progress") {
      EXPECT_EQ(json.at("done"), 1.0);
      EXPECT_EQ(json.at("task"), "bake");
    }
    if (events.back() == "error") {
      EXPECT_EQ(json.at("exit_code"), 3);
    }
  }
  EXPECT_EQ(events, (std::vector<std::string>{"note", "file_written", "progress", "error"}));
}

TEST(Progress, TheBarFitsItsLineAndIsWiped) {
  const std::string text = shown(ProgressStyle::bar, [](ProgressDisplay& display) {
    display.start(std::string(200, 'x'));
    display.update(0.4, 70.0);
    now += std::chrono::milliseconds(201);
    display.update(0.5, 65.0);
    display.finish();
  });
  ASSERT_TRUE(text.starts_with("\r\x1b[K"));
  ASSERT_TRUE(text.ends_with("\r\x1b[K"));
  const std::string bar = text.substr(4, text.size() - 8);
  EXPECT_LT(bar.size(), 80u);
  EXPECT_NE(bar.find("#-"), std::string::npos) << bar;
  EXPECT_NE(bar.find("50 %"), std::string::npos) << bar;
  EXPECT_NE(bar.find("1 min 5 s left"), std::string::npos) << bar;
}

TEST(Progress, DurationsReadWell) {
  EXPECT_EQ(readable_duration(-1), "0 s");
  EXPECT_EQ(readable_duration(0.2), "1 s");
  EXPECT_EQ(readable_duration(59), "59 s");
  EXPECT_EQ(readable_duration(125), "2 min 5 s");
  EXPECT_EQ(readable_duration(3 * 3600 + 600), "3 h 10 min");
  EXPECT_EQ(readable_duration(1e300), "277777 h 46 min");
}

}  // namespace
}  // namespace bn::tools
