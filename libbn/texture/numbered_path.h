// The parts of a file name with a place for a number.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bn::texture {

struct NumberedName {
  std::string before, after;  ///< "%%" resolved; without a number the name is `before`
  bool has_number = false;
  int digits = 1;  ///< at least
};

/// Throws invalid_input, as has_number() says.
NumberedName parse_numbered_name(const std::filesystem::path& path);
/// The digits of `number` as `name` asks for them.
std::string number_text(const NumberedName& name, std::int64_t number);
/// The number in the name of a file that `name` describes, or nothing.
std::optional<std::int64_t> number_in(const NumberedName& name, std::string_view file);

}  // namespace bn::texture
