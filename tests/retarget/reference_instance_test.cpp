// Protects: the proven optima of the reference instance, a published mask (CC0, Christoph Peters,
// tests/data).
#include <gtest/gtest.h>

#include "bn/retarget.h"
#include "bn/texture.h"

namespace bn {
namespace {

class ReferenceInstance : public testing::Test {
 protected:
  void SetUp() override {
    levels_ = levels_of_channel(read_image(BN_TEST_DATA "/peters_cc0_64_LDR_RGBA_0.png").image, 0).value;
  }

  void expect_optimum(const RetargetOptions& options, std::int64_t optimum) {
    const RetargetTile tile = solve_retarget(levels_, options, {.threads = 1});
    EXPECT_EQ(tile.start_energy, 348180);
    EXPECT_EQ(tile.energy, optimum);
    EXPECT_EQ(tile.lower_bound, optimum);
    EXPECT_NO_THROW(check_permutation(tile.move, options));
  }

  Grid<std::int32_t> levels_;
};

TEST_F(ReferenceInstance, Optimum) { expect_optimum({.step = {48, 36}}, 3638); }

TEST_F(ReferenceInstance, EuclideanReach) {
  expect_optimum({.step = {48, 36}, .reach = Reach::euclidean}, 5058);
}

TEST_F(ReferenceInstance, WithoutWrap) { expect_optimum({.step = {48, 36}, .wrap = false}, 4286); }

TEST_F(ReferenceInstance, RadiusTable) {
  const std::pair<int, std::int64_t> table[] = {{1, 58618}, {2, 19888}, {3, 10324}, {4, 6610},
                                                {5, 4830},  {6, 3638},  {8, 2198},  {10, 1392}};
  for (const auto& [radius, optimum] : table) expect_optimum({.step = {48, 36}, .radius = radius}, optimum);
}

TEST_F(ReferenceInstance, MotionVariants) {
  const auto tiles = solve_motion_set(levels_, {.step = {48, 36}}, 4);
  ASSERT_EQ(tiles.size(), 81u);
  std::int64_t least = tiles[0].energy, most = tiles[0].energy;
  for (const RetargetTile& tile : tiles) {
    EXPECT_TRUE(tile.optimal());
    least = std::min(least, tile.energy);
    most = std::max(most, tile.energy);
  }
  EXPECT_EQ(least, 3562);
  EXPECT_EQ(most, 3696);
  EXPECT_EQ(tiles[40].energy, 3638);
}

}  // namespace
}  // namespace bn
