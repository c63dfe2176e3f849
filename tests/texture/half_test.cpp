// Protects: no value that a half float holds is lost, rounding is to the nearest and to even, and what would
// become infinite is refused.
#include "texture/half.h"

#include <bit>
#include <cmath>
#include <limits>

#include "texture/fixtures.h"

namespace bn::texture {
namespace {

/// The value by its definition, in doubles.
double defined_value(unsigned bits) {
  const double sign = (bits & 0x8000) != 0 ? -1.0 : 1.0;
  const int exponent = static_cast<int>(bits >> 10 & 31);
  const double significand = bits & 0x3ff;
  if (exponent == 0) return sign * std::ldexp(significand, -24);
  return sign * std::ldexp(1024.0 + significand, exponent - 25);
}

TEST(Half, EveryHalfFloatIsWidenedExactlyAndComesBackBitByBit) {
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const float wide = half_value(half);
    ASSERT_EQ(half_bits(wide), half) << bits;
    if (is_finite_half(half)) {
      ASSERT_EQ(static_cast<double>(wide), defined_value(bits)) << bits;
      ASSERT_EQ(half_bits(static_cast<double>(wide)), half) << bits;
    } else {
      ASSERT_EQ(std::isnan(wide), (bits & 0x3ff) != 0);
      ASSERT_EQ(std::signbit(wide), (bits & 0x8000) != 0);
    }
  }
}

TEST(Half, BetweenTwoNeighboursTheNearerOneIsTakenAndOfTheMiddleTheEvenOne) {
  for (unsigned bits = 0; bits + 1 < kHalfInfinity; ++bits) {
    const double low = defined_value(bits), high = defined_value(bits + 1);
    const double middle = (low + high) / 2;
    const unsigned even = bits % 2 == 0 ? bits : bits + 1;
    ASSERT_EQ(half_bits(middle), even) << bits;
    ASSERT_EQ(half_bits(std::nextafter(middle, low)), bits) << bits;
    ASSERT_EQ(half_bits(std::nextafter(middle, high)), bits + 1) << bits;
    ASSERT_EQ(half_bits(-middle), even | 0x8000) << bits;
    ASSERT_EQ(half_bits(static_cast<float>(middle)), even) << "the middle is a float too";
  }
}

TEST(Half, Extremes) {
  EXPECT_EQ(half_bits(65504.0), 0x7bff);
  EXPECT_EQ(half_bits(std::nextafter(65520.0, 0.0)), 0x7bff);
  EXPECT_EQ(half_bits(65520.0), kHalfInfinity);
  EXPECT_EQ(half_bits(1e300), kHalfInfinity);
  EXPECT_EQ(half_bits(-1e300), 0x8000 | kHalfInfinity);
  EXPECT_EQ(half_bits(std::numeric_limits<double>::denorm_min()), 0);
  EXPECT_EQ(half_bits(-0.0), 0x8000);
  EXPECT_TRUE(std::isnan(half_value(half_bits(std::numeric_limits<double>::quiet_NaN()))));
  // A NaN whose bits are all among those that are cut off is still a NaN.
  EXPECT_TRUE(std::isnan(half_value(half_bits(std::bit_cast<float>(0x7f800001u)))));
}

TEST(Half, ImagesAreConvertedThereAndBack) {
  const Image half = random_image({7, 5, 2}, 3, SampleType::f16);
  const Image wide = to_float(half);
  EXPECT_EQ(wide.type, SampleType::f32);
  EXPECT_EQ(wide.depth, 2);
  EXPECT_TRUE(same_picture(to_half(wide), half));
}

TEST(Half, WhatWouldBecomeInfiniteIsRefused) {
  const auto image = [](float value) { return image_of<float>({2, 1}, 1, SampleType::f32, {0.5f, value}); };
  const auto error = error_of([&] { to_half(image(65520.0f)); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::invalid_input);
  EXPECT_NE(error->what.find("sample 1 is 65520"), std::string::npos) << error->what;
  EXPECT_NO_THROW(to_half(image(65519.0f)));
  EXPECT_NO_THROW(to_half(image(std::numeric_limits<float>::infinity())));
  EXPECT_NO_THROW(to_half(image(std::numeric_limits<float>::quiet_NaN())));
  expect_error(ErrorCode::invalid_input, [] { to_half(random_image({2, 2}, 1, SampleType::u8)); });
  expect_error(ErrorCode::invalid_input, [] { to_float(random_image({2, 2}, 1, SampleType::f32)); });
}

TEST(Half, AMaskOfHalfFloatsIsKnownAsSuch) {
  Grid<std::uint32_t> rank({64, 64});
  for (std::size_t i = 0; i < rank.count(); ++i) rank[i] = static_cast<std::uint32_t>(i * 2731 % 4096);
  const Image mask = encode_mask(rank, SampleType::f16);
  for (std::size_t i = 0; i < rank.count(); ++i) {
    EXPECT_EQ(samples_of<std::uint16_t>(mask)[i], half_bits((rank[i] + 0.5) / 4096));
  }
  EXPECT_TRUE(levels_of_channel(mask, 0).is_permutation);
  Image flat = mask;
  flat.samples.assign(flat.samples.size(), std::byte{0});
  EXPECT_FALSE(levels_of_channel(flat, 0).is_permutation);
  const ChannelSamples samples = samples_of_channel(mask, 0);
  EXPECT_EQ(samples.low, 0.0);
  EXPECT_EQ(samples.high, 1.0);
}

}  // namespace
}  // namespace bn::texture
