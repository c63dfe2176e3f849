// How values are spread over their range, for the figures and for the diagnosis.

#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "bn/spectrum.h"

namespace bn::spectrum {

/// Every value as its place in the range, 0..1, and the share of the values below it. Of stored levels, which
/// are whole numbers, the place is the middle of the level's step; values equal to it count half.
struct Spread {
  std::vector<double> place;
  std::vector<double> share;
};
Spread spread_of(std::span<const double> values, double low, double high, const Execution& execution);

/// Largest |expected(place) - share|: the distance of Kolmogorov and Smirnov.
template <class Expected>
double distance_from(const Spread& spread, const Expected& expected) {
  double largest = 0.0;
  for (std::size_t i = 0; i < spread.place.size(); ++i) {
    largest = std::max(largest, std::abs(expected(spread.place[i]) - spread.share[i]));
  }
  return largest;
}

/// The share of a triangular distribution over 0..1 that lies below `place`.
inline double triangular_share(double place) {
  if (place <= 0.0) return 0.0;
  if (place >= 1.0) return 1.0;
  return place < 0.5 ? 2.0 * place * place : 1.0 - 2.0 * (1.0 - place) * (1.0 - place);
}

}  // namespace bn::spectrum
