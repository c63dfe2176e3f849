// Protects: `bn study convergence` and `bn study presets` as their user meets them: what they print and
// write, stacks of other tools as rows, and what is refused before the work.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bn/noise.h"
#include "bn/texture.h"
#include "process.h"

namespace bn::tools {
namespace {

using Json = nlohmann::json;

class StudyVerbs : public testing::Test {
 protected:
  ProcessResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "study");
    return run_bn(arguments, {.folder = scratch_.path()});
  }
  /// A strip of `count` square masks, as other tools write stacks.
  void write_strip(const std::string& name, int count) const {
    std::vector<Image> slices;
    for (int i = 1; i <= count; ++i)
      slices.push_back(encode_mask(
          void_and_cluster({.size = {16, 16}, .seed = static_cast<std::uint64_t>(i)}), SampleType::u8));
    write_image(scratch_ / name, make_atlas(slices, 1), {});
  }
  bool stands(const std::string& name) const { return std::filesystem::exists(scratch_ / name); }

  ScratchFolder scratch_;
};

TEST_F(StudyVerbs, ConvergenceMeasuresEverySourceAndEveryStack) {
  write_strip("strip.png", 4);
  const ProcessResult result = run({"convergence", "strip.png", "--size", "16x16", "--slices", "4",
                                    "--frames", "4", "--reset", "2", "-o", "out", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json rows = Json::parse(result.out);
  ASSERT_EQ(rows.size(), 10u);
  EXPECT_EQ(rows.back().at("source"), "strip");
  for (const Json& row : rows) {
    EXPECT_EQ(row.at("errors").size(), 7u);
    EXPECT_EQ(row.at("errors").at(0).at("integrand"), "heavisides");
    EXPECT_EQ(row.at("errors").at(0).at("filtered").size(), 4u);
  }
  for (const char* file : {"out/convergence.csv", "out/denoised.csv", "out/tables.md"})
    EXPECT_TRUE(stands(file));
  // The tables on the terminal are those of the file.
  const ProcessResult again =
      run({"convergence", "--size", "16x16", "--slices", "4", "--frames", "4", "--reset", "2"});
  EXPECT_NE(again.out.find("| golden-ratio mask |"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("| random steps | filtered 1 | mean 4 |"), std::string::npos) << again.out;
}

TEST_F(StudyVerbs, ConvergenceMeasuresStacksAlone) {
  write_strip("strip.png", 3);
  const ProcessResult result = run({"convergence", "strip.png", "--files-only", "--frames", "6", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out).size(), 1u);
}

TEST_F(StudyVerbs, ConvergenceRefusesBeforeTheWork) {
  EXPECT_EQ(run({"convergence", "--files-only"}).exit_code, 1);
  const ProcessResult missing = run({"convergence", "no_such.png", "-o", "out"});
  EXPECT_EQ(missing.exit_code, 2) << missing.err;
  EXPECT_NE(missing.err.find("no_such.png"), std::string::npos) << missing.err;
  EXPECT_EQ(run({"convergence", "--frames", "1"}).exit_code, 1);
  EXPECT_EQ(run({"convergence", "--alpha", "0"}).exit_code, 1);
  EXPECT_FALSE(stands("out"));
}

TEST_F(StudyVerbs, SearchComparesByTime) {
  const ProcessResult result =
      run({"search", "--size", "16x16", "--slices", "4", "--tries", "16,1", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json rows = Json::parse(result.out);
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows.at(0).at("method"), "stbn");
  EXPECT_EQ(rows.at(3).at("method").get<std::string>().find("swaps from white noise, 1 tries"), 0u);
  EXPECT_EQ(rows.at(4).at("method").get<std::string>().find("swaps from white noise, 16 tries"), 0u);
}

TEST_F(StudyVerbs, PresetsPrintsTheEndsOfTheCurve) {
  const ProcessResult result = run({"presets", "--size", "16x16", "--frames", "4", "-o", "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* row : {"| `stbn` |", "| `filtered` |", "| `both` |", "| the best series |"})
    EXPECT_NE(result.out.find(row), std::string::npos) << result.out;
  EXPECT_TRUE(stands("out/presets.csv"));
  const ProcessResult json = run({"presets", "--size", "16x16", "--frames", "4", "--json"});
  int best = 0;
  for (const Json& row : Json::parse(json.out)) best += row.at("best") == true ? 1 : 0;
  EXPECT_GT(best, 0);
}

}  // namespace
}  // namespace bn::tools
