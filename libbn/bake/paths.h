// Paths as recipes name them: what a path may not be, and what its extension says.

#pragma once

#include <filesystem>
#include <string>

#include "bn/texture.h"

namespace bn::baking {

/// ".png", in lower case.
std::string lower_case_extension(const std::string& path);

/// The sample type that a file has where nobody names one: float for .exr, else 8bit.
SampleType natural_type(const std::string& path);

/// What is wrong with an output path, as in "is absolute"; empty if nothing is. Files stay inside the output
/// folder.
std::string path_problem(const std::string& path);

}  // namespace bn::baking
