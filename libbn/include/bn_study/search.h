// bn_study/search.h - floor 4 (study): error against time, void-and-cluster beside a search by swaps. Not
// installed.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"

namespace bn {

/// A mask, how long it took on one thread, and its error (filtered_error() of the default filter).
struct SearchResult {
  std::string method;
  double seconds = 0.0;      ///< processor time
  double first_error = 0.0;  ///< after one frame
  double late_error = 0.0;   ///< after as many frames as there are slices
};

/// The presets of spatiotemporal_mask(); then a search, as published generators make it: from white noise,
/// two pixels of a slice exchange their ranks whenever that lowers - sum over pairs A(i - j) |v_i - v_j|, A
/// the autocorrelation of the default filter, for so many tries a voxel (rising numbers); and the same from
/// the preset `filtered`, the last number only. Errors: those of spatiotemporal_mask().
std::vector<SearchResult> study_search(Shape size, std::span<const std::int64_t> tries_a_voxel,
                                       std::uint64_t seed, const Execution& execution = {});

}  // namespace bn
