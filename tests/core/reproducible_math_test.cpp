// Protects: e^x is accurate to its stated bound, and its bits are these on every machine.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/reproducible_math.h"

namespace bn {
namespace {

TEST(ReproducibleExp, WithinTwoUlpOfLongDouble) {
  for (double x = -700.0; x <= 700.0; x += 0.0137) {
    const double ours = reproducible_exp(x);
    const long double exact = std::exp(static_cast<long double>(x));
    const double ulp = std::nextafter(ours, INFINITY) - ours;
    EXPECT_LE(std::fabs(static_cast<double>(ours - exact)), 2.0 * ulp) << x;
  }
}

TEST(ReproducibleExp, Limits) {
  EXPECT_EQ(reproducible_exp(0.0), 1.0);
  EXPECT_EQ(reproducible_exp(-1e9), 0.0);
  EXPECT_EQ(reproducible_exp(-INFINITY), 0.0);
  EXPECT_EQ(reproducible_exp(1e9), reproducible_exp(700.0));
}

TEST(ReproducibleExp, GoldenBits) {
  // A checksum over the bits: any reordering, contraction or library call in there changes it.
  std::uint64_t hash = 0;
  for (int i = 0; i < 10000; ++i) {
    hash = hash * 6364136223846793005u + std::bit_cast<std::uint64_t>(reproducible_exp(-0.01 * i));
  }
  EXPECT_EQ(hash, 15416344994821772451u);
}

}  // namespace
}  // namespace bn
