// bn/execution.h - floor 0: how a computation runs (threads, stop, progress, memory), and parallel loops.

#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace bn {

/// How a long computation runs. None of this can change a result, only whether and when it comes.
struct Execution {
  /// Threads to use at most, 1..1024; 0 takes every core this process may run on.
  int threads = 0;
  /// Request a stop and the computation ends soon with ErrorCode::cancelled.
  std::stop_token stop = {};
  /// Called with the share done, 0..1: never backwards, never from two threads at once, from any
  /// thread of the computation. It must not throw and must not call back into the computation.
  std::function<void(double done)> progress = {};
  /// A computation that would need more fails with ErrorCode::over_limit before it starts.
  std::uint64_t memory_limit_bytes = std::uint64_t{8} << 30;
};

/// The number of threads `execution` means. Throws invalid_input outside 0..1024.
int thread_count(const Execution& execution);

/// Throws over_limit, naming `where`, if `bytes` is above the memory limit.
void check_memory(const Execution& execution, std::uint64_t bytes, std::string_view where);

/// Throws cancelled if a stop was requested. Cheap; call it every few milliseconds of work.
void throw_if_stopped(const Execution& execution);

/// Calls body(i) for every i in 0..count-1, on thread_count(execution) threads, in no particular
/// order; returns when all are done. For reproducible results each i writes a range of its own.
/// The first exception thrown by a body ends the loop and is rethrown.
void parallel_for(const Execution& execution, std::int64_t count,
                  const std::function<void(std::int64_t)>& body);

// --- instruction sets --------------------------------------------------------------------------

/// Names of the instruction sets that this machine can run, best first; for example
/// {"AVX3", "AVX2", "SSE4", "SCALAR"}, the last being plain scalar code. Any of them gives the same bytes.
std::vector<std::string> instruction_sets();

/// Makes the kernels use `name` (from instruction_sets()) from now on in the whole process; an
/// empty name returns to the best. For tests and benchmarks. Not thread safe. Throws invalid_input.
void use_instruction_set(std::string_view name);

}  // namespace bn
