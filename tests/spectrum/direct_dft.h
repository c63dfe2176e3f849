// The definition of the transform, term by term in long double: what the tests hold the fast one against.

#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "bn/random.h"
#include "bn/spectrum.h"

namespace bn::test {

using LongComplex = std::complex<long double>;

/// exp(-2 pi i k / n) for k = 0..n-1.
inline std::vector<LongComplex> roots_of_unity(int n) {
  std::vector<LongComplex> roots;
  for (int k = 0; k < n; ++k) {
    const long double angle = -2.0L * std::numbers::pi_v<long double> * k / n;
    roots.emplace_back(std::cos(angle), std::sin(angle));
  }
  return roots;
}

/// The whole spectrum, axis by axis (the sums of the definition, factored), index as the values'.
template <class T>
std::vector<LongComplex> direct_dft(const std::vector<T>& values, Shape shape) {
  std::vector<LongComplex> data(values.begin(), values.end());
  const int sides[3] = {shape.width, shape.height, shape.depth};
  std::size_t stride = 1;
  for (const int side : sides) {
    const auto root = roots_of_unity(side);
    std::vector<LongComplex> line(static_cast<std::size_t>(side));
    for (std::size_t first = 0; first < data.size(); ++first) {
      if (first / stride % static_cast<std::size_t>(side) != 0) continue;
      for (int k = 0; k < side; ++k) {
        LongComplex sum{};
        for (int i = 0; i < side; ++i) {
          sum += data[first + static_cast<std::size_t>(i) * stride] *
                 root[static_cast<std::size_t>(std::int64_t{k} * i % side)];
        }
        line[static_cast<std::size_t>(k)] = sum;
      }
      for (int k = 0; k < side; ++k)
        data[first + static_cast<std::size_t>(k) * stride] = line[static_cast<std::size_t>(k)];
    }
    stride *= static_cast<std::size_t>(side);
  }
  return data;
}

/// Values 0..1 from the counter-based generator.
inline std::vector<double> white_values(std::int64_t count, std::uint64_t seed) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<double>(random_bits(seed, 0, i) >> 11) * 0x1p-53;
  }
  return values;
}

}  // namespace bn::test
