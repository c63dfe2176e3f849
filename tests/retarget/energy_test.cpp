// Protects: the energy's definition, by hand, and the options' ranges.
#include <gtest/gtest.h>

#include <limits>

#include "bn/error.h"
#include "bn/retarget.h"

namespace bn {
namespace {

TEST(RetargetEnergy, ByHand) {
  Grid<std::int32_t> levels({3, 1});
  levels[0] = 1, levels[1] = 5, levels[2] = 20;
  RetargetOptions options;
  options.step = {1, 0};
  Grid<Offset> move({3, 1});
  EXPECT_EQ(retarget_energy(levels, move, options), 4 + 15 + 19);
  options.metric = Metric::l2;
  EXPECT_EQ(retarget_energy(levels, move, options), 16 + 225 + 361);
  move = Grid<Offset>({3, 1}, Offset{-1, 0});  // undoes the step
  EXPECT_EQ(retarget_energy(levels, move, options), 0);
  options.step = {-300000001, 7};  // -1 modulo 3
  options.metric = Metric::l1;
  EXPECT_EQ(retarget_energy(levels, Grid<Offset>({3, 1}), options), 19 + 4 + 15);
}

ErrorCode solve_code(const Grid<std::int32_t>& levels, const RetargetOptions& options,
                     const Execution& execution = {}) {
  try {
    solve_retarget(levels, options, execution);
  } catch (const Error& error) {
    EXPECT_FALSE(error.info().what.empty());
    return error.code();
  }
  return ErrorCode{0};
}

TEST(RetargetOptions, OutOfRangeIsRefusedBeforeTheWork) {
  const Grid<std::int32_t> levels({4, 4}, 7);
  const auto with = [](auto change) {
    RetargetOptions options;
    change(options);
    return options;
  };
  using O = RetargetOptions;
  for (const auto& bad : {
           with([](O& o) { o.radius = 0; }),
           with([](O& o) { o.radius = 33; }),
           with([](O& o) {
             o.motion = {122, 0};
           }),
           with([](O& o) {
             o.motion = {0, -122};
           }),
           with([](O& o) {
             o.motion = {std::numeric_limits<int>::min(), 0};
           }),
           with([](O& o) { o.gap = -0.1; }),
           with([](O& o) { o.gap = 1.0; }),
           with([](O& o) { o.gap = std::numeric_limits<double>::quiet_NaN(); }),
           with([](O& o) { o.metric = Metric{7}; }),
           with([](O& o) { o.reach = Reach{7}; }),
       }) {
    EXPECT_EQ(solve_code(levels, bad), ErrorCode::invalid_input);
    EXPECT_THROW(retarget_energy(levels, Grid<Offset>({4, 4}), bad), Error);
  }
  EXPECT_EQ(solve_code(levels, with([](O& o) { o.motion = {121, -121}; })), ErrorCode{0});
  EXPECT_EQ(solve_code(Grid<std::int32_t>({4, 4}, -1), {}), ErrorCode::invalid_input);
  EXPECT_EQ(solve_code(Grid<std::int32_t>({4, 4}, 1 << 24), {}), ErrorCode::invalid_input);
  EXPECT_EQ(solve_code(Grid<std::int32_t>(), {}), ErrorCode::invalid_input);
  EXPECT_EQ(solve_code(Grid<std::int32_t>({0, 4}), {}), ErrorCode::invalid_input);
  EXPECT_EQ(solve_code(levels, {}, {.threads = -1}), ErrorCode::invalid_input);
  EXPECT_EQ(solve_code(Grid<std::int32_t>({256, 256}), {}, {.memory_limit_bytes = 1 << 20}),
            ErrorCode::over_limit);
  EXPECT_THROW(retarget_energy(levels, Grid<Offset>({4, 5}), {}), Error);
  for (const int range : {-1, 9}) EXPECT_THROW(solve_motion_set(levels, {}, range), Error);
  RetargetOptions far;
  far.gap = 2.0;
  EXPECT_THROW(solve_motion_set(levels, far, 1), Error);
}

TEST(RetargetOptions, EnergiesBeyond62BitsAreRefused) {
  Grid<std::int32_t> levels({256, 128}, 0);
  levels[0] = (1 << 24) - 1;
  RetargetOptions options;
  options.metric = Metric::l2;
  EXPECT_EQ(solve_code(levels, options), ErrorCode::over_limit);
}

}  // namespace
}  // namespace bn
