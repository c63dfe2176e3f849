// Protects: bn spectrum reads what it is given, prints one vocabulary as table and JSON, and exits 5 with the
// name of the figure that failed.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "bn/noise.h"
#include "bn/texture.h"
#include "process.h"
#include "spectrum/reference_stbn.h"

namespace bn::tools {
namespace {

class SpectrumVerb : public testing::Test {
 protected:
  void write(const std::string& name, const Grid<std::uint32_t>& rank,
             SampleType type = SampleType::u8) const {
    write_image(scratch_ / name, encode_mask(rank, type), {});
  }

  ProcessResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "spectrum");
    return run_bn(arguments, {.folder = scratch_.path()});
  }

  ScratchFolder scratch_;
};

TEST_F(SpectrumVerb, PassesABlueMaskAndFailsABayerMatrix) {
  write("good.png", void_and_cluster({.size = {64, 64}}));
  write("bayer.png", bayer_mask(64));
  write("white.exr", white_noise_mask({64, 64}, 1), SampleType::f32);
  EXPECT_EQ(run({"good.png", "--check", "blue"}).exit_code, 0);
  EXPECT_EQ(run({"white.exr", "--check", "white"}).exit_code, 0);
  const ProcessResult failed = run({"good.png", "bayer.png", "--check", "blue"});
  EXPECT_EQ(failed.exit_code, 5);
  EXPECT_NE(failed.err.find("bayer.png: anisotropy_db_mean"), std::string::npos) << failed.err;
  EXPECT_NE(failed.out.find("average"), std::string::npos);
}

TEST_F(SpectrumVerb, PrintsJsonWithTheStatedNames) {
  write("mask.png", void_and_cluster({.size = {32, 32}}), SampleType::u16);
  const ProcessResult outcome = run({"mask.png", "--json", "--check", "blue"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto result = nlohmann::json::parse(outcome.out).at("textures").at(0);
  EXPECT_EQ(result.at("bands").size(), 5u);
  for (const char* name :
       {"peak", "peak_frequency", "anisotropy_db_mean", "anisotropy_db_max", "histogram_max_deviation"}) {
    EXPECT_TRUE(result.at(name).is_number()) << name;
  }
  EXPECT_EQ(result.at("gauss_residual_db").size(), 3u);
  EXPECT_EQ(result.at("passed"), true);
}

TEST_F(SpectrumVerb, TakesSlicesAsOneVolume) {
  std::vector<std::string> arguments;
  for (const auto& slice : golden_ratio_slices(void_and_cluster({.size = {32, 32}}), 8)) {
    arguments.push_back("slice" + std::to_string(arguments.size()) + ".png");
    write(arguments.back(), slice);
  }
  arguments.insert(arguments.end(), {"--volume", "--json"});
  const ProcessResult outcome = run(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto result = nlohmann::json::parse(outcome.out).at("textures");
  ASSERT_EQ(result.size(), 1u);
  EXPECT_EQ(result.at(0).at("depth"), 8);
  EXPECT_LT(result.at(0).at("temporal_power_at_0"), 0.5);  // 1 where slices are independent
}

TEST_F(SpectrumVerb, ChecksASpatiotemporalVolume) {
  const Shape shape{32, 32, 16};
  const auto volume = test::spatiotemporal_mask(shape, 1.9, 1.9, 1);
  std::vector<std::string> arguments, disordered;
  for (std::size_t z = 0; z < 16; ++z) {
    Image image{.size = {32, 32}, .channels = 1, .type = SampleType::u8, .samples = {}};
    for (std::size_t i = 0; i < 1024; ++i) {
      image.samples.push_back(static_cast<std::byte>(static_cast<int>(volume[z * 1024 + i]) / 64));
    }
    arguments.push_back("slice" + std::to_string(z) + ".png");
    write_image(scratch_ / arguments.back(), image, {});
    disordered.push_back("slice" + std::to_string(z * 5 % 16) + ".png");
  }
  for (auto* list : {&arguments, &disordered}) list->insert(list->end(), {"--volume", "--check", "stbn"});
  const ProcessResult good = run(arguments);
  EXPECT_EQ(good.exit_code, 0) << good.err;
  const ProcessResult bad = run(disordered);
  EXPECT_EQ(bad.exit_code, 5);
  EXPECT_NE(bad.err.find("temporal_power_low"), std::string::npos) << bad.err;
}

TEST_F(SpectrumVerb, WritesPictureAndCurves) {
  write("mask.png", void_and_cluster({.size = {48, 32}}));
  ASSERT_EQ(run({"mask.png", "--png", "s.png", "--csv", "s.csv"}).exit_code, 0);
  EXPECT_EQ(read_image(scratch_ / "s.png").image.size, (Extent{48, 32}));
  std::ifstream csv(scratch_ / "s.csv");
  std::string header;
  std::getline(csv, header);
  EXPECT_EQ(header, "axis,frequency,power,anisotropy_db,count");
}

TEST_F(SpectrumVerb, RefusesWhatItCannotRead) {
  write("mask.png", void_and_cluster({.size = {16, 16}}));
  write("narrow.png", white_noise_mask({8, 16}, 1));
  EXPECT_EQ(run({"absent.png"}).exit_code, 2);
  EXPECT_EQ(run({}).exit_code, 1);
  EXPECT_EQ(run({"mask.png", "--channel", "3"}).exit_code, 3);
  EXPECT_EQ(run({"mask.png", "narrow.png", "--volume"}).exit_code, 3);
  // What cannot be written is found before anything is read.
  for (const char* option : {"--png", "--csv"}) {
    const ProcessResult outcome = run({"absent.png", option, "no/out.png"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err.find("absent"), std::string::npos) << outcome.err;
  }

  Image image;
  image.size = {4, 4};
  image.channels = 1;
  image.type = SampleType::f32;
  std::array<float, 16> values{};
  values[6] = std::numeric_limits<float>::quiet_NaN();
  image.samples.resize(sizeof values);
  std::memcpy(image.samples.data(), values.data(), sizeof values);
  write_image(scratch_ / "nan.exr", image, {});
  const ProcessResult outcome = run({"nan.exr"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("x 2, y 1"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace bn::tools
