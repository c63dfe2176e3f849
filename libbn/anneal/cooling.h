// The runtime state of a cooling schedule: what a run has done so far, and the temperature that follows from it.

#pragma once

#include <cstdint>

#include "bn/anneal.h"

namespace bn::anneal {

class Cooling {
 public:
  /// Counts since the start, and within the stage of a schedule that has stages. Plain, so that a
  /// checkpoint can hold it.
  struct Progress {
    std::int64_t step = 0;
    std::int64_t stage = 0;
    std::int64_t tried = 0;
    std::int64_t accepted = 0;
    std::int64_t changed = 0;
    std::int64_t frozen_stages = 0;
    friend bool operator==(const Progress&, const Progress&) = default;
  };

  /// Throws invalid_input for a schedule that check_schedule() refuses.
  explicit Cooling(const CoolingSchedule& schedule);

  double temperature() const;
  /// `proposals` were made at temperature(), `accepted` of them taken, `changed` with another energy.
  void advance(std::int64_t proposals, std::int64_t accepted, std::int64_t changed);
  /// Whether a schedule that can end by itself has ended.
  bool frozen() const;

  const Progress& progress() const { return progress_; }
  void resume(const Progress& progress) { progress_ = progress; }

 private:
  CoolingSchedule schedule_;
  Progress progress_;
};

}  // namespace bn::anneal
