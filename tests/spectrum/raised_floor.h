// A mask that is broken as a known generator breaks them.

#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "bn/random.h"
#include "bn/spectrum.h"

namespace bn::test {

/// Adds a floor of `power` to the lowest band of a mask of ranks: a wave of random phase at each of
/// its frequencies.
inline std::vector<double> with_raised_floor(std::vector<double> ranks, int side, double power) {
  const double n = static_cast<double>(ranks.size());
  // |F| = amplitude * N / 2 and power = |F|^2 / (N * N^2 / 12), for ranks 0..N-1.
  const double amplitude = 2.0 * std::sqrt(power * n / 12.0);
  const int reach = side / 16;
  std::uint64_t draw = 0;
  for (int ky = -reach; ky <= reach; ++ky) {
    for (int kx = 0; kx <= reach; ++kx) {
      if (kx * kx + ky * ky > reach * reach || (kx == 0 && ky <= 0)) continue;
      const double phase =
          2.0 * std::numbers::pi * static_cast<double>(random_bits(1, 0, draw++) >> 11) * 0x1p-53;
      for (int i = 0; i < side * side; ++i) {
        ranks[static_cast<std::size_t>(i)] +=
            amplitude * std::cos(2.0 * std::numbers::pi * (kx * (i % side) + ky * (i / side)) / side + phase);
      }
    }
  }
  return midranks(ranks);
}

}  // namespace bn::test
