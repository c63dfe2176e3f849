// The declarations of options that the window has a widget for: their ranges, units and sentences are the
// library's.

#pragma once

#include <string>
#include <string_view>

#include "bn/options.h"

namespace bn::ui {

/// The option `key` of the kind of texture whose tables are [[table]]: declared("mask", "sigma"). It must
/// exist. Only its description may be used.
const Option& declared(std::string_view table, std::string_view key);

/// "Another seed gives another mask. Allowed: 0..9223372036854775807."
std::string hint_of(const Option& option);

}  // namespace bn::ui
