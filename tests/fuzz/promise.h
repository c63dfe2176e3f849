// What the fuzzers of readers share.

#pragma once

#include <cstdio>
#include <cstdlib>

#include "bn/execution.h"

namespace bn {

inline const Execution kExecution{.memory_limit_bytes = 64 << 20};

inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

}  // namespace bn
