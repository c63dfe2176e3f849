// What the options of an annealing mean for one problem: where the temperature starts and ends, and the
// schedule in between.

#pragma once

#include "retarget/anneal_instance.h"

namespace bn::retarget {

/// The share of a run's budget that is spent at temperature 0 at its end is 1 in this many.
inline constexpr std::int64_t kQuenchShare = 64;

/// Throws invalid_input: unknown words, ranges, and options that exclude each other; all that can be known
/// without the instance is known to check_anneal_options().
TemperatureRange temperatures_of(const AnnealInstance& instance, const AnnealOptions& options);

/// The schedule of a chain that does not temper, over `proposals`.
CoolingSchedule schedule_of(const AnnealOptions& options, const TemperatureRange& range,
                            std::int64_t proposals);

}  // namespace bn::retarget
