// Protects: retarget tiles between any two masks, of stacks (a proven tile a slice, the last to the first)
// and of volumes (annealed, seeds move between slices), from recipes and by themselves, in every layout of
// files; what is up to date and what is verified; inputs that do not fit.
#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn/noise.h"
#include "bn/volume.h"
#include "fixtures.h"

namespace bn {
namespace {

Grid<std::int32_t> levels_of(const fs::path& file) {
  return levels_of_channel(read_image(file).image, 0).value;
}

class RetargetStack : public testing::Test {
 protected:
  static constexpr int kSlices = 5;

  RetargetStack() {
    for (int t = 0; t < kSlices; ++t) {
      const auto mask = void_and_cluster({.size = {16, 12}, .seed = static_cast<std::uint64_t>(t + 1)});
      write_image(folder_ / ("s" + std::to_string(t) + ".png"), encode_mask(mask, SampleType::u8), {});
      slices_.push_back(encode_mask(mask, SampleType::u8));
    }
    write_volume(folder_ / "stack.ktx2", stack_slices(slices_), {});
  }

  RetargetEntry entry(const std::string& image, const std::string& output) const {
    RetargetEntry made;
    made.name = "r";
    made.image = (folder_ / image).string();
    made.problem.radius = 3;
    made.add_output();
    made.output_path(0) = (folder_ / output).string();
    made.default_output(0);
    return made;
  }

  TemporaryFolder folder_;
  std::vector<Image> slices_;
};

TEST_F(RetargetStack, ATileASliceEachProvenTheLastToTheFirst) {
  const JobRecord job = make_entry(entry("s%d.png", "t%d.png"));
  ASSERT_EQ(job.tiles.size(), std::size_t{kSlices});
  for (int t = 0; t < kSlices; ++t) {
    const auto from = levels_of(folder_ / ("s" + std::to_string(t) + ".png"));
    const auto to = levels_of(folder_ / ("s" + std::to_string((t + 1) % kSlices) + ".png"));
    const RetargetTile best = solve_retarget({from, to}, {.radius = 3});
    EXPECT_EQ(job.tiles[static_cast<std::size_t>(t)].energy, best.energy);
    EXPECT_EQ(job.tiles[static_cast<std::size_t>(t)].lower_bound, best.energy);
    EXPECT_EQ(decode_moves(read_image(folder_ / ("t" + std::to_string(t) + ".png")).image), best.move);
  }
  EXPECT_EQ(failures(verify_path(folder_ / "t2.png")), "");
}

TEST_F(RetargetStack, EveryLayoutHoldsTheSameTiles) {
  make_entry(entry("s%d.png", "t%d.png"));
  const Image parts = read_volume(folder_ / "t%d.png").image;
  for (const char* name : {"t.bin", "t.h"}) {
    make_entry(entry("stack.ktx2", name));
    EXPECT_EQ(read_volume(folder_ / name).image.samples, parts.samples) << name;
    EXPECT_EQ(failures(verify_path(folder_ / name)), "") << name;
  }
}

// Few devices sample textures of three channels.
TEST_F(RetargetStack, FilesForDevicesHaveTwoChannelsOrFour) {
  for (const std::string extension : {".dds", ".ktx2"}) {
    for (const SampleType type : {SampleType::u8, SampleType::f32}) {
      RetargetEntry stack = entry("stack.ktx2", "t" + extension);
      stack.outputs[0].type = type;
      make_entry(stack);
      EXPECT_EQ(read_volume(folder_ / ("t" + extension)).image.channels, 2) << extension;
      EXPECT_EQ(failures(verify_path(folder_ / ("t" + extension))), "");
    }
    RetargetEntry volume = entry("stack.ktx2", "v" + extension);
    volume.anneals = volume.volume = true;
    volume.anneal.options.proposals = 10'000;
    make_entry(volume);
    EXPECT_EQ(read_volume(folder_ / ("v" + extension)).image.channels, 4) << extension;
    EXPECT_EQ(failures(verify_path(folder_ / ("v" + extension))), "");
  }
}

TEST_F(RetargetStack, OneThreadOrMany) {
  RetargetEntry stack = entry("stack.ktx2", "t.bin");
  stack.motion = 1;
  stack.default_output(0);
  const Image one = bake_entry(stack, {.threads = 1}).files[0].image;
  EXPECT_EQ(one.depth, kSlices);
  EXPECT_EQ(one.size, (Extent{48, 36})) << "an atlas of nine motions in every slice";
  EXPECT_EQ(bake_entry(stack, {.threads = 3}).files[0].image.samples, one.samples);
  make_entry(stack);
  EXPECT_EQ(failures(verify_path(folder_ / "t.bin")), "");
}

TEST_F(RetargetStack, BetweenTwoMasks) {
  RetargetEntry pair = entry("s0.png", "pair.png");
  pair.to = (folder_ / "s1.png").string();
  pair.outputs[0].form = MoveForm::gather;
  const JobRecord job = make_entry(pair);
  const auto from = levels_of(folder_ / "s0.png"), to = levels_of(folder_ / "s1.png");
  EXPECT_EQ(job.tiles.at(0).energy, solve_retarget({from, to}, {.radius = 3}).energy);
  EXPECT_EQ(failures(verify_path(folder_ / "pair.png")), "");
  // Verification reads the second mask too.
  fs::copy(folder_ / "s2.png", folder_ / "s1.png", fs::copy_options::overwrite_existing);
  EXPECT_NE(failures(verify_path(folder_ / "pair.png")).find("pair.png: source: "), std::string::npos);
}

TEST_F(RetargetStack, AVolumeWhoseSeedsMoveBetweenSlices) {
  for (const MoveForm form : {MoveForm::scatter, MoveForm::gather}) {
    RetargetEntry volume = entry("stack.ktx2", "v.ktx2");
    volume.anneals = volume.volume = true;
    volume.step = Offset{3, 5};
    volume.step_z = 1;
    volume.anneal.options.proposals = 200'000;
    volume.outputs[0].form = form;
    const JobRecord job = make_entry(volume);
    EXPECT_LT(job.tiles.at(0).energy, job.tiles.at(0).start_energy / 2);
    const Volume file = read_volume(folder_ / "v.ktx2");
    EXPECT_EQ(file.slices, SliceKind::depth);
    const VolumeMoves moves = decode_volume_moves(file.image);
    EXPECT_TRUE(std::any_of(moves.z.begin(), moves.z.end(), [](int z) { return z != 0; }));
    EXPECT_EQ(failures(verify_path(folder_ / "v.ktx2")), "");
  }
  Volume file = read_volume(folder_ / "v.ktx2");
  file.image.samples[2] ^= std::byte{1};
  write_image(folder_ / "v.ktx2", file.image, *file.metadata, SliceKind::depth);
  EXPECT_NE(failures(verify_path(folder_ / "v.ktx2")).find("v.ktx2: bijection: "), std::string::npos);
}

TEST_F(RetargetStack, InARecipeItIsBakedKeptAndVerified) {
  const std::string text =
      "version = 1\n"
      "[[mask]]\nname = 'a'\nsize = [16, 16]\noutputs = ['a.png']\n"
      "[[mask]]\nname = 'b'\nsize = [16, 16]\nseed = 2\noutputs = ['b.png']\n"
      "[[retarget]]\nname = 'pair'\nmask = 'a'\nto_mask = 'b'\nradius = 3\noutputs = ['pair.png']\n"
      "[[retarget]]\nname = 'stack'\nimage = 's%d.png'\nradius = 3\nmotion = 1\n"
      "outputs = ['t%d.png', { path = 'plain.dds', kind = 'tile' }]\n";
  const Recipe recipe = parse_recipe(text, "r", folder_);
  EXPECT_EQ(recipe_text(parse_recipe(recipe_text(recipe), "again", folder_)), recipe_text(recipe));
  const fs::path out = folder_ / "out";
  for (const JobRecord& job : bake(recipe, {.out_dir = out}).jobs) EXPECT_FALSE(job.skipped) << job.name;
  for (const JobRecord& job : bake(recipe, {.out_dir = out}).jobs) EXPECT_TRUE(job.skipped) << job.name;
  EXPECT_EQ(failures(verify_path(out)), "");
  // One slice that is gone, or another, is made again; so is everything when a source slice changes.
  fs::remove(out / "t3.png");
  for (const JobRecord& job : bake(recipe, {.out_dir = out}).jobs)
    EXPECT_EQ(job.skipped, job.name != "stack" && job.kind != "contact-sheet") << job.name;
  fs::copy(folder_ / "s1.png", folder_ / "s2.png", fs::copy_options::overwrite_existing);
  EXPECT_NE(failures(verify_path(out)).find("source: "), std::string::npos);
  for (const JobRecord& job : bake(recipe, {.out_dir = out}).jobs)
    EXPECT_EQ(job.skipped, job.name != "stack" && job.kind != "contact-sheet") << job.name;
  EXPECT_EQ(failures(verify_path(out)), "");
}

TEST_F(RetargetStack, WhatDoesNotFitIsNamedBeforeTheWork) {
  const auto refused = [&](const RetargetEntry& wrong, const std::string& part) {
    try {
      make_entry(wrong);
      ADD_FAILURE() << "accepted: " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused(entry("stack.ktx2", "t.png"), "5 slices");
  refused(entry("s%d.png", "s%d.png"), "would replace");
  RetargetEntry wrong = entry("stack.ktx2", "t.bin");
  wrong.anneals = true;
  refused(wrong, "the source has 5 slices");
  wrong = entry("s0.png", "t.png");
  wrong.anneals = wrong.volume = true;
  refused(wrong, "one slice");
  wrong = entry("s0.png", "t.png");
  wrong.to = (folder_ / "stack.ktx2").string();
  refused(wrong, "stack.ktx2");
  write_image(folder_ / "wide.png", encode_mask(void_and_cluster({.size = {32, 12}}), SampleType::u8), {});
  wrong.to = (folder_ / "wide.png").string();
  refused(wrong, "wide.png");
  write_image(folder_ / "deep.png", encode_mask(void_and_cluster({.size = {16, 12}}), SampleType::u16), {});
  wrong.to = (folder_ / "deep.png").string();
  refused(wrong, "deep.png");
  fs::remove(folder_ / "s3.png");
  refused(entry("s%d.png", "t%d.png"), "missing");
  EXPECT_FALSE(fs::exists(folder_ / "t0.png"));
}

}  // namespace
}  // namespace bn
