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
  const auto nothing = run_bn({});
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_EQ(nothing.err, "bn: no verb is named; see bn --help\n");
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
