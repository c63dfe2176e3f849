// Parts of diagnose(), one file each.

#pragma once

#include <optional>

#include "bn/judgement.h"

namespace bn::spectrum {

/// diagnosis_values.cpp: what was done to the values, wherever they stand.
std::optional<Finding> find_curve(const Samples& samples, const Execution& execution);
std::optional<Finding> find_swapped_bytes(const Samples& samples, const Analysis& analysis,
                                          const Execution& execution);

/// diagnosis_patterns.cpp: what was done to the places, whatever stands there.
std::optional<Finding> find_enlarged(const Samples& samples);
std::optional<Finding> find_smoothed(const FiguresOfMerit& figures, const PowerSpectrum& power);
std::optional<Finding> find_repeated(const Samples& samples);

}  // namespace bn::spectrum
