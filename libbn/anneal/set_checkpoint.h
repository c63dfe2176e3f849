// Checkpoints of a set of runs that are made side by side: the latest one of each. A run that is over keeps
// its last, which resumes to its end at once; so one format holds what is finished, what runs and what has
// not begun.

#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "bn/anneal.h"

namespace bn::anneal {

/// Collects the members' checkpoints and hands them on together. Threads: any number.
class SetCheckpoint {
 public:
  /// Goes on from options.checkpoint.resume if there is one. `options` must outlive the object.
  SetCheckpoint(const AnnealOptions& options, std::uint64_t fingerprint, std::size_t members);

  /// The checkpointing of one member's run.
  Checkpointing of(std::size_t member);
  /// Hands on what there is now.
  void save();

 private:
  void keep(std::size_t member, std::string_view bytes);
  void save_locked();

  const AnnealOptions& options_;
  std::uint64_t fingerprint_;
  std::mutex mutex_;  ///< over all below, and over calls of `save`
  std::vector<std::string> members_;
  std::chrono::steady_clock::time_point saved_;
  double cost_s_ = 0.0;
};

}  // namespace bn::anneal
