// Protects: Philox is the published one (known answers of the Random123 distribution), and bounded
// draws are uniform.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "bn/random.h"

namespace bn {
namespace {

using Counter = std::array<std::uint32_t, 4>;

TEST(Philox, KnownAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Counter{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
            (Counter{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(philox({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
            (Counter{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(RandomBelow, IsUniformByChiSquare) {
  // 7 cells, 70,000 draws, 6 degrees of freedom: 22.46 is the 99.9 % quantile. The seed is fixed, so
  // this either always passes or always fails.
  constexpr int kCells = 7, kDraws = 70000;
  std::array<int, kCells> counts{};
  for (int i = 0; i < kDraws; ++i) {
    const auto bits = static_cast<std::uint32_t>(random_bits(1, 0, static_cast<std::uint64_t>(i)));
    const std::uint32_t draw = random_below(bits, kCells);
    ASSERT_LT(draw, std::uint32_t{kCells});
    ++counts[draw];
  }
  double chi_square = 0.0;
  for (const int count : counts) {
    const double excess = count - double{kDraws} / kCells;
    chi_square += excess * excess / (double{kDraws} / kCells);
  }
  EXPECT_LT(chi_square, 22.46);
}

TEST(RandomBits, SeedStreamAndIndexAllMatter) {
  EXPECT_NE(random_bits(1, 0, 0), random_bits(2, 0, 0));
  EXPECT_NE(random_bits(1, 0, 0), random_bits(1, 1, 0));
  EXPECT_NE(random_bits(1, 0, 0), random_bits(1, 0, 1));
  EXPECT_NE(random_bits(1, 0, 0), random_bits(1, 0, std::uint64_t{1} << 32));
  EXPECT_NE(random_bits(1, 0, 0), random_bits(std::uint64_t{1} << 32 | 1, 0, 0));
}

}  // namespace
}  // namespace bn
