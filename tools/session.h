// What a running verb is handed: how to compute, where to write.

#pragma once

#include <string_view>

#include "bn/execution.h"
#include "tools/output.h"
#include "tools/progress.h"

namespace bn::tools {

struct Session {
  Execution execution;        ///< threads, stop and memory limit of this run; progress is set per task
  Output& output;             ///< results, to stdout
  ProgressDisplay& progress;  ///< progress and notes, to stderr
  bool quiet = false;         ///< nothing for people but errors

  /// `execution` with its progress shown as that of `task`.
  Execution execution_showing(std::string_view task);
};

}  // namespace bn::tools
