// Turns counts of finished work, from any thread, into the calls that Execution::progress promises:
// serialised, never backwards, ending at 1.

#pragma once

#include <atomic>
#include <mutex>

#include "bn/execution.h"

namespace bn {

class ProgressMeter {
 public:
  /// `total` is the amount of work that counts as all of it.
  ProgressMeter(const Execution& execution, std::uint64_t total);
  /// Adds finished work. Thread safe, and free where nobody listens.
  void advance(std::uint64_t amount);
  /// Reports 1. Call it once, on success.
  void finish();

 private:
  std::function<void(double)> report_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
  std::mutex mutex_;
  double reported_ = 0.0;
};

}  // namespace bn
