// Protects: a run behind a window makes the bytes of the command line, however it is paused, stepped and
// watched; what it shows is what the library recomputes; it stops when asked; a refused one says why.
#include "ui/run.h"

#include <gtest/gtest.h>

#include <functional>

#include "bn/error.h"
#include "bn/noise.h"
#include "bn/texture.h"

namespace bn::ui {
namespace {

using LiveRun = Run;  // gtest has a member Run

/// A mask of 64² as 8 bit levels.
Grid<std::int32_t> mask_levels() {
  static const Grid<std::int32_t> levels =
      levels_of_channel(encode_mask(void_and_cluster({.size = {64, 64}}), SampleType::u8), 0).value;
  return levels;
}

RunSetup setup(std::int64_t proposals) {
  RunSetup setup;
  setup.problem.channels = {{mask_levels()}};
  setup.problem.retarget.step = {49, 37};
  setup.options.proposals = proposals;
  return setup;
}

/// Waits up to half a minute: a hang fails, a slow machine does not.
bool wait_until(const std::function<bool()>& holds) {
  for (int i = 0; i < 30'000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}
bool wait_for(LiveRun& run, Phase phase) {
  return wait_until([&] { return run.standing().phase == phase; });
}

void expect_true(LiveRun& run) {
  const auto placement = run.placement();
  ASSERT_TRUE(placement);
  EXPECT_EQ(placement->energy, anneal_energy(run.setup().problem, placement->move));
}

TEST(Run, MakesTheLibrarysBytes) {
  const RunSetup given = setup(20'000'000);
  const AnnealResult expected = anneal_retarget(given.problem, given.options);
  LiveRun run(given);
  while (!run.has_ended()) run.placement();
  EXPECT_EQ(run.standing().phase, Phase::finished);
  EXPECT_EQ(run.result()->tile.move, expected.tile.move);
  EXPECT_EQ(run.placement()->move, expected.tile.move);
  EXPECT_EQ(run.placement()->energy, expected.tile.energy);
  EXPECT_EQ(run.standing().start_energy, expected.tile.start_energy);
  EXPECT_EQ(run.standing().temperatures.start, expected.start_temperature);
  EXPECT_EQ(run.standing().temperatures.end, expected.end_temperature);
  EXPECT_GT(run.trace().size(), 100u);
  expect_true(run);
}

TEST(Run, ShowsEnergiesThatTheLibraryRecomputes) {
  LiveRun run(setup(10'000'000'000));
  std::int64_t seen = -1;
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(wait_until([&] { return run.placement() && run.placement()->proposals > seen; }));
    expect_true(run);
    seen = run.placement()->proposals;
  }
  run.pause();
  ASSERT_TRUE(wait_for(run, Phase::paused));
  expect_true(run);
  EXPECT_EQ(run.placement()->energy, run.standing().state.energy);
  EXPECT_EQ(run.placement()->proposals, run.standing().state.proposals);
}

TEST(Run, PausedSteppedAndWatchedItEndsTheSame) {
  const RunSetup given = setup(40'000'000);
  const AnnealResult expected = anneal_retarget(given.problem, given.options);
  LiveRun run(given, true);
  ASSERT_TRUE(wait_for(run, Phase::paused));
  EXPECT_EQ(run.standing().state.proposals, 0);
  EXPECT_EQ(run.placement()->energy, expected.tile.start_energy);
  for (int i = 0; i < 5; ++i) {
    run.sweep();
    run.sweep();
    run.start();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    run.pause();
    ASSERT_TRUE(wait_until([&] { return run.has_ended() || run.standing().phase == Phase::paused; }));
    expect_true(run);
  }
  run.start();
  ASSERT_TRUE(wait_for(run, Phase::finished));
  EXPECT_EQ(run.result()->tile.move, expected.tile.move);
}

TEST(Run, OneSweepIsOneSweep) {
  const RunSetup given = setup(1'000'000'000);
  Annealing reference(given.problem, given.options);
  LiveRun run(given, true);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(wait_for(run, Phase::paused));
    EXPECT_EQ(run.standing().state.proposals, reference.state().proposals);
    EXPECT_EQ(run.placement()->move, reference.move());
    reference.sweep();
    run.sweep();
    const std::int64_t wanted = reference.state().proposals;
    ASSERT_TRUE(wait_until([&] { return run.standing().state.proposals >= wanted; }));
  }
}

TEST(Run, StopsBeforeItsEndAndKeepsWhatItFound) {
  for (const bool paused : {false, true}) {
    LiveRun run(setup(std::int64_t{1} << 50), paused);
    ASSERT_TRUE(wait_for(run, paused ? Phase::paused : Phase::running));
    run.stop();
    ASSERT_TRUE(wait_for(run, Phase::stopped));
    expect_true(run);
    EXPECT_EQ(run.result()->tile.energy, anneal_energy(run.setup().problem, run.result()->tile.move));
    // Nothing wakes it again.
    run.start();
    run.sweep();
    EXPECT_EQ(run.standing().phase, Phase::stopped);
  }
}

TEST(Run, MayBeLeftAtAnyMoment) {
  for (int i = 0; i < 50; ++i) {
    LiveRun run(setup(1'000'000 << i % 8), i % 3 == 0);
    if (i % 2 == 0) run.sweep();
    if (i % 5 == 0) run.pause();
  }
}

TEST(Run, SaysWhyItIsRefused) {
  RunSetup bad = setup(1000);
  bad.options.end_temperature = -1.0;
  LiveRun run(bad);
  ASSERT_TRUE(wait_for(run, Phase::failed));
  EXPECT_TRUE(run.has_ended());
  EXPECT_EQ(run.standing().error->code, ErrorCode::invalid_input);
  EXPECT_NE(run.standing().error->where.find("temperature"), std::string::npos);
  EXPECT_FALSE(run.placement());
  EXPECT_FALSE(run.result());
}

TEST(Run, AConstantImageEndsAtEnergyZero) {
  RunSetup flat = setup(1'000'000);
  flat.problem.channels = {{Grid<std::int32_t>({16, 16}, 7)}};
  LiveRun run(flat);
  ASSERT_TRUE(wait_for(run, Phase::finished));
  EXPECT_EQ(run.placement()->energy, 0);
  expect_true(run);
}

}  // namespace
}  // namespace bn::ui
