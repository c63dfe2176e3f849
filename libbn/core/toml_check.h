// Refuses texts that toml++ cannot be trusted with.

#pragma once

#include <string_view>

#include "core/diagnostics.h"

namespace bn::document {

/// Notes what lies outside the part of TOML that recipes and scenes use and toml++ 3.3 reads safely.
void check_toml(std::string_view text, Diagnostics& diagnostics);

}  // namespace bn::document
