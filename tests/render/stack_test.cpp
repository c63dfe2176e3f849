// Protects: a stack of masks is what it says: of one slice it is the still mask, of the places of one moved
// mask it is the moved mask, bit for bit, sampled or sorted; seeds survive; its files are read as baked, and
// those that do not belong together are refused by name.
#include <gtest/gtest.h>

#include <algorithm>

#include "bn/error.h"
#include "bn/texture.h"
#include "bn/volume.h"
#include "render/scratch.h"
#include "render/test_textures.h"

namespace bn {
namespace {

/// Frames of a small sequence.
std::vector<Frame> frames_of(const TemporalTextures& textures, Method method, int count) {
  const auto renderer =
      make_plain_renderer(load_scene("poster"), textures, {.screen = {72, 40}, .method = method, .block = 4});
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(renderer->next());
  return frames;
}

void expect_equal(const std::vector<Frame>& a, const std::vector<Frame>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(a[i].colour == b[i].colour) << "frame " << i;
    EXPECT_TRUE(a[i].seeds == b[i].seeds) << "frame " << i;
  }
}

template <class T>
Grid<T> moved(const Grid<T>& grid, Offset by) {
  Grid<T> result(grid.size());
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) result(x, y) = grid.torus(x + by.x, y + by.y);
  }
  return result;
}

TEST(Stack, OfOneSliceIsTheStillMask) {
  // All levels different: nothing but staying costs nothing.
  TemporalTextures stack{.masks = {Grid<std::int32_t>(Extent{64, 64})}, .step = {0, 0}};
  const auto ranks = void_and_cluster({.size = {64, 64}});
  std::copy(ranks.begin(), ranks.end(), stack.masks[0].begin());
  solve_moves(stack, 6);
  ASSERT_EQ(stack.moves.size(), 1u);
  EXPECT_TRUE(stack.moves[0] == Grid<Offset>(Extent{64, 64})) << "what is sorted already stays";
  expect_equal(frames_of(stack, Method::mask_moved, 3), frames_of(stack, Method::mask_still, 3));
  expect_equal(frames_of(stack, Method::retarget, 3), frames_of(stack, Method::sort, 3));
}

TEST(Stack, OfTheMovedMasksPlacesIsTheMovedMask) {
  const TemporalTextures& one = test::proven_textures();
  TemporalTextures stack;
  for (int frame = 0; frame < 64; ++frame) {  // the orbit of the step
    stack.masks.push_back(moved(one.mask(0), one.shift(frame)));
    stack.moves.push_back(moved(one.moves[0], one.shift(frame)));
  }
  expect_equal(frames_of(stack, Method::mask_moved, 5), frames_of(one, Method::mask_moved, 5));
  expect_equal(frames_of(stack, Method::retarget, 5), frames_of(one, Method::retarget, 5));
  // Solved from the masks, the tiles are as good: no other permutation within reach is better.
  TemporalTextures solved{.masks = {stack.masks[0], stack.masks[1]}};
  solve_moves(solved, 6);
  EXPECT_EQ(retarget_energy({stack.masks[0], stack.masks[1]}, solved.moves[0], {}),
            retarget_energy(one.mask(0), one.moves[0], {.step = one.step}));
}

TEST(Stack, KeepsTheSeedsAndComesAround) {
  TemporalTextures stack = make_preset_textures(SpatiotemporalPreset::both);
  ASSERT_EQ(stack.masks.size(), 32u);
  stack.masks.resize(3);
  solve_moves(stack, 3, {.threads = 2});
  const std::vector<Frame> frames = frames_of(stack, Method::retarget, 7);
  for (const Frame& frame : frames) EXPECT_EQ(multiset_digest(frame.seeds), multiset_digest(frames[0].seeds));
  TemporalTextures alone = stack;
  solve_moves(alone, 3, {.threads = 1});
  EXPECT_EQ(alone.moves, stack.moves) << "on any number of threads";
  // A sampler has nothing but the slice: frames three apart are equal.
  const std::vector<Frame> sampled = frames_of(stack, Method::mask_moved, 4);
  EXPECT_EQ(sampled[0].colour, sampled[3].colour);
  EXPECT_FALSE(sampled[0].colour == sampled[1].colour);
}

TEST(Stack, ThatDoesNotFitIsRefused) {
  const auto refusal = [](const TemporalTextures& textures) -> std::string {
    try {
      textures.check();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      return error.what();
    }
    return "";
  };
  const Grid<std::int32_t> small({8, 8}), other({8, 4});
  const Grid<Offset> still(Extent{8, 8});
  EXPECT_EQ(refusal({.masks = {small, small}, .moves = {still, still}}), "");
  EXPECT_NE(refusal({.masks = {}}).find("mask is empty"), std::string::npos);
  EXPECT_NE(refusal({.masks = {small, other}}).find("8x4 after 8x8"), std::string::npos);
  EXPECT_NE(refusal({.masks = {small, small}, .moves = {still}}).find("1 retarget tiles"), std::string::npos);
  EXPECT_NE(refusal({.masks = {small}, .moves = {still, still}}).find("2 retarget tiles"), std::string::npos);
  EXPECT_NE(refusal({.masks = {small}, .moves = {Grid<Offset>(other.size())}}).find("8x4"),
            std::string::npos);
}

class StackFiles : public testing::Test {
 protected:
  StackFiles() {
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      slices_.push_back(encode_mask(void_and_cluster({.size = {16, 16}, .seed = seed}), SampleType::u8));
    write_volume(folder_ / "slice_%d.png", stack_slices(slices_), {});
    made_ = read_stack_textures(folder_ / "slice_%d.png");
    solve_moves(made_, 3);
    write_tiles("tile_%d.png", 3, {16, 16}, pixel_hash(stack_slices(slices_)));
  }

  void write_tiles(const std::string& name, std::size_t count, Extent size, const std::string& source_hash) {
    Metadata said;
    said.kind = "retarget-tile";
    said.facts.add("step", Offset{0, 0});
    said.facts.add("source_hash", source_hash);
    said.tiles.resize(count);
    std::vector<Image> tiles;
    for (std::size_t i = 0; i < count; ++i)
      tiles.push_back(encode_moves(size == Extent{16, 16} ? made_.moves[i] : Grid<Offset>(size)));
    write_volume(folder_ / name, stack_slices(tiles), said);
  }

  std::string refusal(const std::string& tiles, ErrorCode code = ErrorCode::invalid_input) {
    try {
      read_stack_textures(folder_ / "slice_%d.png", folder_ / tiles);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_NE(std::string(error.what()).find(tiles), std::string::npos) << error.what();
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_ = test::fresh_folder("stack");
  std::vector<Image> slices_;
  TemporalTextures made_;
};

TEST_F(StackFiles, AreReadAsTheyWereBaked) {
  const TemporalTextures read = read_stack_textures(folder_ / "slice_%d.png", folder_ / "tile_%d.png");
  EXPECT_EQ(read.masks, made_.masks);
  EXPECT_EQ(read.moves, made_.moves);
  EXPECT_EQ(read.step, (Offset{0, 0}));
}

TEST_F(StackFiles, ThatDoNotBelongTogetherAreRefused) {
  const std::string hash = pixel_hash(stack_slices(slices_));
  write_tiles("other_%d.png", 3, {16, 16}, "xxh3-128:0");
  EXPECT_NE(refusal("other_%d.png").find("another mask"), std::string::npos);
  write_tiles("two_%d.png", 2, {16, 16}, hash);
  EXPECT_NE(refusal("two_%d.png").find("2 slices of tiles for 3"), std::string::npos);
  write_tiles("large_%d.png", 3, {32, 32}, hash);
  EXPECT_NE(refusal("large_%d.png").find("32x32"), std::string::npos);
  EXPECT_NE(refusal("slice_%d.png").find("step"), std::string::npos) << "masks for tiles";
}

}  // namespace
}  // namespace bn
