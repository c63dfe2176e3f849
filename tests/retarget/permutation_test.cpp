// Protects: tiles that are no bijection, or out of reach, are refused with the pixel's name; inverses.
#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn/retarget.h"

namespace bn {
namespace {

ErrorCode code_of(const Grid<Offset>& move, const RetargetOptions& options, std::string* where = nullptr) {
  try {
    check_permutation(move, options);
  } catch (const Error& error) {
    if (where) *where = error.info().where;
    return error.code();
  }
  return ErrorCode{0};
}

TEST(Permutation, AcceptsShiftsAndSwaps) {
  Grid<Offset> move({5, 4}, Offset{2, -1});
  RetargetOptions options;
  EXPECT_NO_THROW(check_permutation(move, options));
  options.motion = {8, 5};
  EXPECT_NO_THROW(check_permutation(move, options)) << "-6, -6 from the motion";
  options.motion = {9, 5};
  EXPECT_EQ(code_of(move, options), ErrorCode::verification_failed);
}

TEST(Permutation, NamesTheFirstCollision) {
  Grid<Offset> move({5, 4});
  move(3, 2) = {1, 0};  // lands on (4, 2), whose own seed comes later
  std::string where;
  EXPECT_EQ(code_of(move, {}, &where), ErrorCode::verification_failed);
  EXPECT_EQ(where, "pixel (4, 2)");
  move(4, 2) = {-1, 0};
  EXPECT_NO_THROW(check_permutation(move, {}));
}

TEST(Permutation, ReachAndBorder) {
  Grid<Offset> move({16, 16}, Offset{3, 3});
  RetargetOptions options;
  options.radius = 4;
  EXPECT_NO_THROW(check_permutation(move, options));
  options.reach = Reach::euclidean;
  EXPECT_EQ(code_of(move, options), ErrorCode::verification_failed);
  options.radius = 5;
  EXPECT_NO_THROW(check_permutation(move, options));
  options.wrap = false;
  std::string where;
  EXPECT_EQ(code_of(move, options, &where), ErrorCode::verification_failed);
  EXPECT_EQ(where, "pixel (13, 0)");
  options.motion = {3, 3};
  EXPECT_NO_THROW(check_permutation(move, options)) << "the border bounds R - m";
}

TEST(Permutation, HostileOffsets) {
  Grid<Offset> move({3, 3});
  move(1, 1) = {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
  EXPECT_EQ(code_of(move, {}), ErrorCode::verification_failed);
}

TEST(Permutation, TheInverseUndoesTheMoves) {
  Grid<Offset> move({4, 3});
  move(0, 0) = {1, 0};
  move(1, 0) = {-1, -1};  // to (0, 2)
  move(0, 2) = {0, -2};
  const Grid<Offset> gather = invert_moves(move);
  EXPECT_EQ(gather(1, 0), (Offset{-1, 0}));
  EXPECT_EQ(gather(0, 2), (Offset{1, 1}));
  EXPECT_EQ(gather(0, 0), (Offset{0, 2}));
  EXPECT_EQ(invert_moves(gather), move);
  move(2, 2) = {1, 0};
  EXPECT_THROW(invert_moves(move), Error);
}

}  // namespace
}  // namespace bn
