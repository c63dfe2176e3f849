// Protects: a retarget tile of unknown making is measured as it is: bijection, reach, energy, distance from
// the proven optimum, in any encoding and form; inputs that do not fit together are named.
#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn/noise.h"
#include "fixtures.h"

namespace bn {
namespace {

constexpr Offset kStep{5, 3};

class VerifyTile : public testing::Test {
 protected:
  VerifyTile() {
    write_image(folder_ / "mask.png", encode_mask(void_and_cluster({.size = {16, 16}}), SampleType::u8), {});
    levels_ = levels_of_channel(read_image(folder_ / "mask.png").image, 0).value;
    tile_ = solve_retarget(levels_, {.step = kStep, .radius = 3});
    write("tile.png", tile_.move, 128);
  }

  /// As another program might: three channels, `zero` added.
  void write(const std::string& name, const Grid<Offset>& move, int zero) {
    Image image{.size = move.size(), .channels = 3, .type = SampleType::u8, .samples = {}};
    for (const Offset& r : move) {
      for (const int value : {r.x + zero, r.y + zero, 0})
        image.samples.push_back(static_cast<std::byte>(value));
    }
    write_image(folder_ / name, image, {});
  }

  ForeignTile tile(const std::string& name = "tile.png") const {
    return {.tile = folder_ / name, .mask = folder_ / "mask.png", .step = kStep};
  }

  static std::string text(const std::vector<VerifyItem>& items) {
    std::string all;
    for (const VerifyItem& item : items)
      all += (item.pass ? "pass " : "FAIL ") + item.check + ": " + item.detail + "\n";
    return all;
  }

  TemporaryFolder folder_;
  Grid<std::int32_t> levels_;
  RetargetTile tile_;
};

TEST_F(VerifyTile, MeasuresTheOptimumAsSuch) {
  const std::string said = text(verify_tile(tile()));
  EXPECT_EQ(said.find("FAIL"), std::string::npos) << said;
  EXPECT_NE(said.find("energy: " + std::to_string(tile_.energy) + ", "), std::string::npos) << said;
  EXPECT_NE(said.find("is " + std::to_string(tile_.energy) + "; the tile is 0.00 % above it"),
            std::string::npos)
      << said;
}

TEST_F(VerifyTile, AnyEncodingAndForm) {
  write("plus6.png", tile_.move, 6);
  write("gather.png", invert_moves(tile_.move), 128);
  const std::string plain = text(verify_tile(tile()));
  ForeignTile plus6 = tile("plus6.png"), gather = tile("gather.png");
  plus6.zero_level = 6;
  gather.form = MoveForm::gather;
  EXPECT_EQ(text(verify_tile(plus6)), plain);
  EXPECT_EQ(text(verify_tile(gather)), plain);
  plus6.zero_level = 128;
  EXPECT_NE(text(verify_tile(plus6)).find("stored as plus6?"), std::string::npos) << text(verify_tile(plus6));
}

TEST_F(VerifyTile, WhatIsWrongIsNamed) {
  Grid<Offset> twice = tile_.move;
  twice(1, 0) = {twice(0, 0).x - 1, twice(0, 0).y};
  write("twice.png", twice, 128);
  EXPECT_NE(text(verify_tile(tile("twice.png"))).find("FAIL bijection: "), std::string::npos);
  ForeignTile narrow = tile();
  narrow.radius = 2;
  EXPECT_NE(text(verify_tile(narrow)).find("FAIL radius: the farthest move is 3 pixels"), std::string::npos);
  ForeignTile other_step = tile();
  other_step.step = {0, 0};
  EXPECT_NE(text(verify_tile(other_step)).find("is the step another, or the form?"), std::string::npos);
}

TEST_F(VerifyTile, BetweenTwoMasks) {
  const auto second = encode_mask(void_and_cluster({.size = {16, 16}, .seed = 2}), SampleType::u8);
  write_image(folder_ / "second.png", second, {});
  const auto to = levels_of_channel(second, 0).value;
  const RetargetTile best = solve_retarget({levels_, to}, {.radius = 4});
  write("pair.png", best.move, 128);
  ForeignTile pair = tile("pair.png");
  pair.to = folder_ / "second.png";
  pair.step = {};
  EXPECT_NE(text(verify_tile(pair)).find("energy: " + std::to_string(best.energy) + ", "), std::string::npos);
}

TEST_F(VerifyTile, InputsThatDoNotFitAreRefused) {
  write_image(folder_ / "large.png", encode_mask(void_and_cluster({.size = {32, 16}}), SampleType::u8), {});
  ForeignTile wrong = tile();
  wrong.mask = folder_ / "large.png";
  EXPECT_THROW(verify_tile(wrong), Error);
  EXPECT_THROW(verify_tile(tile("mask.png")), Error) << "one channel holds no moves";
  wrong = tile();
  wrong.channel = 1;
  EXPECT_THROW(verify_tile(wrong), Error);
  wrong = tile();
  wrong.motion = {120, 0};
  EXPECT_THROW(verify_tile(wrong), Error);
}

}  // namespace
}  // namespace bn
