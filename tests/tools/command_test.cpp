// Protects: the command as a user meets it: what goes to stdout and what to stderr, exit codes, closed and
// full streams, a reader that leaves early.
#include <gtest/gtest.h>

#include "bn/version.h"
#include "process.h"

namespace bn::tools {
namespace {

TEST(Command, ResultsGoToStdoutAndErrorsToStderr) {
  const auto version = run_bn({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out, "bn " + std::string(kVersion) + "\n");
  EXPECT_EQ(version.err, "");
  const auto mistake = run_bn({"bkae"});
  EXPECT_EQ(mistake.exit_code, 1);
  EXPECT_EQ(mistake.out, "");
  EXPECT_EQ(mistake.err, "bn: there is no verb 'bkae'; did you mean bn bake?\n");
}

TEST(Command, WithoutAVerbOrMethodItPrintsWhatThereIs) {
  const auto nothing = run_bn({});
  EXPECT_EQ(nothing.exit_code, 1) << "a script should notice that nothing was done";
  EXPECT_EQ(nothing.out, run_bn({"--help"}).out);
  EXPECT_EQ(nothing.err, "");
  const auto group = run_bn({"noise"});
  EXPECT_EQ(group.exit_code, 1);
  EXPECT_EQ(group.out, run_bn({"noise", "--help"}).out);
}

TEST(Command, HelpExplainsAVerb) {
  EXPECT_EQ(run_bn({"help", "verify"}).out, run_bn({"verify", "--help"}).out);
  EXPECT_EQ(run_bn({"help", "noise"}).out, run_bn({"noise", "--help"}).out);
  EXPECT_EQ(run_bn({"help", "noise", "void-and-cluster"}).out,
            run_bn({"noise", "void-and-cluster", "--help"}).out);
  const auto misspelt = run_bn({"help", "retraget"});
  EXPECT_EQ(misspelt.exit_code, 1);
  EXPECT_EQ(misspelt.err, "bn: help: there is no verb 'retraget'; did you mean bn help retarget?\n");
}

TEST(Command, WordsOfOtherProgramsFindOurs) {
  EXPECT_EQ(run_bn({"-V"}).out, run_bn({"--version"}).out);
  EXPECT_EQ(run_bn({"version"}).err, "bn: there is no verb 'version'; did you mean bn --version?\n");
  EXPECT_EQ(run_bn({"void-and-cluster", "--size", "8x8"}).err,
            "bn: there is no verb 'void-and-cluster'; did you mean bn noise void-and-cluster?\n");
  EXPECT_NE(run_bn({"noise", "--size", "8x8"}).err.find("bn: noise: the method is missing"),
            std::string::npos);
  EXPECT_NE(run_bn({"noise", "stbn", "--size", "8x8"}).err.find("bn: noise: there is no method 'stbn'"),
            std::string::npos);
  EXPECT_NE(run_bn({"noise", "void-and-cluster", "--size", "8x8", "--output", "a.png"})
                .err.find("did you mean --out?"),
            std::string::npos);
}

// Fewer threads than asked for, or a message: never an abort, whichever allocation or thread fails.
TEST(Command, LittleAddressSpaceEndsInAResultOrAMessage) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve terabytes";
#endif
  const ScratchFolder scratch;
  int made = 0, refused = 0;
  for (int limit = 12'000; limit <= 120'000; limit += 6'000) {
    const auto result =
        run_bn({"noise", "void-and-cluster", "--size", "1024x1024", "--threads", "4", "-o", "m.png"},
               {.folder = scratch.path(), .shell_prefix = "ulimit -v " + std::to_string(limit)});
    if (result.err.find("cannot allocate") != std::string::npos || result.exit_code == 127)
      continue;  // the loader's
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 4)
        << limit << ": " << result.exit_code << result.err;
    (result.exit_code == 0 ? made : refused) += 1;
  }
  EXPECT_GT(made, 0);
  EXPECT_GT(refused, 0) << "the limits above are meant to reach below what the work needs";
}

TEST(Command, AFullOrClosedStdoutIsAnError) {
  const auto full = run_bn({"--help"}, {.stdout_to = "/dev/full"});
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_NE(full.err.find("bn: standard output: cannot write: No space left on device"), std::string::npos)
      << full.err;
  const auto closed = run_bn({"--help"}, {.stdout_closed = true});
  EXPECT_EQ(closed.exit_code, 2);
  EXPECT_NE(closed.err.find("bn: standard output: cannot write"), std::string::npos) << closed.err;
}

TEST(Command, AReaderThatLeavesEarlyIsNoError) {
  Process process({"help", "--all"});
  process.close_output();
  const auto result = process.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace bn::tools
