// Whether bytes are text.

#pragma once

#include <string_view>

namespace bn {

/// Whether all of `text` is UTF-8: no stray bytes, no overlong forms, no surrogates, at most U+10FFFF.
bool is_utf8(std::string_view text);

}  // namespace bn
