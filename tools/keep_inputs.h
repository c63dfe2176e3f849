// No verb replaces what it reads.

#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace bn::tools {

/// Errors: invalid_input, with the name of the flag: writing to `out` would replace one of the `inputs`.
void check_keeps(const std::filesystem::path& out, const std::string& flag,
                 std::span<const std::filesystem::path> inputs);

}  // namespace bn::tools
