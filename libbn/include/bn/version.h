// bn/version.h - floor 0: the version of the toolkit.

#pragma once

#include <string_view>

namespace bn {

/// Semantic version of the toolkit; CMake reads it from this line.
inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace bn
