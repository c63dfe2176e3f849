// The one way in which the rooms turn an option down: by name, with its range.

#pragma once

#include <string>
#include <utility>

#include "bn/error.h"

namespace bn {

/// Throws invalid_input. `where` is the option's name, as in recipes.
[[noreturn]] inline void refuse(std::string where, std::string what, std::string limit,
                                std::string remedy = "") {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = std::move(where),
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

}  // namespace bn
