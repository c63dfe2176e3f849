// Protects: bn report from the command line: the page and its curves, one line or JSON about it, exit codes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bn/noise.h"
#include "bn/texture.h"
#include "process.h"

namespace bn::tools {
namespace {

class ReportVerb : public testing::Test {
 protected:
  void SetUp() override {
    write("blue.png", void_and_cluster({.size = {32, 32}}));
    write("bayer.png", bayer_mask(32));
  }
  void write(const std::string& name, const Grid<std::uint32_t>& rank) const {
    write_image(scratch_ / name, encode_mask(rank, SampleType::u8), {});
  }
  ProcessResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "report");
    return run_bn(arguments, {.folder = scratch_.path()});
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(scratch_ / name); }

  ScratchFolder scratch_;
};

TEST_F(ReportVerb, WritesThePageAndItsCurves) {
  const ProcessResult outcome =
      run({"blue.png", "bayer.png", "-o", "r.html", "--compare", "--csv", "curves"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "r.html: 2 textures, 0 retarget sets, 0 volumes; 1 of 2 fail\n");
  const std::string page = read_bytes(scratch_ / "r.html");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_NE(page.find("Side by side"), std::string::npos);
  for (const char* curve :
       {"blue-png-power", "bayer-png-anisotropy", "blue-png-histogram", "compare-power"}) {
    EXPECT_TRUE(exists(std::string("curves/") + curve + ".csv")) << curve;
  }
}

TEST_F(ReportVerb, SaysTheSameInJson) {
  const ProcessResult outcome = run({".", "-o", "r.html", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto result = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(result.at("report"), "r.html");
  EXPECT_EQ(result.at("textures"), 2);
  EXPECT_EQ(result.at("failed"), 1);
  EXPECT_EQ(result.at("not_judged"), 0);
  EXPECT_TRUE(result.at("notes").is_array());
}

TEST_F(ReportVerb, RefusesBeforeItWrites) {
  EXPECT_EQ(run({"blue.png"}).exit_code, 1);  // no -o
  EXPECT_EQ(run({"-o", "r.html"}).exit_code, 1);
  EXPECT_EQ(run({"none.png", "-o", "r.html", "--csv", "curves"}).exit_code, 2);
  EXPECT_EQ(run({"blue.png", "-o", "no/r.html", "--csv", "curves"}).exit_code, 2);
  EXPECT_EQ(run({"blue.png", "-o", "r.html", "--csv", "blue.png"}).exit_code, 2);
  EXPECT_FALSE(exists("r.html"));
  EXPECT_FALSE(exists("curves"));
}

TEST_F(ReportVerb, NamesWhatItCannotReadAndGoesOn) {
  write_bytes(scratch_ / "broken.png", "no picture");
  const ProcessResult outcome = run({"blue.png", "broken.png", "-o", "r.html"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("broken.png"), std::string::npos) << outcome.err;
  EXPECT_NE(read_bytes(scratch_ / "r.html").find("broken.png"), std::string::npos);
}

}  // namespace
}  // namespace bn::tools
