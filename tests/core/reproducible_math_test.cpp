// Protects: e^x, ln x, cosine and sine are accurate to their stated bounds, and their bits are these on every
// machine.
#include <gtest/gtest.h>

#include <algorithm>
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

TEST(ReproducibleLog, WithinFourUlpOfLongDouble) {
  for (double exponent = -1021.0; exponent <= 1023.0; exponent += 0.0137) {
    const double x = std::exp2(exponent);
    const double ours = reproducible_log(x);
    const long double exact = std::log(static_cast<long double>(x));
    const double ulp = std::nextafter(std::fabs(ours), INFINITY) - std::fabs(ours);
    EXPECT_LE(std::fabs(static_cast<double>(ours - exact)), std::max(4.0 * ulp, 0x1p-53)) << x;
  }
  for (double x = 0.5; x <= 2.0; x += 1e-5) {
    const double exact = static_cast<double>(std::log(static_cast<long double>(x)));
    EXPECT_NEAR(reproducible_log(x), exact, std::max(0x1p-53, 4.0 * std::fabs(exact) * 0x1p-52)) << x;
  }
}

TEST(ReproducibleLog, Limits) {
  EXPECT_EQ(reproducible_log(1.0), 0.0);
  EXPECT_EQ(reproducible_log(0.0), reproducible_log(0x1p-1022));
}

TEST(ReproducibleLog, GoldenBits) {
  std::uint64_t hash = 0;
  for (int i = 1; i <= 10000; ++i) {
    hash = hash * 6364136223846793005u + std::bit_cast<std::uint64_t>(reproducible_log(0.01 * i));
  }
  EXPECT_EQ(hash, 9432366938592272686u);
}

TEST(ReproducibleTurn, WithinItsBoundOfLongDouble) {
  for (int i = 0; i <= 100000; ++i) {
    const double turns = i / 100000.0;
    const long double angle = 2.0L * 3.14159265358979323846264338327950288L * turns;
    const auto [cosine, sine] = reproducible_turn(turns);
    ASSERT_NEAR(cosine, static_cast<double>(std::cos(angle)), 0x1p-52) << turns;
    ASSERT_NEAR(sine, static_cast<double>(std::sin(angle)), 0x1p-52) << turns;
  }
}

TEST(ReproducibleTurn, ExactAtQuarters) {
  const double cosines[] = {1, 0, -1, 0, 1};
  const double sines[] = {0, 1, 0, -1, 0};
  for (int quarter = 0; quarter <= 4; ++quarter) {
    EXPECT_EQ(reproducible_turn(quarter / 4.0).cosine, cosines[quarter]);
    EXPECT_EQ(reproducible_turn(quarter / 4.0).sine, sines[quarter]);
  }
}

TEST(ReproducibleTurn, GoldenBits) {
  std::uint64_t hash = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto [cosine, sine] = reproducible_turn(i / 10000.0);
    hash = hash * 6364136223846793005u + std::bit_cast<std::uint64_t>(cosine);
    hash = hash * 6364136223846793005u + std::bit_cast<std::uint64_t>(sine);
  }
  EXPECT_EQ(hash, 2035550970344375984u);
}

}  // namespace
}  // namespace bn
