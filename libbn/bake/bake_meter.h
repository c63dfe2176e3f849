// How far a bake is.

#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

#include "bn/bake.h"

namespace bn::baking {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Share done and time left of a whole bake, from the shares of its jobs.
class BakeMeter {
 public:
  BakeMeter(const BakePlan& plan, const Execution& execution, const BakeEvents& events)
      : report_(execution.progress), events_(events), done_(plan.jobs.size(), 0.0) {
    for (const PlannedJob& job : plan.jobs) weights_.push_back(job.up_to_date ? 0.0 : job.estimated_seconds);
    total_ = std::max(std::accumulate(weights_.begin(), weights_.end(), 0.0), 1e-9);
  }

  /// To be called by one thread at a time.
  void update(std::size_t job, double share) {
    done_[job] = std::max(done_[job], share);
    double sum = 0.0;
    for (std::size_t i = 0; i < done_.size(); ++i) sum += done_[i] * weights_[i];
    report(std::min(sum / total_, 1.0));
  }

  void finish() { report(1.0); }
  double seconds() const { return seconds_since(start_); }

 private:
  void report(double done) {
    constexpr double kNotch = 1.0 / 500.0;
    if (done < reported_ + kNotch && !(done >= 1.0 && reported_ < 1.0)) return;
    reported_ = done;
    BakeProgress progress{.done = done, .seconds = seconds(), .seconds_left = std::nullopt};
    // A first guess from less than this would jump about.
    if (done >= 0.01 && progress.seconds >= 0.2)
      progress.seconds_left = progress.seconds * (1.0 - done) / done;
    if (events_) events_(progress);
    if (report_) report_(done);
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::function<void(double)> report_;
  const BakeEvents& events_;
  std::vector<double> done_, weights_;
  double total_ = 0.0;
  double reported_ = 0.0;
};

}  // namespace bn::baking
