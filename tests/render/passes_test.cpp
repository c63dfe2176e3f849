// Protects: the passes as specification. Seeds are never lost or doubled, whatever the screen, the
// tile or the motion; the sort is the order it says; the mean motion is exact; wrong textures are
// refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "bn/error.h"
#include "bn/random.h"
#include "bn/render.h"

namespace bn {
namespace {

Grid<std::int32_t> random_mask(Extent size, std::uint64_t seed) {
  Grid<std::int32_t> mask(size);
  for (std::size_t i = 0; i < mask.count(); ++i)
    mask[i] = static_cast<std::int32_t>(random_bits(seed, 1, i) & 255);
  return mask;
}

/// Some bijection with moves near `motion`: swaps of neighbours, on top of a shift.
Grid<Offset> some_moves(Extent size, Offset motion, std::uint64_t seed) {
  Grid<Offset> move(size, motion);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x + 1 < size.width; x += 2) {
      if (random_bits(seed, 2, static_cast<std::uint64_t>(y * size.width + x)) & 1) {
        move(x, y).x += 1;
        move(x + 1, y).x -= 1;
      }
    }
  }
  return move;
}

TemporalTextures some_textures(Extent size, int range) {
  TemporalTextures textures{.masks = {random_mask(size, 5)}, .step = {7, 3}, .motion_range = range};
  for (int y = -range; y <= range; ++y) {
    for (int x = -range; x <= range; ++x) {
      textures.moves.push_back(some_moves(size, {x, y}, static_cast<std::uint64_t>(y * 31 + x + 1000)));
    }
  }
  return textures;
}

std::vector<std::uint32_t> sorted(const Seeds& seeds) {
  std::vector<std::uint32_t> values(seeds.begin(), seeds.end());
  std::sort(values.begin(), values.end());
  return values;
}

TEST(Seeds, MultisetSurvivesAHundredFramesOnAnyScreen) {
  const TemporalTextures textures = some_textures({32, 16}, 1);
  ASSERT_NO_THROW(textures.check());
  for (const Extent screen : {Extent{1920, 1080}, {640, 360}, {257, 131}, {64, 64}, {1, 1}}) {
    Seeds seeds = initial_seeds(padded_extent(screen, textures.size()), 77);
    const auto before = sorted(seeds);
    const std::uint64_t digest = multiset_digest(seeds);
    EXPECT_EQ(std::adjacent_find(before.begin(), before.end()), before.end()) << "seeds are all different";
    Grid<float> luminance(screen);
    for (int frame = 0; frame < 100; ++frame) {
      // As in a renderer, the seed decides the value; the frame stands for a scene that changes.
      for (int y = 0; y < screen.height; ++y) {
        for (int x = 0; x < screen.width; ++x)
          luminance(x, y) = static_cast<float>(seeds(x, y) * (2u * static_cast<std::uint32_t>(frame) + 1u));
      }
      const Offset shift = tile_shift(textures.size(), textures.step, frame);
      // Every size of block, still and jittered; retarget off in some frames, else every motion there is.
      // Small blocks are cheap, so the largest screen has mostly those.
      const bool large = screen.area() > 1'000'000 && frame % 20 < 16;
      const int block = large ? 2 << frame % 2 : 2 << frame % 4;
      sort_seeds(seeds, luminance, textures.mask(0), shift, sort_blocks(block, frame % 3 == 0, 9, frame));
      if (frame % 10 == 9) continue;
      seeds = retarget_seeds(seeds, textures.move({frame % 3 - 1, frame / 3 % 3 - 1}, frame), shift);
    }
    EXPECT_EQ(multiset_digest(seeds), digest);
    EXPECT_EQ(sorted(seeds), before) << screen.width << "x" << screen.height;
  }
}

TEST(Seeds, DigestSeesALossThatKeepsTheSum) {
  Seeds seeds = initial_seeds({8, 8}, 1);
  const std::uint64_t digest = multiset_digest(seeds);
  std::swap(seeds[3], seeds[40]);
  EXPECT_EQ(multiset_digest(seeds), digest);
  seeds[3] += 1;
  seeds[40] -= 1;
  EXPECT_NE(multiset_digest(seeds), digest);
}

TEST(Sort, DarkestSeedGoesToTheLowestLevel) {
  const Extent screen{37, 21};  // no multiple of any block
  const Grid<std::int32_t> mask = random_mask({16, 16}, 3);
  const Offset shift{5, 11};
  for (const int side : {2, 4, 8, 16}) {
    const SortBlocks blocks{.side = side, .origin = {side / 2, side - 1}};
    Grid<float> value_of_seed(screen);
    Seeds seeds(screen);
    std::iota(seeds.begin(), seeds.end(), 0u);
    for (std::size_t i = 0; i < seeds.count(); ++i)
      value_of_seed[i] = sample(static_cast<std::uint32_t>(i), 4);
    sort_seeds(seeds, value_of_seed, mask, shift, blocks);
    // In each block, levels in order imply values in order.
    for (int y = 0; y < screen.height; ++y) {
      for (int x = 0; x < screen.width; ++x) {
        for (int v = 0; v < screen.height; ++v) {
          for (int u = 0; u < screen.width; ++u) {
            const auto cell = [&](int a, int origin) { return (a + origin) / side; };
            if (cell(x, blocks.origin.x) != cell(u, blocks.origin.x)) continue;
            if (cell(y, blocks.origin.y) != cell(v, blocks.origin.y)) continue;
            if (mask.torus(x + shift.x, y + shift.y) >= mask.torus(u + shift.x, v + shift.y)) continue;
            ASSERT_LE(value_of_seed[seeds(x, y)], value_of_seed[seeds(u, v)] * (1 + 0x1p-15f));
          }
        }
      }
    }
  }
}

TEST(Sort, TiesGoByIndexAndOddValuesAreBlack) {
  // All levels and values equal: nothing moves.
  Seeds seeds = initial_seeds({16, 16}, 3);
  const Seeds before = seeds;
  sort_seeds(seeds, Grid<float>({16, 16}, 0.5f), Grid<std::int32_t>({4, 4}, 7), {0, 0},
             {.side = 8, .origin = {}});
  EXPECT_EQ(seeds, before);
  // NaN and negative count as 0; infinity is the brightest.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Grid<float> odd({2, 2});
  odd(0, 0) = std::numeric_limits<float>::infinity();
  odd(1, 0) = nan;
  odd(0, 1) = 3.0e38f;
  odd(1, 1) = -1.0f;
  Grid<std::int32_t> mask({2, 2});
  std::iota(mask.begin(), mask.end(), 0);
  Seeds four({2, 2});
  std::iota(four.begin(), four.end(), 0u);
  sort_seeds(four, odd, mask, {0, 0}, {.side = 2, .origin = {}});
  EXPECT_EQ((std::vector<std::uint32_t>(four.begin(), four.end())), (std::vector<std::uint32_t>{1, 3, 2, 0}));
}

TEST(Retarget, ScattersByTheTexelOfThisFrame) {
  const TemporalTextures textures = some_textures({8, 4}, 0);
  const Seeds seeds = initial_seeds({24, 12}, 8);
  const Offset shift = tile_shift({8, 4}, textures.step, 5);
  EXPECT_EQ(shift, (Offset{35 % 8, 15 % 4}));
  const Seeds moved = retarget_seeds(seeds, textures.moves[0], shift);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 24; ++x) {
      const Offset by = textures.moves[0].torus(x + shift.x, y + shift.y);
      EXPECT_EQ(moved.torus(x + by.x, y + by.y), seeds(x, y));
    }
  }
}

TEST(Motion, MeanIsExactRoundedHalfUpAndClamped) {
  Grid<PixelMotion> motion({3, 1}, PixelMotion{kNoMotion, kNoMotion});
  EXPECT_EQ(choose_motion(motion, 4), (Offset{0, 0}));
  motion[1] = {128, -128};  // 0.5, -0.5
  EXPECT_EQ(choose_motion(motion, 4), (Offset{1, 0}));
  motion[0] = {126, -130};  // means just below a half
  EXPECT_EQ(choose_motion(motion, 4), (Offset{0, -1}));
  motion[0] = {20000, -20000};
  EXPECT_EQ(choose_motion(motion, 4), (Offset{4, -4}));
  EXPECT_EQ(choose_motion(motion, 0), (Offset{0, 0}));
}

TEST(Textures, WrongOnesAreRefused) {
  TemporalTextures textures = some_textures({8, 8}, 1);
  EXPECT_NO_THROW(textures.check());
  textures.moves.pop_back();
  EXPECT_THROW(textures.check(), Error);
  textures = some_textures({8, 8}, 0);
  textures.moves[0](3, 3).x += 1;
  EXPECT_THROW(textures.check(), Error);
  textures = some_textures({8, 8}, 0);
  textures.moves[0] = some_moves({8, 4}, {0, 0}, 1);
  EXPECT_THROW(textures.check(), Error);
  EXPECT_THROW(padded_extent({0, 5}, {8, 8}), Error);
  Seeds seeds({10, 8});
  EXPECT_THROW(retarget_seeds(seeds, some_moves({8, 8}, {0, 0}, 1), {0, 0}), Error);
  EXPECT_THROW(sort_blocks(3, false, 0, 0), Error);
}

}  // namespace
}  // namespace bn
