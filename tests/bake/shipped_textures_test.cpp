// Protects: the shipped textures are what their recipes make, byte for byte. If this fails after a change of
// an algorithm, raise its version and run scripts/ship-textures.
#include "fixtures.h"

namespace bn {
namespace {

const fs::path kTextures = fs::path(BN_SOURCE_DIR) / "textures";

class ShippedTextures : public testing::TestWithParam<int> {};

TEST_P(ShippedTextures, AreWhatTheirRecipeMakes) {
  const std::string size = std::to_string(GetParam());
  const TemporaryFolder out;
  const BakeResult result = bake(read_recipe(kTextures / ("retarget" + size + ".toml")), {.out_dir = out});
  int compared = 0;
  for (const JobRecord& job : result.jobs) {
    for (const FileRecord& file : job.files) {
      EXPECT_TRUE(bytes_of(out / file.path) == bytes_of(kTextures / file.path)) << file.path;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 3);
  const JobRecord& set = result.jobs.back();
  EXPECT_EQ(set.tiles.size(), 81u);
  for (const TileRecord& tile : set.tiles)
    EXPECT_EQ(tile.energy, tile.lower_bound) << "every tile is proven optimal";
}

INSTANTIATE_TEST_SUITE_P(Sizes, ShippedTextures, testing::Values(64, 128));

TEST(ShippedTextures, SpatiotemporalMasksAreWhatTheirRecipeMakes) {
  const TemporaryFolder out;
  bake(read_recipe(kTextures / "spatiotemporal.toml"), {.out_dir = out});
  int compared = 0;
  for (const auto& file : fs::recursive_directory_iterator(out / "64x32")) {
    if (!file.is_regular_file()) continue;
    const fs::path name = fs::relative(file.path(), out / ".");
    EXPECT_TRUE(bytes_of(file.path()) == bytes_of(kTextures / name)) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 2 * (1 + 32));
}

TEST(ShippedTextures, TheDefaultRecipeIsSound) { EXPECT_NO_THROW(read_recipe(kTextures / "default.toml")); }

}  // namespace
}  // namespace bn
