// The Metropolis rule on integers: a swap that changes the energy by `change` is taken iff
// change <= metropolis_threshold(bits, T), with 32 random bits of its own.
//
// Metropolis takes a worsening with probability exp(-change / T), that is if u < exp(-change / T), that is
// if change < -T ln u. The threshold is -T ln u rounded down, u = ((bits >> 9) + 1/2) / 2^23. The logarithm
// is a polynomial in single precision: IEEE additions and multiplications in a written order, so that a
// vector of any width computes the same bits; ln's error is below 2e-6, so a chance of acceptance
// is exact to that share. Chances below 2^-24 count as 0.
//
// The coefficients are the minimax fit of ln(1 + t) on 0..1 by a polynomial without constant term (Remez).

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace bn::anneal {

inline constexpr float kLogCoefficients[6] = {0.999901645f,  -0.497875086f, 0.317649113f,
                                              -0.193761065f, 0.0855700444f, -0.0183389048f};
inline constexpr float kLn2Single = 0.693147181f;
/// Below every -ln u; keeps an infinite temperature times it positive.
inline constexpr float kLeastMinusLog = 0x1p-24f;
/// Stands for an infinite temperature: accepts any change an int64 can hold.
inline constexpr float kHottest = 1e30f;

/// The temperature as thresholds use it.
inline float single_temperature(double temperature) {
  return static_cast<float>(std::min(temperature, static_cast<double>(kHottest)));
}

/// -ln u for the u that `bits` stand for.
inline float minus_log(std::uint32_t bits) {
  const float scaled = static_cast<float>(static_cast<std::int32_t>(bits >> 9)) + 0.5f;
  const auto pattern = std::bit_cast<std::int32_t>(scaled);
  const auto octaves = static_cast<float>(127 + 23 - (pattern >> 23));
  const float t = std::bit_cast<float>((pattern & 0x7fffff) | 0x3f800000) - 1.0f;
  float log = kLogCoefficients[5];
  for (int i = 4; i >= 0; --i) log = log * t + kLogCoefficients[i];
  log = log * t;
  return std::max(octaves * kLn2Single - log, kLeastMinusLog);
}

/// The largest change of energy that is accepted.
inline std::int64_t metropolis_threshold(std::uint32_t bits, float temperature) {
  return static_cast<std::int64_t>(std::min(minus_log(bits) * temperature, 0x1p62f));
}

}  // namespace bn::anneal
