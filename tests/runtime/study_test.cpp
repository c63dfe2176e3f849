// Protects: the measures against known answers; textures read back from files, and refused where step,
// size, mask or pixels do not fit; the study end to end, whole files only.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "bn/error.h"
#include "bn/texture.h"
#include "runtime/error_spectrum.h"
#include "runtime/study.h"
#include "runtime/test_textures.h"

namespace bn {
namespace {

/// Of this process alone; removed at its end.
struct Scratch {
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "bn-runtime-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path;
};

std::filesystem::path fresh_folder(const std::string& name) {
  static const Scratch scratch;
  const auto folder = scratch.path / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

Grid<float> white_noise(Extent size) {
  Grid<float> noise(size);
  for (std::size_t i = 0; i < noise.count(); ++i) noise[i] = sample(static_cast<std::uint32_t>(i), 7) - 0.5f;
  return noise;
}

TEST(Measures, WhiteNoiseReadsOneAndItsVariance) {
  const Grid<float> noise = white_noise({256, 256});
  EXPECT_NEAR(low_frequency_power(noise, 0.1), 1.0, 0.1);  // 2058 frequencies: sigma 0.03
  EXPECT_NEAR(low_frequency_error(noise, 0.1), 1.0 / 12.0, 0.1 / 12.0);
  EXPECT_NEAR(blurred_rms(noise, 0.0), std::sqrt(1.0 / 12.0), 0.003);
  // A Gaussian blur leaves 1 / (4 pi sigma^2) of the power of white noise.
  EXPECT_NEAR(blurred_rms(noise, 2.0), std::sqrt(1.0 / 12.0 / (16.0 * 3.14159265)), 0.003);
}

TEST(Measures, AWaveAboveTheBandIsNotSeen) {
  Grid<float> wave({96, 80});
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 96; ++x) wave(x, y) = static_cast<float>(std::sin(2.0 * 3.14159265358979 * 0.25 * x));
  }
  EXPECT_LT(low_frequency_error(wave, 0.1), 1e-6);
  EXPECT_GT(low_frequency_error(wave, 0.3), 1e-3);
}

class BakedFolder : public testing::Test {
 protected:
  /// What the tile says of itself; an empty hash is none.
  void record(const std::string& form, const std::string& source_hash) {
    tile_.facts = {};
    tile_.facts.add("step", test::kStep);
    tile_.facts.add("form", form);
    if (!source_hash.empty()) tile_.facts.add("source_hash", source_hash);
  }

  BakedFolder() {
    mask_.kind = "mask";
    write_image(folder_ / "mask.png", encode_levels(), mask_);
    const Image moves = encode_moves(test::proven_textures().moves[0]);
    tile_.kind = "retarget-tile";
    record("scatter", pixel_hash(encode_levels()));
    tile_.tiles = {{}};
    write_image(folder_ / "retarget.png", moves, tile_);
  }

  static Image encode_levels() {
    Image image{.size = {64, 64}, .channels = 1, .type = SampleType::u8, .samples = {}};
    for (const std::int32_t level : test::mask_64()) image.samples.push_back(static_cast<std::byte>(level));
    return image;
  }

  std::string refusal(std::optional<Offset> step = {}) {
    try {
      read_temporal_textures(folder_, step);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_ = fresh_folder("baked");
  Metadata mask_, tile_;
};

TEST_F(BakedFolder, ReadsBackWhatWasBaked) {
  const TemporalTextures read = read_temporal_textures(folder_);
  EXPECT_EQ(read.mask, test::proven_textures().mask);
  EXPECT_EQ(read.moves, test::proven_textures().moves);
  EXPECT_EQ(read.step, test::kStep);
}

TEST_F(BakedFolder, RefusesAnotherStepUnlessUnsafe) {
  EXPECT_NE(refusal(Offset{48, 36}).find("(49, 37)"), std::string::npos) << refusal(Offset{48, 36});
  EXPECT_EQ(refusal(test::kStep), "");
  EXPECT_EQ(read_temporal_textures(folder_, Offset{48, 36}, true).step, (Offset{48, 36}));
}

TEST_F(BakedFolder, AWrongStepCostsWhatTheStudySays) {
  TemporalTextures wrong = test::proven_textures();
  wrong.step = {48, 36};
  const double right_db = run_flat_model({}, test::proven_textures()).back();
  const double wrong_db = run_flat_model({}, wrong).back();
  EXPECT_GT(wrong_db, right_db + 5.0) << wrong_db << " dB against " << right_db << " dB";
}

TEST_F(BakedFolder, RefusesAnotherMaskAndOtherSizes) {
  record("scatter", "xxh3-128:0");
  write_image(folder_ / "retarget.png", encode_moves(test::proven_textures().moves[0]), tile_);
  EXPECT_NE(refusal().find("another mask"), std::string::npos) << refusal();
  record("scatter", "");
  write_image(folder_ / "retarget.png", encode_moves(Grid<Offset>({32, 64})), tile_);
  EXPECT_NE(refusal().find("32x64"), std::string::npos) << refusal();
  std::filesystem::remove(folder_ / "retarget.png");
  EXPECT_NE(refusal(), "");
}

TEST(Measures, BandsOfWhiteNoiseReadItsVariance) {
  const ErrorSpectrum spectrum(white_noise({256, 256}));
  double low = 0.0;
  for (const double high : kBandEdges) {
    EXPECT_NEAR(spectrum.band(low, high), 1.0 / 12.0, 0.15 / 12.0) << low << ".." << high;
    low = high;
  }
  const RadialCurve radial = spectrum.radial();
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < radial.power.size(); ++i) {
    if (std::isnan(radial.power[i])) continue;
    sum += radial.power[i] * static_cast<double>(radial.count[i]);
    count += static_cast<double>(radial.count[i]);
  }
  EXPECT_NEAR(sum / count, 1.0 / 12.0, 0.05 / 12.0);
}

TEST(Measures, WhatMovesWithThePictureIsNoChange) {
  const Extent screen{40, 30};
  const Grid<float> last = white_noise(screen);
  Grid<float> error(screen, 5.0f);
  Grid<PixelMotion> motion(screen, {3 * 256 + 100, -2 * 256 - 100});  // nearly 3.4 right, 2.4 up
  for (int y = 0; y < 28; ++y) {
    for (int x = 3; x < 40; ++x) error(x, y) = last(x - 3, y + 2);
  }
  motion(20, 20) = {kNoMotion, kNoMotion};
  error(20, 20) = 7.0f;
  double known = 0.0;
  const Grid<float> change = change_along_motion(error, last, motion, known);
  for (const float value : change) EXPECT_EQ(value, 0.0f);
  EXPECT_NEAR(known, (37.0 * 28.0 - 1.0) / (40.0 * 30.0), 1e-12);
  error(20, 10) += 0.25f;
  EXPECT_NEAR(change_along_motion(error, last, motion, known)(20, 10), 0.25f, 1e-6f);
}

TEST(Measures, RegionsFollowThePan) {
  Scene scene = load_scene("slow-pan");
  const Extent screen{200, 100};
  const Region region{"r", 0.2, 0.2, 0.2, 0.2};
  EXPECT_EQ(region_at(scene, region, screen, 0)->left, 40);
  EXPECT_EQ(region_at(scene, region, screen, 16)->left, 20);
  EXPECT_EQ(region_at(scene, region, screen, 16)->width, 40);
  EXPECT_EQ(region_at(scene, region, screen, 48)->width, 20);
  EXPECT_FALSE(region_at(scene, region, screen, 56));
  EXPECT_EQ(region_at(scene, {.name = "picture"}, screen, 56)->width, 200);
}

StudyOptions small_study(const std::string& scene) {
  StudyOptions options;
  options.scenes = {scene};
  options.methods = {Method::white, Method::retarget};
  options.variations = false;
  options.screen = {48, 32};
  options.frames = 3;
  options.reference_samples = 4;
  return options;
}

TEST(Study, ReferencesAreKeptAndDamagedOnesMadeAgain) {
  const auto folder = fresh_folder("references");
  const auto run = [&] {
    run_study(small_study("slow-pan"), test::proven_textures(), nullptr, folder, {.threads = 1});
    std::ifstream file(folder / "errors.csv");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string once = run();
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "references"))
    files.push_back(entry.path());
  ASSERT_EQ(files.size(), 4u) << "a view a frame";
  const auto written = std::filesystem::last_write_time(files[0]);
  std::filesystem::resize_file(files[1], 100);
  EXPECT_EQ(run(), once);
  EXPECT_EQ(std::filesystem::last_write_time(files[0]), written);
  EXPECT_GT(std::filesystem::file_size(files[1]), 100u);
  // All frames, all regions, though the camera moves.
  EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 1 + 2 * 4 * 3);
}

TEST(Slices, AreReadInNameOrderAndOneSize) {
  const auto folder = fresh_folder("slices");
  const auto write = [&](const std::string& name, Extent size, int level) {
    Image image{.size = size, .channels = 1, .type = SampleType::u8, .samples = {}};
    image.samples.resize(static_cast<std::size_t>(size.area()), static_cast<std::byte>(level));
    write_image(folder / name, image, {});
  };
  EXPECT_THROW(read_slices(folder), Error) << "none";
  EXPECT_THROW(read_slices(folder / "nowhere"), Error);
  write("slice_10.png", {4, 4}, 3);
  write("slice_9.png", {4, 4}, 2);
  write("slice_009b.png", {4, 4}, 1);
  const auto slices = read_slices(folder);
  ASSERT_EQ(slices.size(), 3u);
  EXPECT_EQ(slices[0][0], 2);
  EXPECT_EQ(slices[1][0], 1);
  EXPECT_EQ(slices[2][0], 3);
  write("slice_11.png", {4, 8}, 3);
  EXPECT_THROW(read_slices(folder), Error) << "another size";
}

TEST(Study, WritesItsFilesWholeAndTheSameEachTime) {
  const auto run = [](const std::string& folder_name) {
    const auto folder = fresh_folder(folder_name);
    StudyOptions options = small_study("poster");
    options.variations = true;
    run_study(options, test::proven_textures(), nullptr, folder, {.threads = 1});
    std::ifstream file(folder / "errors.csv");
    for (const char* name : {"first-frames.png", "methods.png", "blocks.png", "retarget.png"})
      EXPECT_TRUE(std::filesystem::exists(folder / "poster" / name)) << name;
    EXPECT_TRUE(std::filesystem::exists(folder / "report.md"));
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string once = run("study_1");
  EXPECT_EQ(run("study_2"), once);
  // A header, and two methods, three more block sizes and two by light, four frames, three regions.
  EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 1 + 7 * 4 * 3);
}

TEST(Study, RefusesBeforeItWrites) {
  const auto folder = fresh_folder("refused") / "never";
  StudyOptions options;
  options.scenes = {"no-such-scene"};
  EXPECT_THROW(run_study(options, test::proven_textures(), nullptr, folder), Error);
  EXPECT_FALSE(std::filesystem::exists(folder));
}

}  // namespace
}  // namespace bn
