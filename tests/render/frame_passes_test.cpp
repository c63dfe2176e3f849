// Protects: the list of a frame's passes: each reads what is there, and methods differ in what they should;
// methods have names, and the shipped scenes are all documented.
#include "render/frame_passes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace bn {
using namespace render;
namespace {

TEST(FramePasses, ReadOnlyWhatIsThere) {
  for (const Method& method : kMethods) {
    for (const int frame : {0, 1, 5}) {
      std::set<FrameImage> there{FrameImage::scene,  FrameImage::moves, FrameImage::seeds,
                                 FrameImage::levels, FrameImage::mask,  FrameImage::chosen_motion};
      int final_seeds = 0;
      for (const FramePass& pass : passes_of(method, frame)) {
        for (const FrameImage image : pass.inputs) EXPECT_TRUE(there.contains(image)) << pass.name;
        there.insert(pass.outputs.begin(), pass.outputs.end());
        final_seeds += pass.seeds_are_final;
      }
      EXPECT_TRUE(there.contains(FrameImage::shown));
      EXPECT_EQ(final_seeds, 1);
    }
  }
}

std::string names_of(const Method& method, int frame) {
  std::string names;
  for (const FramePass& pass : passes_of(method, frame))
    names += (names.empty() ? "" : ", ") + std::string(pass.name);
  return names;
}

TEST(FramePasses, AreThoseOfTheMethod) {
  EXPECT_EQ(names_of(Method::white, 1), "gbuffer, trace, tone map");
  EXPECT_EQ(names_of(Method::mask_moved, 1), "gbuffer, trace, tone map");
  EXPECT_EQ(names_of(Method::sort, 1), "gbuffer, trace, sort, tone map");
  EXPECT_EQ(names_of(Method::retarget, 0), "gbuffer, trace, sort, tone map");
  EXPECT_EQ(names_of(Method::retarget, 1), "gbuffer, retarget, trace, sort, tone map");
  EXPECT_EQ(names_of(Method::reproject, 1), "gbuffer, motion, retarget, trace, sort, tone map");
}

TEST(Methods, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Method& method : kMethods) names.insert(name_of(method));
  EXPECT_EQ(names.size(), std::size(kMethods));
  EXPECT_FALSE(names.contains(""));
  EXPECT_EQ(name_of({Sampler::seeds, SeedTransport::none}), "");
}

TEST(Scenes, ShippedOnesAreDocumented) {
  for (const char* page : {"docs/validation.md", "docs/bn.md"}) {
    std::ifstream file(std::string(BN_SOURCE_DIR "/") + page);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    for (const std::string& name : shipped_scene_names())
      EXPECT_NE(text.find(name), std::string::npos) << name << " in " << page;
  }
}

}  // namespace
}  // namespace bn
