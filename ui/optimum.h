// The proven optimum of a run's energy, found in the background.

#pragma once

#include <string>

#include "bn/retarget_anneal.h"
#include "ui/task.h"

namespace bn::ui {

/// Starts to solve at once. All functions are for the window's thread.
class Optimum {
 public:
  /// One channel without a residual; other energies have no exact solver.
  static bool exists_for(const AnnealProblem& problem) {
    return problem.channels.size() == 1 && problem.residual_sigma_px == 0.0;
  }
  explicit Optimum(const AnnealProblem& problem);

  /// Call it every frame.
  void poll();
  bool solving() const { return task_.running(); }
  /// Null until it is proven.
  const RetargetTile* tile() const { return solved_ ? &solved_->tile : nullptr; }
  double seconds() const { return solved_ ? solved_->seconds : 0.0; }  ///< that the proof took
  const std::string& failure() const { return failure_; }              ///< why there will be none

 private:
  struct Solved {
    RetargetTile tile;
    double seconds = 0.0;
  };
  Task<Solved> task_;
  std::optional<Solved> solved_;
  std::string failure_;
};

}  // namespace bn::ui
