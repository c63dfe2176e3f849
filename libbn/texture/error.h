// Short ways to throw the errors that this room throws.

#pragma once

#include <string>

#include "bn/error.h"

namespace bn::texture {

[[noreturn]] inline void fail_io(std::string where, std::string what, std::string remedy = "") {
  throw Error({.code = ErrorCode::io,
               .what = std::move(what),
               .where = std::move(where),
               .limit = "",
               .remedy = std::move(remedy)});
}

[[noreturn]] inline void fail_input(std::string where, std::string what, std::string limit = "",
                                    std::string remedy = "") {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = std::move(where),
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

}  // namespace bn::texture
