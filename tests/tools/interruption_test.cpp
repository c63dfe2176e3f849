// Protects: however a bake is stopped (Ctrl-C, SIGTERM, kill -9), nothing is left half-written, finished
// results are kept, and the next run ends with the bytes of an uninterrupted one; two bakes cannot share a
// folder.
#include <gtest/gtest.h>
#include <signal.h>

#include "process.h"

namespace bn::tools {
namespace {

// The 289 tiles take a second or two on one thread, so that a signal finds them at work.
constexpr char kRecipe[] = R"(version = 1
[[mask]]
name = "m"
size = [64, 64]
outputs = [{ path = "m.png" }]
[[retarget]]
name = "long"
mask = "m"
motion = 8
outputs = [{ path = "atlas.png" }]
)";
constexpr char kLongStarted[] = R"("kind":"retarget","name":"long")";

class Interruption : public testing::Test {
 protected:
  Interruption() { write_bytes(scratch_ / "r.toml", kRecipe); }

  std::vector<std::string> bake(const std::string& out) {
    return {"bake", "r.toml", "--out", (scratch_ / out).string(), "--progress", "json", "--threads", "1"};
  }
  ProcessSetup here() const { return {.folder = scratch_.path()}; }

  /// The next run goes on and completes, with the same bytes.
  void expect_resumed(const std::string& out) {
    const auto result = run_bn(bake(out), here());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find(R"("name":"m","skipped":true)"), std::string::npos) << result.err;
    EXPECT_EQ(names_in(scratch_ / out), names_in(uninterrupted_ / "out"));
    for (const char* file : {"m.png", "atlas.png", "contact_sheet.png"}) {
      EXPECT_EQ(read_bytes(scratch_ / out / file), read_bytes(uninterrupted_ / "out" / file)) << file;
    }
  }

  static void SetUpTestSuite() {
    write_bytes(uninterrupted_ / "r.toml", kRecipe);
    ASSERT_EQ(run_bn({"bake", "r.toml"}, {.folder = uninterrupted_.path()}).exit_code, 0);
  }

  static inline ScratchFolder uninterrupted_;
  ScratchFolder scratch_;
};

TEST_F(Interruption, StopsCleanlyAndGoesOn) {
  Process process(bake("out"), here());
  ASSERT_TRUE(process.wait_for_message(kLongStarted));
  process.send(SIGINT);
  const auto result = process.wait();
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find(R"({"event":"error","exit_code":130)"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("goes on where it stopped"), std::string::npos) << result.err;
  EXPECT_EQ(names_in(scratch_ / "out"), (std::vector<std::string>{"m.png", "manifest.json"}));
  expect_resumed("out");
}

TEST_F(Interruption, TerminationIsAStopToo) {
  Process process(bake("out"), here());
  ASSERT_TRUE(process.wait_for_message(kLongStarted));
  process.send(SIGTERM);
  EXPECT_EQ(process.wait().exit_code, 143);
}

TEST_F(Interruption, SurvivesKill) {
  Process process(bake("out"), here());
  ASSERT_TRUE(process.wait_for_message(kLongStarted));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().signal, SIGKILL);
  expect_resumed("out");
}

TEST_F(Interruption, TwoBakesCannotShareAFolder) {
  Process first(bake("out"), here());
  ASSERT_TRUE(first.wait_for_message(kLongStarted));
  first.send(SIGSTOP);  // it keeps the folder however slow the second is
  auto arguments = bake("out");
  arguments.push_back("--quiet");
  const auto second = run_bn(arguments, here());
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_TRUE(second.err.starts_with("bn: ")) << second.err;
  EXPECT_NE(second.err.find("out"), std::string::npos) << second.err;
  first.send(SIGINT);
  first.send(SIGCONT);
  EXPECT_EQ(first.wait().exit_code, 130);
}

}  // namespace
}  // namespace bn::tools
