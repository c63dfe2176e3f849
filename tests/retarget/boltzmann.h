// Boltzmann's distribution of energies by enumeration of all permutations, and the chi-square test of an
// engine against it. Critical values are those of chance 1e-5.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "reference.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;

/// Chi-square's value that chance exceeds once in 1e5 (Wilson and Hilferty 1931).
inline double critical_chi_square(int degrees) {
  const double v = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - v + 4.265 * std::sqrt(v), 3.0);
}

/// The probability of each energy at a temperature. `matrix[u][v]`: the cost of u -> v, or kForbidden.
inline std::map<std::int64_t, double> boltzmann(const std::vector<std::vector<std::int64_t>>& matrix,
                                                double temperature) {
  std::map<std::int64_t, double> share;
  double total = 0.0;
  std::vector<std::size_t> to(matrix.size());
  std::iota(to.begin(), to.end(), 0u);
  do {
    std::int64_t energy = 0;
    for (std::size_t u = 0; u < to.size() && energy < kForbidden; ++u) energy += matrix[u][to[u]];
    if (energy >= kForbidden) continue;
    const double weight = std::exp(-static_cast<double>(energy) / temperature);
    share[energy] += weight;
    total += weight;
  } while (std::next_permutation(to.begin(), to.end()));
  for (auto& [energy, weight] : share) weight /= total;
  return share;
}

/// Whether an engine's states have energies as `shares` says.
inline void expect_samples(anneal::Engine& engine, const std::map<std::int64_t, double>& shares,
                           double temperature, int fewest_bins) {
  // Far enough apart to count as independent: each seed is offered some tens of swaps in between.
  constexpr int kSamples = 10000, kApart = 64;
  std::map<std::int64_t, double> seen;
  for (int i = 0; i < kSamples; ++i) {
    engine.round(i, kApart, temperature, {});
    ++seen[engine.energy()];
  }
  for (const auto& [energy, count] : seen)
    ASSERT_TRUE(shares.contains(energy)) << "an energy no permutation has";
  double chi_square = 0.0, rest_expected = 0.0, rest_seen = 0.0;
  int bins = 0;
  for (const auto& [energy, share] : shares) {
    const double expected = kSamples * share;
    if (expected < 10.0) {
      rest_expected += expected;
      rest_seen += seen[energy];
      continue;
    }
    chi_square += (seen[energy] - expected) * (seen[energy] - expected) / expected;
    ++bins;
  }
  if (rest_expected > 1.0) {
    chi_square += (rest_seen - rest_expected) * (rest_seen - rest_expected) / rest_expected;
    ++bins;
  }
  EXPECT_GE(bins, fewest_bins);
  EXPECT_LT(chi_square, critical_chi_square(bins - 1));
}

}  // namespace bn
