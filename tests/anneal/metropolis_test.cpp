// Protects: the acceptance rule's logarithm is as accurate as stated, and thresholds lie where kernels assume.
#include "anneal/metropolis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bn {
using namespace anneal;
namespace {

TEST(Metropolis, ThresholdsLieBetweenZeroAndThatOfBitsZero) {
  // So bits need not be drawn for a change that is no rise, nor for one above the threshold of bits 0.
  const float most = minus_log(0);
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 512) {
    const float log = minus_log(static_cast<std::uint32_t>(bits));
    ASSERT_GE(log, 0.0f);
    ASSERT_LE(log, most);
  }
}

TEST(Metropolis, TheLogarithmIsAsAccurateAsStated) {
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 0x1357) {
    const double u = (static_cast<double>(bits >> 9) + 0.5) * 0x1p-23;
    EXPECT_NEAR(minus_log(static_cast<std::uint32_t>(bits)), -std::log(u), 3e-6);
  }
  for (std::uint32_t bits = 0; bits < 100000; bits += 512) {
    const double u = (static_cast<double>(bits >> 9) + 0.5) * 0x1p-23;
    EXPECT_NEAR(minus_log(bits), -std::log(u), 3e-6);
    EXPECT_LE(metropolis_threshold(bits, 5.0f), metropolis_threshold(0, 5.0f));
  }
}

}  // namespace
}  // namespace bn
