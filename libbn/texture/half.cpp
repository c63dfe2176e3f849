// Half floats, on integers: the result depends on no rounding mode and no instruction of the processor.
//
// A half float has a sign, 5 bits of exponent (bias 15) and 10 of significand. Exponent 0 means zero and
// subnormal values, multiples of 2^-24; exponent 31 means infinity and NaN.

#include "texture/half.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "bn/texture.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn {
namespace texture {
namespace {

constexpr int kSignificandBits = 10, kDoubleBits = 52;
constexpr int kLeastExponent = -14, kGreatestExponent = 15;

/// value / 2^shift as an integer, ties to even. 1 <= shift <= 63.
std::uint64_t rounded_shift(std::uint64_t value, int shift) {
  const std::uint64_t quotient = value >> shift;
  const std::uint64_t rest = value & ((std::uint64_t{1} << shift) - 1);
  const std::uint64_t half = std::uint64_t{1} << (shift - 1);
  const bool up = rest > half || (rest == half && (quotient & 1) != 0);
  return quotient + (up ? 1 : 0);
}

}  // namespace

std::uint16_t half_bits(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 48 & 0x8000);
  if (std::isnan(value)) return static_cast<std::uint16_t>(sign | kHalfInfinity | 0x200);
  if (std::isinf(value)) return static_cast<std::uint16_t>(sign | kHalfInfinity);
  const int exponent = static_cast<int>(bits >> kDoubleBits & 0x7ff) - 1023;
  if (exponent > kGreatestExponent) return static_cast<std::uint16_t>(sign | kHalfInfinity);
  // Less than a half of the least subnormal one; among them are all subnormal doubles.
  if (exponent < kLeastExponent - kSignificandBits - 1) return sign;
  const std::uint64_t significand = (bits & ((std::uint64_t{1} << kDoubleBits) - 1)) | std::uint64_t{1}
                                                                                           << kDoubleBits;
  const int below = exponent < kLeastExponent ? kLeastExponent - exponent : 0;
  const std::uint64_t rounded = rounded_shift(significand, kDoubleBits - kSignificandBits + below);
  // The leading 1 of a normal significand adds one to the exponent field; a carry out of the significand adds
  // another, up to infinity, which is what rounding asks for.
  const int field = below > 0 ? 0 : exponent - kLeastExponent;
  return static_cast<std::uint16_t>(sign + (static_cast<std::uint64_t>(field) << kSignificandBits) + rounded);
}

std::uint16_t half_bits(float value) {
  if (!std::isnan(value)) return half_bits(static_cast<double>(value));
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto kept = static_cast<std::uint16_t>(bits >> 13 & 0x3ff);
  // Bits that are all in the part cut off would leave infinity.
  return static_cast<std::uint16_t>((bits >> 16 & 0x8000) | kHalfInfinity | (kept != 0 ? kept : 0x200));
}

float half_value(std::uint16_t bits) {
  const std::uint32_t sign = static_cast<std::uint32_t>(bits & 0x8000) << 16;
  const std::uint32_t exponent = bits >> kSignificandBits & 0x1f;
  const std::uint32_t significand = bits & 0x3ff;
  if (exponent == 0) {
    const float magnitude = std::ldexp(static_cast<float>(significand), kLeastExponent - kSignificandBits);
    return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(magnitude));
  }
  const std::uint32_t wide_exponent = exponent == 31 ? 255 : exponent - 15 + 127;
  return std::bit_cast<float>(sign | wide_exponent << 23 | significand << 13);
}

}  // namespace texture

Image to_half(const Image& image) {
  texture::check_image(image, "to_half");
  if (image.type != SampleType::f32) {
    texture::fail_input("to_half", fmt::format("{} samples", name_of(image.type)), "float");
  }
  Image half{.size = image.size,
             .depth = image.depth,
             .channels = image.channels,
             .type = SampleType::f16,
             .samples = std::vector<std::byte>(image.samples.size() / 2)};
  for (std::size_t i = 0; i < half.samples.size() / 2; ++i) {
    float value;
    std::memcpy(&value, image.samples.data() + i * sizeof value, sizeof value);
    const std::uint16_t bits = texture::half_bits(value);
    if (!texture::is_finite_half(bits) && std::isfinite(value)) {
      texture::fail_input("to_half", fmt::format("sample {} is {}", i, value), "-65504..65504",
                          "scale the samples, or keep them float");
    }
    std::memcpy(half.samples.data() + i * sizeof bits, &bits, sizeof bits);
  }
  return half;
}

Image to_float(const Image& image) {
  texture::check_image(image, "to_float");
  if (image.type != SampleType::f16) {
    texture::fail_input("to_float", fmt::format("{} samples", name_of(image.type)), "half");
  }
  Image wide{.size = image.size,
             .depth = image.depth,
             .channels = image.channels,
             .type = SampleType::f32,
             .samples = std::vector<std::byte>(image.samples.size() * 2)};
  for (std::size_t i = 0; i < image.samples.size() / 2; ++i) {
    std::uint16_t bits;
    std::memcpy(&bits, image.samples.data() + i * sizeof bits, sizeof bits);
    const float value = texture::half_value(bits);
    std::memcpy(wide.samples.data() + i * sizeof value, &value, sizeof value);
  }
  return wide;
}

}  // namespace bn
