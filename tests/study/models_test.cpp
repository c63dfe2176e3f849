// Protects: what the textures are for. On the flat picture, sorting and a proven retarget tile reach
// their figures of low-frequency power, and beat tiles of the published energy.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bn_study/models.h"
#include "render/test_textures.h"

namespace bn {
namespace {

using test::kStep;

/// Power in dB at frame `frame`, the mean over four sets of seeds: one run scatters by about 0.3 dB.
double power_at(int frame, int block, bool retarget, const TemporalTextures& textures) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    sum += run_flat_model({.block = block, .retarget = retarget, .frames = frame, .seed = seed}, textures)
               .power_db.back();
  }
  return sum / 4.0;
}

double frame_8(int block, bool retarget, const TemporalTextures& textures) {
  return power_at(8, block, retarget, textures);
}

TEST(FlatModel, FirstFrameIsWhiteNoise) {
  const auto power = run_flat_model({.frames = 0}, test::proven_textures()).power_db;
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

// Energy is not all: at one energy, longer moves mix the blocks faster. So the published energy is
// met in two ways, by a tile of short moves (the optimum within radius 3 has just that energy) and by
// one of moves as long as the proven tile's. Against the first the proven tile gains at once, against
// the second as the error settles: what it leaves each frame is smaller, and stays.
constexpr std::int64_t kPublishedEnergy = 10316;

TEST(FlatModel, ProvenTileBeatsThePublishedEnergyOfShortMoves) {
  TemporalTextures short_moves = test::proven_textures();
  const RetargetTile tile = solve_retarget(short_moves.mask(0), {.step = kStep, .radius = 3});
  EXPECT_LE(tile.energy, kPublishedEnergy);
  EXPECT_GE(tile.energy, kPublishedEnergy * 95 / 100) << "worse than published: the comparison would flatter";
  short_moves.moves = {tile.move};
  EXPECT_LE(frame_8(8, true, test::proven_textures()), frame_8(8, true, short_moves) - 3.0);
}

TEST(FlatModel, ProvenTileBeatsThePublishedEnergyOfLongMoves) {
  TemporalTextures swapped = test::proven_textures();
  swapped.moves = {swapped_tile(swapped.mask(0), kStep, 6, kPublishedEnergy, 1)};
  swapped.check();
  const std::int64_t energy = retarget_energy(swapped.mask(0), swapped.moves[0], {.step = kStep});
  EXPECT_LE(energy, kPublishedEnergy);
  EXPECT_GE(energy, kPublishedEnergy * 95 / 100);
  EXPECT_LE(frame_8(8, true, test::proven_textures()), frame_8(8, true, swapped) - 1.0);
  EXPECT_LE(power_at(32, 8, true, test::proven_textures()), power_at(32, 8, true, swapped) - 3.0);
}

// The comparison that counts: the tiles to be had then, annealed within radius 6 to the published energy, and
// those to be had now. A proven tile may reach further, at no cost to the renderer.
TEST(FlatModel, AProvenTileOfRadiusTenBeatsThePublishedOneByThreeDecibels) {
  TemporalTextures published = test::proven_textures();
  published.moves = {swapped_tile(published.mask(0), kStep, 6, 9444, 2)};
  TemporalTextures proven = test::proven_textures();
  proven.moves = {solve_retarget(proven.mask(0), {.step = kStep, .radius = 10}).move};
  EXPECT_LE(frame_8(8, true, proven), frame_8(8, true, published) - 3.0);
}

// A stack with blue series against one mask that moves, at equal radius: each pixel's average over frames is
// far better, the blurred one somewhat; the single frame is no better, and later worse.
TEST(FlatModel, AStackBeatsTheMovedMaskInTheAverageAndNotInTheFrame) {
  TemporalTextures both = make_preset_textures(SpatiotemporalPreset::both);
  solve_moves(both, 6);
  double averaged = 0.0, blurred = 0.0, frame_8 = 0.0, frame_64 = 0.0;  // against the moved mask, dB
  for (const std::uint64_t seed : {1, 2}) {
    const FlatModel model{.block = 16, .frames = 64, .seed = seed};
    const FlatRun stack = run_flat_model(model, both), moved = run_flat_model(model, test::proven_textures());
    averaged += (stack.averaged_db.back() - moved.averaged_db.back()) / 2;
    blurred += (stack.averaged_blurred_db.back() - moved.averaged_blurred_db.back()) / 2;
    frame_8 += (stack.power_db[8] - moved.power_db[8]) / 2;
    frame_64 += (stack.power_db.back() - moved.power_db.back()) / 2;
  }
  EXPECT_LE(averaged, -9.0);
  EXPECT_LE(blurred, -2.0);
  EXPECT_NEAR(frame_8, 0.5, 1.0);
  EXPECT_GE(frame_64, 4.0);
}

// The first frame is white noise, and so is the average at first: all of it, then less than white noise's.
TEST(FlatModel, AveragesAreHeldAgainstWhiteNoise) {
  const FlatRun run = run_flat_model({.frames = 0}, test::proven_textures());
  EXPECT_EQ(run.averaged_db, std::vector{0.0});
  EXPECT_EQ(run.averaged_blurred_db, std::vector{0.0});
}

double poster_db(PosterModel model, const TemporalTextures& textures) {
  double sum = 0.0;
  for (model.seed = 1; model.seed <= 3; ++model.seed) {
    const PosterRun run = run_poster_model(model, textures);
    for (int frame = 8; frame <= 16; ++frame) sum += run.power_db[static_cast<std::size_t>(frame)] / 27.0;
  }
  return sum;
}

// Why reprojection gains nothing in a slow pan: the tile's own moves, 4.7 pixels in the mean, carry as many
// seeds over edges as the pan does.
TEST(PosterModel, ASlowPanCarriesNoMoreSeedsOverEdgesThanTheTileDoes) {
  TemporalTextures textures = test::proven_textures();
  textures.motion_range = 1;
  textures.moves.clear();
  for (RetargetTile& tile : solve_motion_set(textures.mask(0), {.step = kStep}, 1, {.threads = 1}))
    textures.moves.push_back(std::move(tile.move));
  const PosterModel plain{.pan_px = 1.25};
  PosterModel reprojected = plain;
  reprojected.reproject = true;
  EXPECT_NEAR(run_poster_model(plain, textures).crossing, run_poster_model(reprojected, textures).crossing,
              0.02);
  const double plain_db = poster_db(plain, textures);
  EXPECT_NEAR(poster_db(reprojected, textures), plain_db, 1.0);
  // What the edge breaks is the sort.
  PosterModel by_light = plain;
  by_light.sort_by_light = true;
  EXPECT_LE(poster_db(by_light, textures), plain_db - 3.0);
  // At rest the two are one.
  EXPECT_EQ(run_poster_model({.reproject = true}, textures).power_db,
            run_poster_model({}, textures).power_db);
}

TEST(PosterModel, FirstFrameIsWhiteNoise) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    sum += run_poster_model({.frames = 0, .seed = seed}, test::proven_textures()).power_db[0];
  EXPECT_NEAR(sum / 20.0, 0.0,
              0.4);  // about 470 frequencies a run, half of them independent under the window
}

}  // namespace
}  // namespace bn
