// Protects: bn pack copies exactly the channels that are named, and what cannot be packed is refused before a
// file is touched, with the file, the limit and what to do.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bn/noise.h"
#include "bn/volume.h"
#include "named_exr.h"
#include "process.h"
#include "textures.h"

namespace bn::tools {
namespace {

using Json = nlohmann::json;

class Pack : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 4; ++i) {
      Image image = simple_mask(16);
      for (std::byte& sample : image.samples) sample ^= static_cast<std::byte>(37 * i);
      masks_.push_back(image);
      write_image(scratch_ / (std::string(1, static_cast<char>('a' + i)) + ".png"), image, {});
    }
  }
  ProcessResult run(const std::vector<std::string>& arguments) {
    return run_bn(arguments, {.folder = scratch_.path()});
  }
  void refused(const std::vector<std::string>& arguments, const std::string& text, int exit_code = 3) {
    const auto before = names_in(scratch_.path());
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
    EXPECT_EQ(names_in(scratch_.path()), before);
  }

  ScratchFolder scratch_;
  std::vector<Image> masks_;
};

TEST_F(Pack, FourMasksBecomeOneTextureWithStraightAlpha) {
  for (const char* out : {"rgba.png", "rgba.ktx2", "rgba.dds", "rgba.tif"}) {
    const ProcessResult result = run({"pack", "a.png", "b.png", "c.png", "d.png", "-o", out, "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json.at("channels"), 4);
    EXPECT_EQ(json.at("sources").at(2).at("file"), "c.png");
    const FileContent content = read_image(scratch_ / out);
    EXPECT_EQ(json.at("pixel_hash"), pixel_hash(content.image));
    for (int c = 0; c < 4; ++c) {
      EXPECT_EQ(samples_of_channel(content.image, c).value,
                samples_of_channel(masks_[static_cast<std::size_t>(c)], 0).value);
    }
    ASSERT_TRUE(content.metadata.has_value());
    EXPECT_EQ(content.metadata->kind, "packed");
  }
}

TEST_F(Pack, WhatWasPackedVerifies) {
  ASSERT_EQ(run({"pack", "a.png", "b.png", "-o", "ab.png"}).exit_code, 0);
  EXPECT_EQ(run({"verify", "ab.png"}).exit_code, 0);
}

TEST_F(Pack, AnyChannelOfAnyFileCanBeChosen) {
  ASSERT_EQ(run({"pack", "a.png", "b.png", "c.png", "d.png", "-o", "rgba.png"}).exit_code, 0);
  ASSERT_EQ(run({"pack", "rgba.png:3", "a.png", "rgba.png:1", "-o", "three.png"}).exit_code, 0);
  const Image three = read_image(scratch_ / "three.png").image;
  ASSERT_EQ(three.channels, 3);
  for (const auto& [channel, mask] : {std::pair{0, 3}, {1, 0}, {2, 1}}) {
    EXPECT_EQ(samples_of_channel(three, channel).value,
              samples_of_channel(masks_[static_cast<std::size_t>(mask)], 0).value);
  }
}

TEST_F(Pack, ChannelsOfAnExrHaveNames) {
  write_named_exr(scratch_ / "passes.exr", void_and_cluster({.size = {16, 16}}));
  ASSERT_EQ(run({"pack", "passes.exr:Z", "passes.exr:0", "-o", "two.exr"}).exit_code, 0);
  const Image passes = read_image(scratch_ / "passes.exr").image;
  const Image two = read_image(scratch_ / "two.exr").image;
  EXPECT_EQ(samples_of_channel(two, 0).value, samples_of_channel(passes, 1).value);
  EXPECT_EQ(samples_of_channel(two, 1).value, samples_of_channel(passes, 0).value);
  refused({"pack", "passes.exr:ids", "-o", "out.exr"}, "did you mean id?");
}

TEST_F(Pack, VolumesArePackedSliceBySlice) {
  for (const char* name : {"x", "y"}) {
    std::filesystem::create_directory(scratch_ / name);
    write_volume(scratch_ / name / "s_%d.png", stack_slices(masks_), {});
  }
  const ProcessResult result =
      run({"pack", "x", "y/s_%d.png", "-o", "both.ktx2", "--slices", "depth", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out).at("depth"), 4);
  const Volume both = read_volume(scratch_ / "both.ktx2");
  EXPECT_EQ(both.slices, SliceKind::depth);
  EXPECT_EQ(both.image.channels, 2);
  EXPECT_EQ(samples_of_channel(both.image, 1).value, samples_of_channel(stack_slices(masks_), 0).value);
}

TEST_F(Pack, WhatDoesNotFitIsRefusedByName) {
  write_image(scratch_ / "small.png", simple_mask(8), {});
  write_image(scratch_ / "wide.png", simple_mask(16, SampleType::u16), {});
  refused({"pack", "a.png", "small.png", "-o", "out.png"},
          "small.png: 8x8 pixels, 8bit (allowed: 16x16 pixels, 8bit, as a.png)");
  refused({"pack", "a.png", "wide.png", "-o", "out.png"}, "wide.png: 16x16 pixels, 16bit");
  refused({"pack", "a.png:1", "-o", "out.png"}, "a.png: it has no channel 1 (allowed: 0..0)");
  refused({"pack", "a.png", "b.png", "c.png", "d.png", "a.png", "-o", "out.png"},
          "cannot hold 5 channels (allowed: 1..4)");
  refused({"pack", "a.png", "b.png", "c.png", "-o", "out.dds"}, "3 channels");
  refused({"pack", "a.png", "-o", "out.exr"}, "8bit");
  refused({"pack", "a.png", "-o", "out.xyz"}, "unknown extension", 1);
  EXPECT_EQ(run({"pack", "a.png", "missing.png", "-o", "out.png"}).exit_code, 2);
  EXPECT_EQ(run({"pack", "-o", "out.png"}).exit_code, 1);
  EXPECT_EQ(run({"pack", "a.png"}).exit_code, 1);
}

}  // namespace
}  // namespace bn::tools
