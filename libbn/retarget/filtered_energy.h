// The energy of a blurred residual, E = sum over w of (g * e)(w)^2, and its change by a swap.
//
// With A = g correlated with itself and h = A * e, E = sum of e h, and a swap that adds a to e(p) and takes
// it from e(q) changes E by 2 a (h(p) - h(q)) + 2 a^2 (A(0) - A(q - p)). h is kept up to date: a taken swap
// costs two passes over A's support, a refused one nothing. All integers, so the sum never drifts. A is
// wrapped onto the torus, so any size is right, below the filter's support too.

#pragma once

#include <cstdint>
#include <vector>

#include "bn/grid.h"

namespace bn::retarget {

/// A on the torus.
struct ResidualKernel {
  struct Tap {
    Offset at;
    std::int64_t weight;
  };
  Grid<std::int64_t> autocorrelation;
  std::vector<Tap> taps;  ///< where it is not 0

  /// `largest_residual`: of |e|; decides how finely the Gaussian can be rounded. Throws over_limit if
  /// energies could exceed 2^62 however coarsely it is.
  ResidualKernel(Extent size, double sigma_px, std::int64_t largest_residual);
};

/// One channel's residual and its response.
class ResidualField {
 public:
  ResidualField(const ResidualKernel& kernel, Grid<std::int64_t> residual);

  std::int64_t energy() const;
  /// If `amount` were added at p and taken at q, p != q.
  std::int64_t change(std::size_t p, std::size_t q, std::int64_t amount) const;
  void apply(std::size_t p, std::size_t q, std::int64_t amount);

 private:
  void add(std::size_t at, std::int64_t amount);

  const ResidualKernel* kernel_;
  Grid<std::int64_t> residual_;
  Grid<std::int64_t> response_;
};

}  // namespace bn::retarget
