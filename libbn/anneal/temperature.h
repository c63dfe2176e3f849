// Where the temperature of a run starts and ends, and the schedule in between.

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bn/anneal.h"

namespace bn::anneal {

/// The share of a run's budget that is spent at temperature 0 at its end is 1 in this many.
inline constexpr std::int64_t kQuenchShare = 64;

/// What temperatures can be found from. A problem's room fills it in; functions are called only where the
/// options need them.
struct TemperatureSource {
  /// What an automatic start and end stand for.
  std::function<TemperatureRange()> automatic;
  /// By how much a sample of the proposals raises the energy at the start of a run; those that raise it only.
  std::function<std::vector<std::int64_t>()> rises;
  /// The most that a proposal can change the energy; 0 where that is not known.
  std::int64_t largest_change = 0;
};

/// The temperature at which a share `wanted` of the rises is accepted, the mean of exp(-rise / T). 1 where
/// there are none.
double temperature_for_acceptance(const std::vector<std::int64_t>& rises, double wanted);

/// Throws invalid_input for start and end temperatures that exclude each other, and for a start that accepts
/// everything where the largest change is not known.
TemperatureRange temperatures_of(const AnnealOptions& options, const TemperatureSource& source);

}  // namespace bn::anneal
