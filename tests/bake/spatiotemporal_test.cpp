// Protects: a spatiotemporal mask is made, kept and verified as a kind of texture, in every layout of files;
// each slice has every level equally often; its options are read and written as declared; a retarget set
// stands on its slices.
#include <gtest/gtest.h>

#include <array>

#include "bn/error.h"
#include "bn/volume.h"
#include "fixtures.h"

namespace bn {
namespace {

const std::string kRecipe =
    "version = 1\ncontact_sheet = ''\n"
    "[[spatiotemporal]]\nname = 'frames'\nsize = [16, 16, 6]\nspatial = 'box:3'\ntemporal = 'ema'\n"
    "outputs = ['s_%d.png', 'frames.ktx2', { path = 'fine.bin', type = '16bit' }]\n";

std::string mistake(const std::string& text) {
  try {
    parse_recipe(text, "r", "");
    return "accepted";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Spatiotemporal, IsReadAsWritten) {
  const Recipe recipe = parse_recipe(kRecipe, "r", "");
  const auto& entry = dynamic_cast<const SpatiotemporalEntry&>(*recipe.entries.at(0));
  EXPECT_EQ(entry.mask.size, (Shape{16, 16, 6}));
  EXPECT_EQ(entry.mask.spatial, SpatialFilter::box);
  EXPECT_EQ(entry.mask.spatial_width, 3.0);
  EXPECT_EQ(entry.mask.temporal, TemporalFilter::ema);
  EXPECT_EQ(entry.mask.temporal_width, 0.1) << "a word without its number means the usual one";
  const std::string written = recipe_text(recipe);
  EXPECT_NE(written.find("spatial = \"box:3\""), std::string::npos) << written;
  EXPECT_EQ(recipe_text(parse_recipe(written, "again", "")), written);
}

TEST(Spatiotemporal, MistakesAreNamedWithTheRange) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kRecipe;
    return mistake(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_NE(with("'box:3'", "'bax:3'").find("r:6: spatiotemporal 'frames': spatial is 'bax:3'"),
            std::string::npos);
  for (const char* wrong :
       {"'box:0'", "'box:2.5'", "'box:65'", "'gauss:0.2'", "'gauss:x'", "'gauss:'", "'none:1'", "''"})
    EXPECT_NE(with("'box:3'", wrong).find("spatial is "), std::string::npos) << wrong;
  EXPECT_NE(with("[16, 16, 6]", "[16, 16, 0]").find("size is [16, 16, 0]"), std::string::npos);
  EXPECT_NE(with("temporal = 'ema'", "slice_share = 1.5").find("slice_share is 1.5"), std::string::npos);
  EXPECT_EQ(with("[16, 16, 6]", "[16, 16]"), "accepted");
}

TEST(Spatiotemporal, IsBakedKeptAndVerifiedInEveryLayout) {
  const TemporaryFolder out;
  const Recipe recipe = parse_recipe(kRecipe, "r", "");
  EXPECT_FALSE(bake(recipe, {.out_dir = out}).jobs.at(0).skipped);
  EXPECT_TRUE(bake(recipe, {.out_dir = out}).jobs.at(0).skipped);
  const Image slices = read_volume(out / "s_%d.png").image;
  EXPECT_EQ(slices.depth, 6);
  EXPECT_EQ(read_volume(out / "frames.ktx2").image.samples, slices.samples);
  EXPECT_EQ(failures(verify_path(out)), "");
  for (int t = 0; t < 6; ++t) {
    std::array<int, 256> count{};
    for (const std::int32_t level : levels_of_channel(slice_of(slices, t), 0).value)
      ++count[static_cast<std::size_t>(level)];
    for (const int times : count) ASSERT_EQ(times, 1) << "slice " << t << " has every level once";
  }
  // One slice that changes is found, and made again.
  FileContent slice = read_image(out / "s_4.png");
  std::swap(slice.image.samples[0], slice.image.samples[1]);
  write_image(out / "s_4.png", slice.image, *slice.metadata);
  EXPECT_NE(failures(verify_path(out / "s_4.png")).find("pixels: "), std::string::npos);
  EXPECT_FALSE(bake(recipe, {.out_dir = out}).jobs.at(0).skipped);
  EXPECT_EQ(failures(verify_path(out)), "");
}

TEST(Spatiotemporal, RanksOfTheVolumeAndDepthOne) {
  SpatiotemporalEntry entry;
  entry.name = "m";
  entry.mask.size = {16, 16, 4};
  entry.mask.ranks = RankScope::volume;
  entry.outputs = {{.path = "v.bin", .type = SampleType::u16}};
  const Image volume = bake_entry(entry).files.at(0).image;
  std::vector<int> count(65536, 0);
  for (const std::int32_t level : levels_of_channel(volume, 0).value)
    ++count[static_cast<std::size_t>(level)];
  EXPECT_EQ(*std::max_element(count.begin(), count.end()), 1) << "1024 voxels, each of another level";
  entry.mask.size = {16, 16, 1};
  entry.outputs = {{.path = "m.png"}};
  const BakedEntry one = bake_entry(entry);
  EXPECT_EQ(one.files.at(0).image.depth, 1);
  EXPECT_TRUE(levels_of_channel(one.files[0].image, 0).is_permutation);
}

TEST(Spatiotemporal, SlicesForOnePictureAreRefusedBeforeTheWork) {
  const TemporaryFolder out;
  std::string text = kRecipe;
  text.replace(text.find("'s_%d.png'"), 10, "'plain.png'");
  EXPECT_THROW(bake(parse_recipe(text, "r", ""), {.out_dir = out}), Error);
  EXPECT_TRUE(fs::is_empty(out));
}

TEST(Spatiotemporal, ARetargetSetStandsOnItsSlices) {
  const TemporaryFolder out;
  const std::string text = kRecipe +
                           "[[retarget]]\nname = 'carry'\nmask = 'frames'\nradius = 3\n"
                           "outputs = ['carry_%d.png']\n";
  const Recipe recipe = parse_recipe(text, "r", "");
  const BakeResult result = bake(recipe, {.out_dir = out});
  EXPECT_EQ(result.jobs.at(1).tiles.size(), 6u);
  for (const TileRecord& tile : result.jobs[1].tiles) EXPECT_EQ(tile.energy, tile.lower_bound);
  for (const JobRecord& job : bake(recipe, {.out_dir = out}).jobs) EXPECT_TRUE(job.skipped) << job.name;
  EXPECT_EQ(failures(verify_path(out)), "");
}

}  // namespace
}  // namespace bn
