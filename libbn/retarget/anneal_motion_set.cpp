// A motion set is many annealings side by side, one on each thread: no result depends on how many there are.

#include <fmt/format.h>

#include "anneal/set_checkpoint.h"
#include "core/progress.h"
#include "core/refuse.h"
#include "retarget/anneal_task.h"

namespace bn {
using namespace retarget;
namespace {

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
  anneal::SetCheckpoint checkpoint(options, set_fingerprint(problem, options), results.size());
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
