// Protects: stacks in the report. Slices in files of their own are one volume again, as in one file; the
// worst slice is named; retarget tiles of a stack, and between two masks, are recomputed with the masks they
// lead from and to.
#include <gtest/gtest.h>

#include "bn/random.h"
#include "bn/spatiotemporal.h"
#include "bn/volume.h"
#include "report/fixtures.h"

namespace bn::report {
namespace {

constexpr int kSlices = 4;

class StackReport : public testing::Test {
 protected:
  StackReport() {
    const auto ranks = spatiotemporal_mask({.size = {32, 32, kSlices}});
    stack_ = Image{.size = {32, 32}, .depth = kSlices, .channels = 1, .type = SampleType::u8, .samples = {}};
    for (const std::uint32_t rank : ranks) stack_.samples.push_back(static_cast<std::byte>(rank / 4));
    metadata_.algorithm = "void-and-cluster-volume";
    metadata_.algorithm_version = 1;
    metadata_.kind = "spatiotemporal-mask";
    metadata_.facts.add("slices", kSlices);
  }

  /// The tiles of the stack, from each slice to the next, and the metadata of their file.
  std::pair<Image, Metadata> tiles() const {
    const RetargetOptions options{.radius = 3};
    const Grid<std::int32_t> levels = levels_of_channel(stack_, 0).value;
    const auto slice = [&](int z) {
      Grid<std::int32_t> one({32, 32});
      std::copy_n(levels.slice(z % kSlices).begin(), one.count(), one.begin());
      return one;
    };
    Metadata metadata = retarget_metadata("retarget-tile", options);
    metadata.facts.add("source", "slice.ktx2");
    metadata.facts.add("source_channel", 0);
    metadata.facts.add("source_hash", pixel_hash(stack_));
    std::vector<Image> images;
    for (int z = 0; z < kSlices; ++z) {
      const RetargetTile tile = solve_retarget({slice(z), slice(z + 1)}, options);
      images.push_back(encode_moves(tile.move));
      metadata.tiles.push_back({{0, 0}, tile.start_energy, tile.energy, tile.lower_bound});
    }
    return {stack_slices(images), metadata};
  }

  ReportSummary report(std::vector<std::filesystem::path> inputs) {
    return write_report({.inputs = std::move(inputs), .out = folder_ / "r.html"});
  }
  std::string page() const { return read_text_file(folder_ / "r.html"); }

  TemporaryFolder folder_;
  Image stack_;
  Metadata metadata_;
};

TEST_F(StackReport, SlicesInFilesOfTheirOwnAreOneVolume) {
  std::filesystem::create_directory(folder_ / "in");
  bn::write_volume(folder_ / "in" / "slice_%03d.png", stack_, metadata_);
  ReportSummary summary = report({folder_ / "in"});
  EXPECT_EQ(summary.volumes, 1);
  EXPECT_EQ(summary.masks, 0);
  EXPECT_NE(page().find("slice_000.png and 3 more"), std::string::npos);
  EXPECT_NE(page().find("32 × 32 × 4 pixels"), std::string::npos);

  std::filesystem::remove(folder_ / "in" / "slice_002.png");
  summary = report({folder_ / "in"});
  EXPECT_EQ(summary.volumes, 0);
  EXPECT_EQ(summary.masks, 3);
  EXPECT_NE(page().find("3 of 4 slices are here"), std::string::npos);
}

TEST_F(StackReport, AManifestTellsOfSlicesByTheirPattern) {
  std::filesystem::create_directory(folder_ / "in");
  bn::write_volume(folder_ / "in" / "s_%02d.png", stack_, metadata_);
  Image wide = stack_;  // another encoding
  wide.type = SampleType::u16;
  wide.samples.clear();
  for (const std::byte sample : stack_.samples) {
    wide.samples.push_back(std::byte{0});
    wide.samples.push_back(sample);
  }
  bn::write_volume(folder_ / "in" / "s.ktx2", wide, metadata_);
  write_text_file(folder_ / "in" / "manifest.json",
                  R"({"jobs": [{"name": "vol", "kind": "spatiotemporal", "files": [{"path": "s_%02d.png"},
                      {"path": "s.ktx2"}]}], "times": {"jobs": {"vol": 0.25}}})");
  EXPECT_EQ(report({folder_ / "in"}).volumes, 1);
  EXPECT_NE(page().find("made in 0.25 s"), std::string::npos);
  EXPECT_NE(page().find("Also as s.ktx2."), std::string::npos);
}

TEST_F(StackReport, ASliceByItselfIsAPicture) {
  bn::write_volume(folder_ / "slice_%03d.png", stack_, metadata_);
  EXPECT_EQ(report({folder_ / "slice_001.png"}).masks, 1);
}

TEST_F(StackReport, AFileOfSlicesIsAVolumeWithTheWorstNamed) {
  // White noise in slice 2.
  for (std::size_t i = 0; i < 1024; ++i)
    stack_.samples[2 * 1024 + i] = static_cast<std::byte>(random_bits(1, 2, i) & 255u);
  bn::write_volume(folder_ / "stack.ktx2", stack_, metadata_);
  EXPECT_EQ(report({folder_ / "stack.ktx2"}).volumes, 1);
  EXPECT_NE(page().find("The worst slice is 2:"), std::string::npos);
  EXPECT_NE(page().find("(slice 2)</td>"), std::string::npos) << "the table";
  EXPECT_EQ(
      write_report({.inputs = {folder_ / "stack.ktx2"}, .out = folder_ / "r.html", .volume = true}).volumes,
      1);
}

TEST_F(StackReport, APresetForAFilterIsJudgedByItsSlices) {
  metadata_.facts.add("preset", "filtered");
  bn::write_volume(folder_ / "stack.ktx2", stack_, metadata_);
  report({folder_ / "stack.ktx2"});
  EXPECT_NE(page().find("judged by its slices"), std::string::npos);
  EXPECT_EQ(page().find("in space and time</span>"), std::string::npos);
}

TEST_F(StackReport, TilesOfAStackAreRecomputedFrameByFrame) {
  auto [moves, metadata] = tiles();
  bn::write_volume(folder_ / "slice.ktx2", stack_, metadata_);
  bn::write_volume(folder_ / "tile_%02d.png", moves, metadata);
  ReportSummary summary = report({folder_.path()});
  EXPECT_EQ(summary.retarget_sets, 1);
  EXPECT_EQ(summary.volumes, 1);
  EXPECT_EQ(page().find("not as recorded"), std::string::npos);
  EXPECT_NE(page().find("4 of 4 <span class=\"badge pass\">"), std::string::npos);
  EXPECT_NE(page().find("over 4 frames"), std::string::npos);
  EXPECT_NE(page().find("each is the proven optimum"), std::string::npos);

  metadata.tiles[2].energy += 1000;
  bn::write_volume(folder_ / "tile_%02d.png", moves, metadata);
  EXPECT_EQ(report({folder_.path()}).failed, summary.failed + 1);
  EXPECT_NE(page().find("not as recorded"), std::string::npos);
  EXPECT_NE(page().find("From slice 2 to 3, the frame of most energy"), std::string::npos);
}

TEST_F(StackReport, TilesWithoutAllTheirSlicesAreLeftOutAndNamed) {
  const auto [moves, metadata] = tiles();
  bn::write_volume(folder_ / "tile_%02d.png", moves, metadata);
  std::filesystem::remove(folder_ / "tile_01.png");
  write_mask(folder_ / "mask.png", 32, 1);
  EXPECT_EQ(report({folder_.path()}).retarget_sets, 0);
  EXPECT_NE(page().find("3 of 4 slices are here, so they are left out"), std::string::npos);
}

TEST_F(StackReport, ASetBetweenTwoMasksIsRecomputedWithBoth) {
  write_mask(folder_ / "a.png", 32, 1);
  write_mask(folder_ / "b.png", 32, 2);
  const Image a = mask_image(32, 1), b = mask_image(32, 2);
  const auto from = levels_of_channel(a, 0).value, to = levels_of_channel(b, 0).value;
  const RetargetOptions options{.radius = 3};
  const RetargetTile tile = solve_retarget({from, to}, options);
  Metadata metadata = retarget_metadata("retarget-tile", options);
  metadata.facts.add("source", "a.png");
  metadata.facts.add("source_channel", 0);
  metadata.facts.add("source_hash", pixel_hash(a));
  metadata.facts.add("to", "b.png");
  metadata.facts.add("to_hash", pixel_hash(b));
  metadata.tiles.push_back({{0, 0}, tile.start_energy, tile.energy, tile.lower_bound});
  write_image(folder_ / "ab.png", encode_moves(tile.move), metadata);
  EXPECT_EQ(report({folder_.path()}).failed, 0);
  EXPECT_NE(page().find("1 of 1 <span class=\"badge pass\">"), std::string::npos);
  std::filesystem::remove(folder_ / "b.png");
  report({folder_.path()});
  EXPECT_NE(page().find("its masks are not among the files"), std::string::npos);
}

// The energy of several channels, or of a filtered residual, is no sum over one mask's pixels. A report once
// called such tiles "not as recorded".
TEST_F(StackReport, AnotherEnergyIsNotHeldAgainstAPlainOne) {
  write_mask(folder_ / "a.png", 32, 1);
  const Image a = mask_image(32, 1);
  const auto levels = levels_of_channel(a, 0).value;
  const RetargetOptions options{.step = {24, 19}, .radius = 3};
  const RetargetTile tile = solve_retarget(levels, options);
  Metadata metadata = retarget_metadata("retarget-tile", options);
  metadata.algorithm = "retarget-anneal";
  metadata.facts.add("source", "a.png");
  metadata.facts.add("source_channel", 0);
  metadata.facts.add("source_hash", pixel_hash(a));
  metadata.tiles.push_back({{0, 0}, tile.start_energy, tile.energy + 100, 0});
  for (const auto& [keys, other] :
       {std::pair("channel = 0\nresidual_sigma = 0.0\n", false), std::pair("residual_sigma = 1.5\n", true),
        std::pair("channels = [0, 1]\nresidual_sigma = 0.0\n", true)}) {
    metadata.recipe = std::string("[[retarget]]\n") + keys;
    write_image(folder_ / "t.png", encode_moves(tile.move), metadata);
    EXPECT_EQ(report({folder_.path()}).failed, other ? 0 : 1) << keys;
    EXPECT_EQ(page().find("not recomputed: it is of several") != std::string::npos, other) << keys;
  }
}

}  // namespace
}  // namespace bn::report
