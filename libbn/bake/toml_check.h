// Refuses texts that toml++ cannot be trusted with.

#pragma once

#include <string_view>

#include "bake/mistakes.h"

namespace bn {

/// Notes what lies outside the part of TOML that recipes use and toml++ 3.3 reads safely.
void check_toml(std::string_view text, Mistakes& mistakes);

}  // namespace bn
