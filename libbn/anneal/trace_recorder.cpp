#include "anneal/trace_recorder.h"

namespace bn::anneal {
namespace {

/// A watched sweep takes some 20 times as long as another; one in this many costs a run 0.25 %.
constexpr std::int64_t kSweepsPerWatchedOne = 8192;

}  // namespace

bool TraceRecorder::watches(std::int64_t sweeps) {
  const bool due = trace_ != nullptr && sweeps - last_watched_ >= kSweepsPerWatchedOne;
  if (due) last_watched_ = sweeps;
  return due;
}

void TraceRecorder::record(const Chain& chain, double seconds, double temperature, std::int64_t best_energy) {
  if (trace_ == nullptr) return;
  const auto point = static_cast<std::int64_t>(static_cast<double>(chain.proposals) /
                                               static_cast<double>(budget_) * kTracePoints);
  if (point == last_point_) return;
  last_point_ = point;
  const std::int64_t made = chain.proposals - proposals_, accepted = chain.accepted - accepted_;
  proposals_ = chain.proposals;
  accepted_ = chain.accepted;
  trace_->add({.proposals = chain.proposals,
               .seconds = seconds,
               .temperature = temperature,
               .energy = chain.engine->energy(),
               .best_energy = best_energy,
               .accepted_share = made == 0 ? 0.0 : static_cast<double>(accepted) / static_cast<double>(made),
               .worsening_tried = chain.watched.tried,
               .worsening_accepted = chain.watched.accepted});
}

}  // namespace bn::anneal
