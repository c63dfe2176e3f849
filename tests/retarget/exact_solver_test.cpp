// Protects: proofs on whole images; the same bytes from every instruction set, thread count and price width;
// hard images; early stops; cancelling; progress.
#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>

#include "bn/error.h"
#include "bn/random.h"
#include "reference.h"
#include "retarget/assignment.h"

namespace bn {
using namespace retarget;
namespace {

const Execution kOneThread{.threads = 1};

/// A stand-in for a mask: every level equally often, at random places.
Grid<std::int32_t> shuffled_levels(Extent size, std::int32_t bound, std::uint64_t seed) {
  Grid<std::int32_t> levels(size);
  const auto count = static_cast<std::int64_t>(levels.count());
  for (std::int64_t i = 0; i < count; ++i)
    levels[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(i * bound / count);
  for (std::size_t i = levels.count() - 1; i > 0; --i) {
    const auto bits = static_cast<std::uint32_t>(random_bits(seed, 3, i));
    std::swap(levels[i], levels[random_below(bits, static_cast<std::uint32_t>(i + 1))]);
  }
  return levels;
}

void expect_proven(const Grid<std::int32_t>& levels, const RetargetOptions& options) {
  const RetargetTile tile = solve_retarget(levels, options, kOneThread);
  EXPECT_TRUE(tile.optimal()) << tile.energy << " above " << tile.lower_bound;
  EXPECT_EQ(tile.energy, retarget_energy(levels, tile.move, options));
  EXPECT_EQ(tile.start_energy, retarget_energy(levels, Grid<Offset>(levels.size(), options.motion), options));
  EXPECT_LE(tile.energy, tile.start_energy);
  EXPECT_NO_THROW(check_permutation(tile.move, options));
}

/// Every combination of the options that choose code paths, at one radius.
std::vector<RetargetOptions> option_spread(int radius) {
  std::vector<RetargetOptions> spread;
  for (const Reach reach : {Reach::chebyshev, Reach::euclidean}) {
    for (const Metric metric : {Metric::l1, Metric::l2}) {
      for (const bool wrapped : {true, false}) {
        spread.push_back({.step = {13, 8},
                          .motion = {-3, 2},
                          .radius = radius,
                          .reach = reach,
                          .metric = metric,
                          .wrap = wrapped});
      }
    }
  }
  return spread;
}

TEST(ExactSolver, EveryInstructionSetGivesTheSameBytes) {
  for (const Extent size : {Extent{24, 20}, Extent{7, 30}}) {
    for (const std::int32_t bound : {256, 65536}) {
      const auto levels = shuffled_levels(size, bound, 5);
      for (const int radius : {1, 6, 9}) {
        for (const RetargetOptions& options : option_spread(radius)) {
          const RetargetTile best = solve_retarget(levels, options, kOneThread);
          EXPECT_TRUE(best.optimal());
          for (const std::string& name : instruction_sets()) {
            use_instruction_set(name);
            const RetargetTile tile = solve_retarget(levels, options, kOneThread);
            EXPECT_EQ(tile.move, best.move) << name;
            EXPECT_EQ(tile.lower_bound, best.lower_bound) << name;
          }
          use_instruction_set("");
        }
      }
    }
  }
}

TEST(ExactSolver, BothPriceWidthsGiveTheSameBytes) {
  const auto levels = shuffled_levels({32, 32}, 256, 6);
  for (const RetargetOptions& options : option_spread(6)) {
    const RetargetTile narrow = solve_with_width(levels, options, kOneThread, PriceWidth::bits32);
    const RetargetTile wide = solve_with_width(levels, options, kOneThread, PriceWidth::bits64);
    EXPECT_EQ(narrow.move, wide.move);
    EXPECT_EQ(narrow.lower_bound, wide.lower_bound);
    EXPECT_TRUE(wide.optimal());
  }
}

TEST(ExactSolver, CostsTooLargeFor32BitsTake64) {
  const auto levels = random_levels({16, 16}, 7, 65536);
  RetargetOptions options{.step = {5, 4}, .metric = Metric::l2};
  EXPECT_THROW(solve_with_width(levels, options, kOneThread, PriceWidth::bits32), Error);
  expect_proven(levels, options);
}

TEST(ExactSolver, PricesThatOutgrowTheirLimitAreNoticed) {
  const auto levels = random_levels({16, 16}, 8, 256);
  const RetargetOptions options{.step = {5, 4}};
  ProgressMeter progress(kOneThread, 1);
  AuctionState<std::int32_t> state(levels, options);
  state.refine(level_scale(options.metric));
  state.price_limit = 64;
  EXPECT_EQ(run_auction(state, 4, kOneThread, progress).outcome, Outcome::overflow);
  AuctionState<std::int32_t> fresh(levels, options);
  fresh.price_limit = 2;
  EXPECT_EQ(complete_by_shortest_paths(fresh, kOneThread), Outcome::overflow);
}

TEST(ExactSolver, TheExactFinishNeedsNoAuction) {
  for (const RetargetOptions& options : option_spread(3)) {
    const auto levels = random_levels({24, 24}, 9, 256);
    AuctionState<std::int32_t> state(levels, options);
    ASSERT_EQ(complete_by_shortest_paths(state, kOneThread), Outcome::done);
    const std::int64_t energy = retarget_energy(levels, state.moves(options), options);
    EXPECT_EQ(energy, certified_lower_bound(levels, options, state.pixel_prices(), 0));
    EXPECT_EQ(energy, solve_retarget(levels, options, kOneThread).energy);
  }
}

TEST(ExactSolver, AnyPricesGiveABound) {
  const auto levels = random_levels({16, 12}, 10, 256);
  for (const RetargetOptions& options : option_spread(4)) {
    const std::int64_t optimum = solve_retarget(levels, options, kOneThread).energy;
    std::vector<std::int64_t> price(levels.count());
    for (std::size_t i = 0; i < price.size(); ++i)
      price[i] = static_cast<std::int64_t>(random_bits(11, 4, i) % 200);
    EXPECT_LE(certified_lower_bound(levels, options, price, 0), optimum);
    EXPECT_LE(certified_lower_bound(levels, options, price, 4), optimum);
    // Prices may be anything, also large: adding a constant to all changes nothing.
    const std::int64_t bound = certified_lower_bound(levels, options, price, 0);
    for (std::int64_t& p : price) p += std::int64_t{1} << 58;
    EXPECT_EQ(certified_lower_bound(levels, options, price, 0), bound);
  }
}

Grid<std::int32_t> drawn(Extent size, std::int32_t (*level)(int x, int y)) {
  Grid<std::int32_t> levels(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) levels(x, y) = level(x, y);
  }
  return levels;
}

TEST(ExactSolver, HardImages) {
  const Extent size{40, 36};
  const std::vector<Grid<std::int32_t>> images = {
      drawn(size, [](int, int) { return 7; }),
      drawn(size, [](int x, int) { return x < 20 ? 0 : 255; }),
      drawn(size, [](int x, int y) { return (x / 4 + y / 4) % 2 * 255; }),
      drawn(size, [](int x, int) { return x * 6; }),
      drawn(size, [](int x, int y) { return (x * x + 3 * y * y) % 65536; }),
      drawn(size, [](int x, int y) { return x == 3 && y == 5 ? 65535 : 0; }),
      random_levels(size, 12, 2),
      Grid<std::int32_t>(size, (1 << 24) - 1),
      random_levels(size, 13, 1 << 24),
  };
  for (const auto& levels : images) {
    for (RetargetOptions options : option_spread(6)) expect_proven(levels, options);
  }
}

TEST(ExactSolver, StepsThatAreNoStepNeedNoMove) {
  const auto levels = shuffled_levels({16, 24}, 256, 14);
  for (const Offset step : {Offset{0, 0}, Offset{16, -24}, Offset{-1600, 2400}}) {
    const RetargetTile tile = solve_retarget(levels, {.step = step}, kOneThread);
    EXPECT_EQ(tile.start_energy, 0);
    EXPECT_EQ(tile.energy, 0);
    EXPECT_EQ(tile.lower_bound, 0);
  }
}

TEST(ExactSolver, OffsetsAreTheNearestOfTheirPixel) {
  for (const Extent size : {Extent{3, 3}, Extent{4, 5}, Extent{1, 12}, Extent{8, 2}}) {
    const RetargetOptions options{.step = {1, 1}, .motion = {5, -3}, .radius = 6};
    const RetargetTile tile = solve_retarget(random_levels(size, 15, 256), options, kOneThread);
    for (const Offset& move : tile.move) {
      const Offset k{move.x - options.motion.x, move.y - options.motion.y};
      EXPECT_EQ(k, (Offset{wrap_centred(k.x, size.width), wrap_centred(k.y, size.height)}));
    }
  }
}

TEST(ExactSolver, EarlyStopsKeepTheirPromise) {
  const auto levels = shuffled_levels({48, 48}, 65536, 16);
  RetargetOptions options{.step = {36, 27}};
  const std::int64_t optimum = solve_retarget(levels, options, kOneThread).energy;
  for (const double gap : {0.9, 0.2, 0.05, 0.005, 1e-9}) {
    options.gap = gap;
    const RetargetTile tile = solve_retarget(levels, options, kOneThread);
    EXPECT_LE(tile.lower_bound, optimum);
    EXPECT_GE(tile.energy, optimum);
    EXPECT_LE(static_cast<double>(tile.energy - tile.lower_bound),
              gap * static_cast<double>(tile.lower_bound));
    EXPECT_NO_THROW(check_permutation(tile.move, options));
    EXPECT_TRUE(gap < 0.9 || !tile.optimal()) << "stopped early";
  }
}

TEST(ExactSolver, ThreadsChangeNoByteOfAMotionSet) {
  const auto levels = shuffled_levels({20, 16}, 256, 17);
  const RetargetOptions options{.step = {15, 9}, .motion = {99, 99}};  // ignored
  const auto tiles = solve_motion_set(levels, options, 2, kOneThread);
  ASSERT_EQ(tiles.size(), 25u);
  for (int i = 0; i < 25; ++i) {
    RetargetOptions variant = options;
    variant.motion = {i % 5 - 2, i / 5 - 2};
    const RetargetTile tile = solve_retarget(levels, variant, kOneThread);
    EXPECT_EQ(tiles[static_cast<std::size_t>(i)].move, tile.move);
    EXPECT_TRUE(tiles[static_cast<std::size_t>(i)].optimal());
  }
  for (const int threads : {2, 3, 7}) {
    const auto again = solve_motion_set(levels, options, 2, {.threads = threads});
    for (std::size_t i = 0; i < tiles.size(); ++i) EXPECT_EQ(again[i].move, tiles[i].move);
  }
  EXPECT_EQ(solve_motion_set(levels, options, 0, kOneThread).size(), 1u);
}

TEST(ExactSolver, LargestMotionsAndRadii) {
  const auto levels = shuffled_levels({24, 24}, 256, 18);
  expect_proven(levels, {.step = {18, 13}, .motion = {8, -8}, .radius = 32});
  expect_proven(levels, {.step = {18, 13}, .motion = {-95, 95}, .radius = 32, .wrap = false});
  expect_proven(levels, {.step = {18, 13}, .motion = {126, -126}, .radius = 1});
}

TEST(ExactSolver, StopsWhenAsked) {
  const auto levels = shuffled_levels({128, 128}, 65536, 19);
  std::stop_source source;
  source.request_stop();
  const auto code = [&](const Execution& execution) {
    try {
      solve_motion_set(levels, {.step = {97, 73}}, 1, execution);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode{0};
  };
  EXPECT_EQ(code({.threads = 2, .stop = source.get_token()}), ErrorCode::cancelled);
  std::stop_source later;
  EXPECT_EQ(
      code({.threads = 1, .stop = later.get_token(), .progress = [&](double) { later.request_stop(); }}),
      ErrorCode::cancelled);
}

TEST(ExactSolver, ProgressRisesToOne) {
  std::vector<double> reports;
  const auto note = [&](double done) { reports.push_back(done); };
  solve_retarget(shuffled_levels({64, 64}, 65536, 20), {.step = {48, 37}}, {.threads = 1, .progress = note});
  ASSERT_GT(reports.size(), 2u);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_EQ(reports.back(), 1.0);
}

// The bytes themselves: a change of any is a new kExactRetargetVersion.
TEST(ExactSolver, GoldenBytes) {
  const auto hash = [](const Grid<Offset>& move) {
    std::uint64_t h = 0xcbf29ce484222325;
    for (const Offset& r : move)
      h = ((h ^ static_cast<std::uint64_t>(r.x + 128)) * 0x100000001b3 ^
           static_cast<std::uint64_t>(r.y + 128)) *
          0x100000001b3;
    return h;
  };
  const auto levels = shuffled_levels({96, 80}, 256, 21);
  EXPECT_EQ(hash(solve_retarget(levels, {.step = {71, 45}}, kOneThread).move), 8124713788109302565u);
  EXPECT_EQ(
      hash(solve_retarget(levels, {.step = {71, 45}, .metric = Metric::l2, .wrap = false}, kOneThread).move),
      148627514260141789u);
}

}  // namespace
}  // namespace bn
