// A motion set is many annealings side by side, one on each thread: no result depends on how many there are.
//
// Its checkpoint is the latest one of each variant. A variant that is over keeps its last, which resumes to
// its end at once; so one format holds what is finished, what runs and what has not begun.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "core/progress.h"
#include "core/refuse.h"
#include "retarget/anneal_checkpoint.h"

namespace bn {
using namespace retarget;
namespace {

using Clock = std::chrono::steady_clock;

/// Collects the variants' checkpoints and hands them on together.
class SetCheckpoint {
 public:
  SetCheckpoint(const AnnealOptions& options, std::uint64_t fingerprint, std::size_t variants)
      : options_(options), fingerprint_(fingerprint), variants_(variants), saved_(Clock::now()) {
    const std::string& resume = options.checkpoint.resume;
    if (!resume.empty()) variants_ = decode_set_checkpoint(resume, fingerprint, variants);
  }

  Checkpointing of(std::size_t variant) {
    Checkpointing one{.save = {}, .interval_s = options_.checkpoint.interval_s, .resume = variants_[variant]};
    if (options_.checkpoint.save)
      one.save = [this, variant](std::string_view bytes) { keep(variant, bytes); };
    return one;
  }

  void save() {
    const std::lock_guard lock(mutex_);
    if (options_.checkpoint.save) save_locked();
  }

 private:
  void keep(std::size_t variant, std::string_view bytes) {
    const std::lock_guard lock(mutex_);
    variants_[variant] = bytes;
    // Half of a single run's limit: a variant's own checkpoint may be as old again.
    constexpr double kLongest_s = 14.0;
    const double asked = options_.checkpoint.interval_s;
    const double interval = asked == 0.0 ? 0.0 : std::max(asked, std::min(kLongest_s, 50.0 * cost_s_));
    if (std::chrono::duration<double>(Clock::now() - saved_).count() >= interval) save_locked();
  }

  void save_locked() {
    const auto start = Clock::now();
    options_.checkpoint.save(encode_set_checkpoint(fingerprint_, options_.proposals, variants_));
    saved_ = Clock::now();
    cost_s_ = std::chrono::duration<double>(saved_ - start).count();
  }

  const AnnealOptions& options_;
  std::uint64_t fingerprint_;
  std::mutex mutex_;  ///< over all below, and over calls of `save`
  std::vector<std::string> variants_;
  Clock::time_point saved_;
  double cost_s_ = 0.0;
};

/// Of the set: its variants differ in the motion only.
std::uint64_t set_fingerprint(const AnnealProblem& problem, const AnnealOptions& options) {
  AnnealProblem still = problem;
  still.retarget.motion = {0, 0};
  return fingerprint_of(still, options);
}

}  // namespace

std::vector<AnnealResult> anneal_motion_set(const AnnealProblem& problem, const AnnealOptions& options,
                                            int range, const Execution& execution) {
  constexpr int kMaxRange = 8;
  if (range < 0 || range > kMaxRange)
    refuse("motion", fmt::format("a range of {}", range), fmt::format("0..{}", kMaxRange));
  check_anneal_options(options);
  const int side = 2 * range + 1;
  std::vector<AnnealResult> results(static_cast<std::size_t>(side * side));
  SetCheckpoint checkpoint(options, set_fingerprint(problem, options), results.size());
  ProgressMeter progress(execution, results.size());
  try {
    parallel_for(execution, static_cast<std::int64_t>(results.size()), [&](std::int64_t i) {
      AnnealProblem variant = problem;
      variant.retarget.motion = {static_cast<int>(i) % side - range, static_cast<int>(i) / side - range};
      AnnealOptions one = options;
      one.checkpoint = checkpoint.of(static_cast<std::size_t>(i));
      const Execution inside{
          .threads = 1, .stop = execution.stop, .memory_limit_bytes = execution.memory_limit_bytes};
      results[static_cast<std::size_t>(i)] = anneal_retarget(variant, one, inside);
      progress.advance(1);
    });
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) checkpoint.save();
    throw;
  }
  checkpoint.save();  // who is stopped before the results are safe has them here
  progress.finish();
  return results;
}

}  // namespace bn
