// Words that go with a number, as "gauss:1.5".

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bn/options.h"

namespace bn {

inline bool has_number(const MeasuredWord& word) { return word.least != 0.0 || word.most != 0.0; }

/// The word and the number of "gauss:1.5"; nothing if it is none of them, or out of range.
std::optional<std::pair<std::string, double>> measured_parts(const std::vector<MeasuredWord>& words,
                                                             std::string_view text);

}  // namespace bn
