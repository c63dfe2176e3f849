// Traces of annealing as text. Writing a point costs a copy of half a kilobyte; readers see a point only once
// it is whole, since the size is published after it (release and acquire), and points never move.

#include <fmt/format.h>

#include <iterator>

#include "bn/anneal.h"

namespace bn {

void AnnealTrace::add(const TracePoint& point) {
  const std::size_t at = size_.load(std::memory_order_relaxed);
  if (at == points_.size()) return;
  points_[at] = point;
  size_.store(at + 1, std::memory_order_release);
}

std::string AnnealTrace::csv(std::int64_t lower_bound) const {
  // Of the classes up to the largest that was ever tried.
  std::size_t classes = 0;
  const std::size_t count = size();
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t i = classes; i < kWorseningClasses; ++i) {
      if (points_[p].worsening_tried[i] > 0) classes = i + 1;
    }
  }
  std::string text = "proposals,seconds,temperature,energy,best,lower_bound,accepted";
  for (std::size_t i = 0; i < classes; ++i) {
    fmt::format_to(std::back_inserter(text), ",worse_{0}_tried,worse_{0}_accepted", std::int64_t{1} << i);
  }
  text += '\n';
  for (std::size_t p = 0; p < count; ++p) {
    const TracePoint& point = points_[p];
    fmt::format_to(std::back_inserter(text), "{},{:.6f},{:.6g},{},{},{},{:.6g}", point.proposals,
                   point.seconds, point.temperature, point.energy, point.best_energy, lower_bound,
                   point.accepted_share);
    for (std::size_t i = 0; i < classes; ++i) {
      fmt::format_to(std::back_inserter(text), ",{},{}", point.worsening_tried[i],
                     point.worsening_accepted[i]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace bn
