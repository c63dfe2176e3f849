// Protects: the curve visits every cell once, from neighbour to neighbour, and its inverse finds the way
// back.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "bn/random.h"
#include "bn/space_filling_curve.h"

namespace bn {
namespace {

static_assert(hilbert_cell(0, 2) == CurveCell{0, 0});
static_assert(hilbert_place(hilbert_cell(123456789, 3), 3) == 123456789);

class Curve : public testing::TestWithParam<int> {
 protected:
  int dimensions = GetParam();
  std::uint64_t places = std::uint64_t{1} << (dimensions * curve_bits(dimensions));
};
INSTANTIATE_TEST_SUITE_P(Dimensions, Curve, testing::Values(1, 2, 3, 4));

void expect_step(std::uint32_t place, int dimensions) {
  const CurveCell a = hilbert_cell(place, dimensions);
  const CurveCell b = hilbert_cell(place + 1, dimensions);
  std::int64_t distance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) distance += std::abs(std::int64_t{a[i]} - std::int64_t{b[i]});
  ASSERT_EQ(distance, 1) << place;
  ASSERT_EQ(hilbert_place(a, dimensions), place);
}

TEST_P(Curve, GoesToNeighboursAndBack) {
  for (std::uint32_t place = 0; place < 100000; ++place) expect_step(place, dimensions);
  for (std::uint64_t i = 0; i < 100000; ++i) {
    expect_step(static_cast<std::uint32_t>(random_bits(1, 0, i) % (places - 1)), dimensions);
  }
  // Where the curve goes from one half, or quarter, to the next.
  for (std::uint64_t part = 1; part < 64; ++part) {
    expect_step(static_cast<std::uint32_t>(places / 64 * part - 1), dimensions);
  }
}

TEST_P(Curve, FillsEachCellOfACoarserGridAtOnce) {
  // Of the first levels, enumerated: each of 2^dimensions^2 cells takes one stretch.
  const int levels = 2;
  const int cells = 1 << (levels * dimensions);
  std::vector<int> met(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) {
    const auto place = static_cast<std::uint32_t>(places / static_cast<std::uint64_t>(cells) *
                                                  static_cast<std::uint64_t>(i));
    std::size_t coarse = 0;
    for (int k = 0; k < dimensions; ++k) {
      coarse = coarse << levels | hilbert_cell(place, dimensions)[static_cast<std::size_t>(k)] >>
                                      (curve_bits(dimensions) - levels);
    }
    ++met[coarse];
  }
  EXPECT_EQ(met, std::vector<int>(met.size(), 1));
}

}  // namespace
}  // namespace bn
