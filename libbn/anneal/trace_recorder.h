// Fills the trace of a run: which sweeps are watched, and when a point is due.

#pragma once

#include <cstdint>

#include "anneal/chain.h"

namespace bn::anneal {

/// Slices of a run, and points of a trace, are about this many.
inline constexpr std::int64_t kTracePoints = 512;

class TraceRecorder {
 public:
  /// `trace` may be null: then nothing is watched and nothing recorded.
  TraceRecorder(AnnealTrace* trace, std::int64_t budget) : trace_(trace), budget_(budget) {}

  /// Whether the traced chain is to be watched in the slice that begins after `sweeps` sweeps.
  bool watches(std::int64_t sweeps);
  /// Adds a point unless the budget's present 512th has one. `temperature` is that of the next round.
  void record(const Chain& chain, double seconds, double temperature, std::int64_t best_energy);

 private:
  AnnealTrace* trace_;
  std::int64_t budget_;
  std::int64_t last_watched_ = 0;  ///< sweeps
  std::int64_t last_point_ = -1;   ///< the 512th of the budget that it stands for
  std::int64_t proposals_ = 0;     ///< at the last point
  std::int64_t accepted_ = 0;
};

}  // namespace bn::anneal
