#include "anneal/engine.h"

#include <algorithm>
#include <bit>

namespace bn::anneal {

void WorseningCounts::count(std::int64_t change, bool taken) {
  ++within_reach;
  if (change <= 0) return;
  const int log = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(change))) - 1;
  const auto i = static_cast<std::size_t>(std::min(log, kWorseningClasses - 1));
  ++tried[i];
  accepted[i] += taken;
}

WorseningCounts& WorseningCounts::operator+=(const WorseningCounts& other) {
  for (std::size_t i = 0; i < tried.size(); ++i) {
    tried[i] += other.tried[i];
    accepted[i] += other.accepted[i];
  }
  within_reach += other.within_reach;
  return *this;
}

}  // namespace bn::anneal
