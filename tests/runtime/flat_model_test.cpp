// Protects: what the textures are for. On the flat picture, sorting and a proven retarget tile reach
// their figures of low-frequency power, and beat tiles of the published energy.
#include <gtest/gtest.h>

#include <cstdlib>

#include "runtime/test_textures.h"

namespace bn {
namespace {

using test::kStep;

/// Power in dB at frame `frame`, the mean over four sets of seeds: one run scatters by about 0.3 dB.
double power_at(int frame, int block, bool retarget, const TemporalTextures& textures) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    sum += run_flat_model({.block = block, .retarget = retarget, .frames = frame, .seed = seed}, textures)
               .back();
  }
  return sum / 4.0;
}

double frame_8(int block, bool retarget, const TemporalTextures& textures) {
  return power_at(8, block, retarget, textures);
}

TEST(FlatModel, FirstFrameIsWhiteNoise) {
  const auto power = run_flat_model({.frames = 0}, test::proven_textures());
  EXPECT_NEAR(power.at(0), 0.0, 0.4);  // about 2000 frequencies: one standard deviation is 0.1 dB
}

TEST(FlatModel, SortOnlyReachesItsFigures) {
  EXPECT_NEAR(frame_8(8, false, test::proven_textures()), -3.4, 1.0);
  EXPECT_NEAR(frame_8(16, false, test::proven_textures()), -9.1, 1.0);
}

TEST(FlatModel, ProvenTileReachesItsFigures) {
  EXPECT_LE(frame_8(2, true, test::proven_textures()), -9.0);
  EXPECT_NEAR(frame_8(4, true, test::proven_textures()), -14.8, 1.0);
  EXPECT_LE(frame_8(8, true, test::proven_textures()), -17.0);
  EXPECT_LE(frame_8(16, true, test::proven_textures()), -19.5);
}

/// A tile of the published energy in the way of an annealer: swaps within reach that do not raise the
/// energy, from the identity down to `target`.
Grid<Offset> swapped_tile(const Grid<std::int32_t>& levels, Offset step, int radius, std::int64_t target) {
  const Extent size = levels.size();
  Grid<Offset> move(size);
  std::int64_t energy = retarget_energy(levels, move, {.step = step, .radius = radius});
  const auto cost = [&](int x, int y, Offset by) {
    return std::abs(levels(x, y) - levels.torus(x + by.x + step.x, y + by.y + step.y));
  };
  const auto reachable = [&](Offset by) { return std::abs(by.x) <= radius && std::abs(by.y) <= radius; };
  for (std::uint64_t k = 0; energy > target && k < 20'000'000; ++k) {
    const std::uint64_t bits = random_bits(11, 1, k);
    const auto below = [&](int shift, int bound) {
      return static_cast<int>(
          random_below(static_cast<std::uint32_t>(bits >> shift << 16), static_cast<std::uint32_t>(bound)));
    };
    const int x = below(0, size.width), y = below(16, size.height);
    const int dx = below(32, 17) - 8, dy = below(48, 17) - 8;
    const int u = wrap(x + dx, size.width), v = wrap(y + dy, size.height);
    // p takes q's destination and q takes p's.
    const Offset of_p{dx + move(u, v).x, dy + move(u, v).y};
    const Offset of_q{move(x, y).x - dx, move(x, y).y - dy};
    if (!reachable(of_p) || !reachable(of_q)) continue;
    const int change = cost(x, y, of_p) + cost(u, v, of_q) - cost(x, y, move(x, y)) - cost(u, v, move(u, v));
    if (change > 0) continue;
    move(x, y) = of_p;
    move(u, v) = of_q;
    energy += change;
  }
  return move;
}

// Energy is not all: at one energy, longer moves mix the blocks faster. So the published energy is
// met in two ways, by a tile of short moves (the optimum within radius 3 has just that energy) and by
// one of moves as long as the proven tile's. Against the first the proven tile gains at once, against
// the second as the error settles: what it leaves each frame is smaller, and stays.
constexpr std::int64_t kPublishedEnergy = 10316;

TEST(FlatModel, ProvenTileBeatsThePublishedEnergyOfShortMoves) {
  TemporalTextures short_moves = test::proven_textures();
  const RetargetTile tile = solve_retarget(short_moves.mask, {.step = kStep, .radius = 3});
  EXPECT_LE(tile.energy, kPublishedEnergy);
  EXPECT_GE(tile.energy, kPublishedEnergy * 95 / 100) << "worse than published: the comparison would flatter";
  short_moves.moves = {tile.move};
  EXPECT_LE(frame_8(8, true, test::proven_textures()), frame_8(8, true, short_moves) - 3.0);
}

TEST(FlatModel, ProvenTileBeatsThePublishedEnergyOfLongMoves) {
  TemporalTextures swapped = test::proven_textures();
  swapped.moves = {swapped_tile(swapped.mask, kStep, 6, kPublishedEnergy)};
  swapped.check();
  const std::int64_t energy = retarget_energy(swapped.mask, swapped.moves[0], {.step = kStep});
  EXPECT_LE(energy, kPublishedEnergy);
  EXPECT_GE(energy, kPublishedEnergy * 95 / 100);
  EXPECT_LE(frame_8(8, true, test::proven_textures()), frame_8(8, true, swapped) - 1.0);
  EXPECT_LE(power_at(32, 8, true, test::proven_textures()), power_at(32, 8, true, swapped) - 3.0);
}

}  // namespace
}  // namespace bn
