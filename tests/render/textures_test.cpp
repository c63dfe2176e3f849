// Protects: the textures of a bake and stacks of slices are read back as they were written, and what does not
// fit together is refused.
#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn/texture.h"
#include "bn_study/models.h"
#include "render/scratch.h"
#include "render/test_textures.h"

namespace bn {
namespace {

using test::fresh_folder;

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
  EXPECT_EQ(read.masks, test::proven_textures().masks);
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
  // The mean of eight runs, as in docs/validation.md: a single one scatters by half a decibel.
  double right_db = 0.0, wrong_db = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    right_db += run_flat_model({.seed = seed}, test::proven_textures()).power_db.back() / 8.0;
    wrong_db += run_flat_model({.seed = seed}, wrong).power_db.back() / 8.0;
  }
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

TEST(Slices, AreReadInNameOrderAndOneSize) {
  const auto folder = fresh_folder("slices");
  const auto write = [&](const std::string& name, Extent size, int level) {
    Image image{.size = size, .channels = 1, .type = SampleType::u8, .samples = {}};
    image.samples.resize(static_cast<std::size_t>(size.area()), static_cast<std::byte>(level));
    write_image(folder / name, image, {});
  };
  EXPECT_THROW(read_stack_textures(folder), Error) << "none";
  EXPECT_THROW(read_stack_textures(folder / "nowhere"), Error);
  write("slice_10.png", {4, 4}, 3);
  write("slice_9.png", {4, 4}, 2);
  write("slice_009b.png", {4, 4}, 1);
  const auto slices = read_stack_textures(folder).masks;
  ASSERT_EQ(slices.size(), 3u);
  EXPECT_EQ(slices[0][0], 2);
  EXPECT_EQ(slices[1][0], 1);
  EXPECT_EQ(slices[2][0], 3);
  write("slice_11.png", {4, 8}, 3);
  EXPECT_THROW(read_stack_textures(folder), Error) << "another size";
}

}  // namespace
}  // namespace bn
