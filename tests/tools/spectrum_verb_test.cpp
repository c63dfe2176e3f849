// Protects: bn spectrum reads what it is given, prints one vocabulary as table and JSON, and exits 5 with the
// name of the figure that failed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bn/noise.h"
#include "bn/volume.h"
#include "named_exr.h"
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
  write("other.png", void_and_cluster({.size = {64, 64}, .seed = 2}));
  const ProcessResult failed = run({"good.png", "other.png", "bayer.png", "--check", "blue"});
  EXPECT_NE(failed.out.find("the average leaves out 1 that fails"), std::string::npos) << failed.out;
  EXPECT_EQ(failed.exit_code, 5);
  EXPECT_NE(failed.err.find("bayer.png: is one tile repeated"), std::string::npos) << failed.err;
  EXPECT_NE(failed.out.find("FAIL  bayer.png\n"), std::string::npos) << failed.out;
  EXPECT_NE(failed.out.find("      anisotropy, mean, dB: "), std::string::npos) << failed.out;
  EXPECT_EQ(failed.out.find("inf"), std::string::npos) << failed.out;
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
  EXPECT_EQ(result.at("size"), nlohmann::json::parse("[32, 32]"));
  EXPECT_EQ(result.at("verdict"), "good");
  EXPECT_GT(result.at("grade").at("score"), 95.0);
  EXPECT_TRUE(result.at("failures").empty());
}

TEST_F(SpectrumVerb, FitsEightyColumnsVerdictFirst) {
  std::vector<std::string> arguments;
  for (int i = 0; i < 3; ++i) {
    arguments.push_back(std::string(60, 'n') + std::to_string(i) + ".png");
    write(arguments.back(), void_and_cluster({.size = {64, 64}, .seed = static_cast<std::uint64_t>(i)}));
  }
  write("bayer.png", bayer_mask(32));
  arguments.insert(arguments.end(), {"bayer.png", "--check", "blue"});
  for (const auto& list : {arguments, std::vector<std::string>{"bayer.png", "--check", "blue"}}) {
    std::istringstream lines(run(list).out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
  const std::string text = run(arguments).out;
  EXPECT_NE(text.find("\nFAIL "), std::string::npos) << text;
  EXPECT_EQ(text.find("bands["), std::string::npos);
}

TEST_F(SpectrumVerb, OneBadFileSilencesNoOther) {
  write("good.png", void_and_cluster({.size = {64, 64}}));
  write("bayer.png", bayer_mask(64));
  std::ofstream(scratch_ / "bad.png") << "no picture";
  const ProcessResult outcome = run({"absent.png", "bad.png", "good.png", "--check", "blue"});
  EXPECT_EQ(outcome.exit_code, 3);  // the highest of absent (2) and unreadable (3)
  EXPECT_NE(outcome.out.find("good.png"), std::string::npos);
  EXPECT_NE(outcome.out.find("ERROR absent.png"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("ERROR bad.png"), std::string::npos);
  EXPECT_EQ(run({"absent.png", "bayer.png", "--check", "blue"}).exit_code, 5);
  const ProcessResult json = run({"absent.png", "good.png", "--json"});
  EXPECT_EQ(json.exit_code, 2);
  const auto result = nlohmann::json::parse(json.out);
  EXPECT_EQ(result.at("textures").size(), 1u);
  EXPECT_EQ(result.at("errors").at(0).at("file"), "absent.png");
  EXPECT_EQ(result.at("errors").at(0).at("exit_code"), 2);
}

TEST_F(SpectrumVerb, TakesFoldersWithoutHiddenFiles) {
  std::filesystem::create_directories(scratch_ / "set/deeper");
  write("set/b10.png", void_and_cluster({.size = {32, 32}, .seed = 1}));
  write("set/b2.png", void_and_cluster({.size = {32, 32}, .seed = 2}));
  write("set/deeper/c.png", void_and_cluster({.size = {32, 32}, .seed = 3}));
  std::ofstream(scratch_ / "set/._b2.png") << "no picture";
  std::ofstream(scratch_ / "set/notes.txt") << "no picture";
  const ProcessResult outcome = run({"set", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto textures = nlohmann::json::parse(outcome.out).at("textures");
  ASSERT_EQ(textures.size(), 4u);  // and the average
  EXPECT_EQ(textures.at(0).at("file"), "set/b2.png");
  EXPECT_EQ(textures.at(1).at("file"), "set/b10.png");
  std::filesystem::create_directories(scratch_ / "empty");
  EXPECT_EQ(run({"empty"}).exit_code, 3);
}

TEST_F(SpectrumVerb, JudgesEveryChannelAndComparesThem) {
  const auto packed = [&](const std::string& name, const std::vector<Grid<std::uint32_t>>& channels) {
    Image image{.size = {64, 64},
                .channels = static_cast<int>(channels.size()),
                .type = SampleType::u8,
                .samples = {}};
    for (std::size_t i = 0; i < 4096; ++i) {
      for (const auto& rank : channels) image.samples.push_back(static_cast<std::byte>(rank[i] / 16));
    }
    write_image(scratch_ / name, image, {});
  };
  std::vector<Grid<std::uint32_t>> four;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    four.push_back(void_and_cluster({.size = {64, 64}, .seed = seed}));
  packed("good.png", four);
  const ProcessResult good = run({"good.png", "--check", "blue"});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_NE(good.out.find("good.png:3"), std::string::npos);
  EXPECT_NE(good.out.find("the channels are independent"), std::string::npos) << good.out;

  auto shifted = four;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) shifted[2](wrap(x + 7, 64), wrap(y - 2, 64)) = four[0](x, y);
  }
  packed("shifted.png", shifted);
  const ProcessResult moved = run({"shifted.png", "--check", "blue"});
  EXPECT_EQ(moved.exit_code, 5);
  EXPECT_NE(moved.err.find("shifted.png: channel 2 is channel 0 moved by (7, -2)"), std::string::npos)
      << moved.err;
  const auto textures =
      nlohmann::json::parse(run({"shifted.png", "--json", "--check", "blue"}).out).at("textures");
  EXPECT_EQ(textures.at(1).at("passed"), true);
  EXPECT_EQ(textures.at(2).at("passed"), false);
  EXPECT_EQ(textures.at(2).at("reasons").back(), "is channel 0 moved by (7, -2)");
  const auto pairs = nlohmann::json::parse(run({"shifted.png", "--json"}).out).at("channel_pairs");
  ASSERT_EQ(pairs.size(), 6u);
  EXPECT_EQ(pairs.at(0).at("independent"), true);
  for (const auto& pair : pairs) {
    if (pair.at("channels") != nlohmann::json::parse("[0, 2]")) continue;
    EXPECT_EQ(pair.at("peak_offset"), nlohmann::json::parse("[7, -2, 0]"));
    EXPECT_EQ(pair.at("independent"), false);
  }

  // Grey stored as colour is one texture; an opaque alpha is none.
  const Grid<std::uint32_t> opaque(Extent{64, 64}, 4095);
  packed("grey.png", {four[0], four[0], four[0], opaque});
  const ProcessResult grey = run({"grey.png", "--check", "blue"});
  EXPECT_EQ(grey.exit_code, 0) << grey.err;
  EXPECT_NE(grey.out.find("grey stored as colour"), std::string::npos) << grey.out;
  EXPECT_NE(grey.out.find("opaque alpha"), std::string::npos) << grey.out;

  const Grid<std::uint32_t> unused(Extent{64, 64}, 0);
  packed("unused.png", {four[0], four[1], unused});
  const ProcessResult two = run({"unused.png", "--check", "blue"});
  EXPECT_EQ(two.exit_code, 0) << two.err;
  EXPECT_NE(two.out.find("not judged: it is constant, every value is 0"), std::string::npos) << two.out;

  auto bad = four;
  bad[1] = bayer_mask(64);
  packed("bad.png", bad);
  EXPECT_EQ(run({"bad.png", "--check", "blue"}).exit_code, 5);
  EXPECT_EQ(run({"bad.png", "--check", "blue", "--channel", "0"}).exit_code, 0);
  const ProcessResult unknown = run({"bad.png", "--channel", "none"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_NE(unknown.err.find("it has no channel none (allowed: 0..3)"), std::string::npos) << unknown.err;
}

TEST_F(SpectrumVerb, WhatSpoiltAllChannelsIsSaidFirst) {
  std::vector<Grid<std::uint32_t>> four;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    four.push_back(void_and_cluster({.size = {64, 64}, .seed = seed}));
  Image image = encode_masks(four, SampleType::u8);
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    const int alpha = std::to_integer<int>(image.samples[i / 4 * 4 + 3]);
    if (i % 4 < 3)
      image.samples[i] = static_cast<std::byte>(std::to_integer<int>(image.samples[i]) * alpha / 255);
  }
  write_image(scratch_ / "premultiplied.png", image, {});
  const ProcessResult outcome = run({"premultiplied.png", "--check", "blue"});
  EXPECT_EQ(outcome.exit_code, 5);
  const std::string cause = "premultiplied.png\n      the colours are multiplied by alpha; ";
  EXPECT_LT(outcome.out.find("FAIL  " + cause), outcome.out.find("premultiplied.png, channel 0"))
      << outcome.out;
  EXPECT_TRUE(outcome.err.starts_with("bn: check: premultiplied.png: the colours are multiplied by alpha"))
      << outcome.err;
}

TEST_F(SpectrumVerb, CountsOneTextureOnceInWhateverEncoding) {
  const auto mask = void_and_cluster({.size = {64, 64}});
  write("m.png", mask);
  write("m.exr", mask, SampleType::f32);
  write("m.bin", mask, SampleType::u16);
  const ProcessResult outcome = run({"m.png", "m.exr", "m.bin", "--check", "blue"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("average"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("m.exr is the same texture as m.png"), std::string::npos) << outcome.out;
  write("other.png", void_and_cluster({.size = {64, 64}, .seed = 9}));
  const auto json = nlohmann::json::parse(run({"m.png", "m.exr", "other.png", "--json"}).out);
  EXPECT_EQ(json.at("textures").back().at("file"), "average");
  EXPECT_EQ(json.at("textures").back().at("textures"), 2);
}

TEST_F(SpectrumVerb, PutsSlicesInOrderAndNamesWhatIsMissing) {
  const Shape shape{32, 32, 16};
  const auto volume = test::spatiotemporal_mask(shape, 1.9, 1.9, 1);
  std::vector<std::string> arguments;
  for (const int z : {0, 1, 10, 11, 12, 13, 14, 15, 2, 3, 4, 5, 6, 7, 8, 9}) {
    Image image{.size = {32, 32}, .channels = 1, .type = SampleType::u8, .samples = {}};
    for (std::size_t i = 0; i < 1024; ++i) {
      const double rank = volume[static_cast<std::size_t>(z) * 1024 + i];
      image.samples.push_back(static_cast<std::byte>(static_cast<int>(rank) / 64));
    }
    arguments.push_back("s_" + std::to_string(z) + ".png");
    write_image(scratch_ / arguments.back(), image, {});
  }
  arguments.insert(arguments.end(), {"--volume", "--check", "stbn"});
  const ProcessResult outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("put into numeric order"), std::string::npos) << outcome.out;
  std::erase(arguments, "s_7.png");
  EXPECT_NE(run(arguments).out.find("number 7 is missing between 0 and 15"), std::string::npos);
}

TEST_F(SpectrumVerb, FilesOfSeveralSlicesAndPatternsAreVolumes) {
  const Image first = encode_mask(void_and_cluster({.size = {32, 32}}), SampleType::u8),
              second = encode_mask(void_and_cluster({.size = {32, 32}, .seed = 2}), SampleType::u8);
  const Image volume = stack_slices(std::vector{first, second});
  for (const char* path : {"v.ktx2", "v.bin", "s_%d.png"}) {
    write_volume(scratch_ / path, volume, {});
    const ProcessResult outcome = run({path, "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out).at("textures").at(0).at("depth"), 2) << path;
  }
}

TEST_F(SpectrumVerb, SlicesOfAStackJudgedOneByOneAreNoted) {
  ASSERT_EQ(
      run_bn({"noise", "spatiotemporal", "--size", "8x8x3", "-o", "t_%d.png"}, {.folder = scratch_.path()})
          .exit_code,
      0);
  EXPECT_NE(run({"t_0.png", "t_1.png", "t_2.png"}).out.find("3 files say that they are slices; --volume"),
            std::string::npos);
  const std::string whole = run({"t_%d.png"}).out;
  EXPECT_EQ(whole.find("--volume"), std::string::npos) << whole;
}

TEST_F(SpectrumVerb, AChannelIsChosenByTheNameThatTheFileGivesIt) {
  write_named_exr(scratch_ / "passes.exr", void_and_cluster({.size = {32, 32}}));
  const ProcessResult mask = run({"passes.exr", "--channel", "Z", "--check", "blue"});
  EXPECT_EQ(mask.exit_code, 0) << mask.err;
  EXPECT_NE(mask.out.find("passes.exr, channel Z\n"), std::string::npos) << mask.out;
  EXPECT_EQ(run({"passes.exr", "--channel", "id", "--check", "blue"}).exit_code, 5);
  const auto all = nlohmann::json::parse(run({"passes.exr", "--json"}).out).at("textures");
  std::string names;
  for (std::size_t i = 0; i < 3; ++i) names += all.at(i).at("channel_name").get<std::string>() + " ";
  EXPECT_EQ(names, "R Z id ");
  const ProcessResult unknown = run({"passes.exr", "--channel", "z"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_NE(unknown.err.find("passes.exr: it has no channel z (allowed: R, Z, id, or 0..2)"),
            std::string::npos)
      << unknown.err;
}

TEST_F(SpectrumVerb, SaysWhatItCannotJudge) {
  write("tiny.png", bayer_mask(2));
  const ProcessResult outcome = run({"tiny.png", "--check", "blue"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("too small to judge"), std::string::npos) << outcome.out;
  EXPECT_EQ(run({"tiny.png"}).exit_code, 0);
}

TEST_F(SpectrumVerb, JudgesTheDistributionAskedFor) {
  Image image{.size = {64, 64}, .channels = 1, .type = SampleType::u8, .samples = {}};
  for (const std::uint32_t rank : void_and_cluster({.size = {64, 64}})) {
    const double v = (rank + 0.5) / 4096;
    const double place = v < 0.5 ? std::sqrt(v / 2) : 1 - std::sqrt((1 - v) / 2);
    image.samples.push_back(static_cast<std::byte>(static_cast<int>(256 * place)));
  }
  write_image(scratch_ / "tpdf.png", image, {});
  const ProcessResult plain = run({"tpdf.png", "--check", "blue"});
  EXPECT_EQ(plain.exit_code, 5);
  EXPECT_NE(plain.err.find("triangular distribution"), std::string::npos) << plain.err;
  const ProcessResult asked = run({"tpdf.png", "--check", "blue", "--distribution", "triangular"});
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_EQ(run({"tpdf.png", "--distribution", "round"}).exit_code, 1);
}

TEST_F(SpectrumVerb, IsQuietWhenAsked) {
  write("mask.png", void_and_cluster({.size = {32, 32}}));
  EXPECT_EQ(run({"mask.png", "-q"}).out, "");
  EXPECT_NE(run({"mask.png", "-q", "--json"}).out, "");
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
    // The numbers of the names decide, whatever the order on the command line; so the names must lie.
    disordered.push_back("wrong" + std::to_string(z * 5 % 16) + ".png");
    write_image(scratch_ / disordered.back(), image, {});
  }
  for (auto* list : {&arguments, &disordered}) list->insert(list->end(), {"--volume", "--check", "stbn"});
  const ProcessResult good = run(arguments);
  EXPECT_EQ(good.exit_code, 0) << good.err;
  const ProcessResult bad = run(disordered);
  EXPECT_EQ(bad.exit_code, 5);
  EXPECT_NE(bad.err.find("power in time, 0 < f <= 0.125: "), std::string::npos) << bad.err;
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
  const ProcessResult picture = run({"mask.png", "--check", "stbn"});
  EXPECT_EQ(picture.exit_code, 3);
  EXPECT_NE(picture.err.find("add --volume, or use --check blue"), std::string::npos) << picture.err;
  // What cannot be written is found before anything is read.
  for (const auto& [option, path] : {std::pair{"--png", "no/out.png"}, {"--csv", "no/out.csv"}}) {
    const ProcessResult outcome = run({"absent.png", option, path});
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
