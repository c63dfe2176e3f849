// Which of Highway's targets the kernels run on. Highway 1.0 has no SSE2 target: below SSE4 comes
// SCALAR, plain scalar code, which every x86-64 machine runs.

#include <fmt/format.h>
#include <hwy/highway.h>

#include "bn/error.h"
#include "bn/execution.h"

namespace bn {
namespace {

/// The targets compiled in that this machine runs, best first.
std::vector<std::int64_t> runnable_targets() {
  // The machine's own answer is wanted here, not what use_instruction_set() has put in its place.
  static const std::int64_t detected = hwy::SupportedTargets();
  std::vector<std::int64_t> targets;
  // Highway gives better targets lower bits.
  for (int bit = 0; bit < 63; ++bit) {
    const std::int64_t target = std::int64_t{1} << bit;
    const bool runs = (detected & target) != 0 || target == HWY_SCALAR;
    if (runs && (HWY_TARGETS & target) != 0) targets.push_back(target);
  }
  return targets;
}

// Detection must come before any forcing; a first use during static initialisation sees to that.
[[maybe_unused]] const std::vector<std::int64_t> kDetectedFirst = runnable_targets();

}  // namespace

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const std::int64_t target : runnable_targets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_instruction_set(std::string_view name) {
  std::int64_t chosen = 0;
  for (const std::int64_t target : runnable_targets()) {
    if (name == hwy::TargetName(target)) chosen = target;
  }
  if (!name.empty() && chosen == 0) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("instruction set '{}' cannot run here", name),
                 .where = "instruction set",
                 .limit = fmt::format("{}", fmt::join(instruction_sets(), ", ")),
                 .remedy = ""});
  }
  hwy::SetSupportedTargetsForTest(chosen);  // 0 undoes it
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace bn
