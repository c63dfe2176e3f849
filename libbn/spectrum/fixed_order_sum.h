// Sums of many terms in an order that neither threads nor vector width can change: each chunk into
// eight lanes, the lanes and then the chunks by halves. The rounding error grows with the
// logarithm of the count (Higham, "The accuracy of floating point summation", 1993).

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bn/execution.h"

namespace bn::spectrum {

/// Sum of terms[0..count-1] by halves.
inline double sum_by_halves(const double* terms, std::int64_t count) {
  if (count <= 0) return 0.0;
  if (count == 1) return terms[0];
  const std::int64_t half = count / 2;
  return sum_by_halves(terms, half) + sum_by_halves(terms + half, count - half);
}

/// Sum of term(i) for begin <= i < end, serially.
template <class Term>
double sum_chunk(std::int64_t begin, std::int64_t end, const Term& term) {
  constexpr int kLanes = 8;
  std::array<double, kLanes> lane{};
  std::int64_t i = begin;
  for (; i + kLanes <= end; i += kLanes) {
    for (int l = 0; l < kLanes; ++l) lane[l] += term(i + l);
  }
  for (int l = 0; i < end; ++i, ++l) lane[l] += term(i);
  return sum_by_halves(lane.data(), kLanes);
}

inline constexpr std::int64_t kSumChunk = std::int64_t{1} << 14;

/// Sum of term(i) for 0 <= i < count.
template <class Term>
double fixed_order_sum(const Execution& execution, std::int64_t count, const Term& term) {
  const std::int64_t chunks = (count + kSumChunk - 1) / kSumChunk;
  std::vector<double> partial(static_cast<std::size_t>(chunks));
  parallel_for(execution, chunks, [&](std::int64_t c) {
    partial[static_cast<std::size_t>(c)] =
        sum_chunk(c * kSumChunk, std::min(count, (c + 1) * kSumChunk), term);
  });
  return sum_by_halves(partial.data(), chunks);
}

}  // namespace bn::spectrum
