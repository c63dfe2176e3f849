// The one door to TOML. toml++ is included here with its assertions turned into exceptions: with NDEBUG it
// takes them for granted instead, and some texts break them (see toml_check.cpp). Nothing else may include
// it, or one program would hold the parser in two forms.

#pragma once

#define TOML_HEADER_ONLY 1
#define TOML_ASSERT(expression) ::bn::document::require_sound_toml(static_cast<bool>(expression))
#pragma push_macro("NDEBUG")
#undef NDEBUG
namespace bn::document {
struct BrokenToml {};
constexpr void require_sound_toml(bool sound) {
  if (!sound) throw BrokenToml();
}
}  // namespace bn::document
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <string>
#include <string_view>

namespace bn::document {

/// Parses `text`; `name` is the file's in messages. Safe for hostile text.
/// Errors: invalid_input, with name:line.
toml::table parse_toml(std::string_view text, const std::string& name);

}  // namespace bn::document
