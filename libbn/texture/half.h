// Half floats (IEEE 754 binary16) as bits.

#pragma once

#include <cstdint>

namespace bn::texture {

inline constexpr std::uint16_t kHalfInfinity = 0x7c00;

/// The half float nearest to `value`, of two equally near the one whose last bit is 0. From 65520 on, the
/// middle between the greatest half float and the next power of two, that is infinity.
std::uint16_t half_bits(double value);
/// The same from a float. The bits of a NaN are kept as far as there is room, so a half float that was
/// widened comes back bit by bit.
std::uint16_t half_bits(float value);
/// The value, exactly.
float half_value(std::uint16_t bits);

inline bool is_finite_half(std::uint16_t bits) { return (bits & kHalfInfinity) != kHalfInfinity; }

}  // namespace bn::texture
