// Every failure as one message and one exit code, in every program alike.

#pragma once

#include <string>

#include "bn/error.h"

namespace bn::tools {

/// The exception in flight as an Error: the library's own as they are, all others in the same words. One that
/// nobody meant to throw is a defect in `program`. Call it inside a catch block.
Error error_in_flight(const std::string& program);

/// The only place where a failure becomes a number. `signal`: the one that cancelled.
int exit_code_of(ErrorCode code, int signal = 0);

}  // namespace bn::tools
