// The slices of a volume one by one: a mean over all of them does not show the one that is bad.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "bn/spectrum.h"
#include "report/plot.h"

namespace bn::report {

struct SliceBands {
  std::vector<BandPower> of_slice;

  /// The slice with the most power in the lowest band that the slices have.
  std::size_t worst() const;
  std::size_t lowest_band() const;

  Plot plot(std::string file_name) const;
  std::string words() const;  ///< which slice is the worst, HTML
  /// The greatest power of a slice in a band, and which slice it is; HTML.
  std::string greatest(std::size_t band) const;
};

SliceBands slice_bands(const std::vector<double>& values, Shape shape, const Execution& execution);

}  // namespace bn::report
