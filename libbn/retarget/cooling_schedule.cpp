// Cooling schedules: the formulas of bn/anneal.h, their checks, and the parameters that make them
// comparable. Powers go through reproducible_exp and reproducible_log: a temperature that differed in its
// last bit between C libraries would move an acceptance threshold and with it a baked texture.

#include "retarget/cooling.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.h"

namespace bn {
namespace {

[[noreturn]] void refuse(std::string_view where, std::string what, std::string limit) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = std::string(where),
               .limit = std::move(limit),
               .remedy = ""});
}

void require(bool in_range, std::string_view where, double value, std::string_view limit) {
  if (!in_range) refuse(where, fmt::format("{}", value), std::string(limit));
}

void check_start(double start) {
  require(start > 0.0 && std::isfinite(start), "start temperature", start, "above 0, finite");
}

struct Check {
  void operator()(const ConstantCooling& s) const {
    require(s.temperature >= 0.0, "temperature", s.temperature, "0 or above; infinity accepts everything");
  }
  void operator()(const GreedyCooling&) const {}
  void operator()(const HajekCooling& s) const {
    require(s.c > 0.0 && std::isfinite(s.c), "Hajek's c", s.c, "above 0, finite");
  }
  void operator()(const LinearCooling& s) const {
    check_start(s.start);
    require(s.slope >= 0.0 && std::isfinite(s.slope), "slope", s.slope, "0 or above, finite");
    require(s.end >= 0.0 && s.end <= s.start, "end temperature", s.end,
            fmt::format("0..{}, the start temperature", s.start));
  }
  void operator()(const ExponentialCooling& s) const {
    check_start(s.start);
    require(s.factor > 0.0 && s.factor <= 1.0, "factor", s.factor, "above 0, at most 1; above 1 would heat");
  }
  void operator()(const InverseCooling& s) const {
    check_start(s.start);
    require(s.factor >= 0.0 && std::isfinite(s.factor), "factor", s.factor, "0 or above, finite");
  }
  void operator()(const KirkpatrickCooling& s) const {
    check_start(s.start);
    require(s.factor > 0.0 && s.factor < 1.0, "factor", s.factor, "above 0, below 1; above 1 would heat");
    require(s.end >= 0.0 && s.end <= s.start, "end temperature", s.end,
            fmt::format("0..{}, the start temperature", s.start));
    if (s.accepted_per_stage < 1)
      refuse("accepted swaps a stage", fmt::format("{}", s.accepted_per_stage), "at least 1");
    if (s.tried_per_stage < 1)
      refuse("tried swaps a stage", fmt::format("{}", s.tried_per_stage), "at least 1");
    if (s.stages > 0 && s.tried_per_stage > (std::int64_t{1} << 62) / s.stages) {
      refuse("tried swaps a stage", fmt::format("{} in {} stages", s.tried_per_stage, s.stages),
             "2^62 in all");
    }
    if (s.stages < 0 || s.stages > 1'000'000) refuse("stages", fmt::format("{}", s.stages), "0..1000000");
    if (s.frozen_stages < 1) refuse("frozen stages", fmt::format("{}", s.frozen_stages), "at least 1");
  }
};

struct Name {
  std::string_view operator()(const ConstantCooling&) const { return "constant"; }
  std::string_view operator()(const GreedyCooling&) const { return "greedy"; }
  std::string_view operator()(const HajekCooling&) const { return "hajek"; }
  std::string_view operator()(const LinearCooling&) const { return "linear"; }
  std::string_view operator()(const ExponentialCooling&) const { return "exponential"; }
  std::string_view operator()(const InverseCooling&) const { return "inverse"; }
  std::string_view operator()(const KirkpatrickCooling&) const { return "kirkpatrick"; }
};

/// base^exponent for base > 0.
double power(double base, double exponent) { return reproducible_exp(exponent * reproducible_log(base)); }

}  // namespace

double HajekCooling::at(double step) const { return c / reproducible_log(step + 2.0); }
double LinearCooling::at(double step) const { return std::max(start - slope * step, end); }
double ExponentialCooling::at(double step) const { return start * power(factor, step); }
double InverseCooling::at(double step) const { return start / (1.0 + factor * step); }
double KirkpatrickCooling::at_stage(std::int64_t stage) const {
  return std::max(start * power(factor, static_cast<double>(stage)), end);
}

std::vector<std::string_view> schedule_names() {
  return {"exponential", "kirkpatrick", "linear", "inverse", "hajek", "constant", "greedy"};
}

std::string_view name_of(const CoolingSchedule& schedule) { return std::visit(Name{}, schedule); }

void check_schedule(const CoolingSchedule& schedule) { std::visit(Check{}, schedule); }

CoolingSchedule make_schedule(std::string_view name, double start, double end, std::int64_t proposals) {
  const auto names = schedule_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    refuse("schedule", fmt::format("unknown schedule '{}'", name), fmt::format("{}", fmt::join(names, ", ")));
  }
  check_start(start);
  require(end >= 0.0 && end <= start, "end temperature", end,
          fmt::format("0..{}, the start temperature", start));
  if (end == 0.0 &&
      (name == "exponential" || name == "inverse" || name == "hajek" || name == "kirkpatrick")) {
    refuse("end temperature", fmt::format("0 with the schedule '{}'", name),
           "above 0, as this schedule never reaches 0");
  }
  if (proposals < 1 || proposals > (std::int64_t{1} << 62)) {
    refuse("budget", fmt::format("{} proposals", proposals), "1..2^62 proposals");
  }

  const auto steps = static_cast<double>(proposals);
  if (name == "exponential")
    return ExponentialCooling{start, reproducible_exp(reproducible_log(end / start) / steps)};
  if (name == "linear") return LinearCooling{start, (start - end) / steps, end};
  if (name == "inverse") return InverseCooling{start, (start / end - 1.0) / steps};
  if (name == "hajek") return HajekCooling{end * reproducible_log(steps + 2.0)};
  if (name == "constant") return ConstantCooling{end};
  if (name == "greedy") return GreedyCooling{};
  constexpr int kStages = 100;
  const std::int64_t share = std::max<std::int64_t>(1, proposals / kStages);
  // A run that does not cool at all still needs a factor below 1.
  const double factor =
      std::min(reproducible_exp(reproducible_log(end / start) / (kStages - 1)), 1.0 - 0x1p-40);
  return KirkpatrickCooling{.start = start,
                            .factor = factor,
                            .accepted_per_stage = share / 500 + 1,
                            .tried_per_stage = share,
                            .frozen_stages = 3,
                            .end = end,
                            .stages = kStages};
}

Cooling::Cooling(const CoolingSchedule& schedule) : schedule_(schedule) { check_schedule(schedule_); }

double Cooling::temperature() const {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.at_stage(0); }) {
          return s.at_stage(progress_.stage);
        } else {
          return s.at(static_cast<double>(progress_.step));
        }
      },
      schedule_);
}

void Cooling::advance(std::int64_t proposals, std::int64_t accepted, std::int64_t changed) {
  progress_.step += proposals;
  const auto* stages = std::get_if<KirkpatrickCooling>(&schedule_);
  if (stages == nullptr) return;
  progress_.tried += proposals;
  progress_.accepted += accepted;
  progress_.changed += changed;
  std::int64_t cap = stages->tried_per_stage;
  if (stages->stages > 0) {
    const std::int64_t before = progress_.step - progress_.tried;
    cap = (stages->tried_per_stage * stages->stages - before) /
          std::max<std::int64_t>(1, stages->stages - progress_.stage);
  }
  if (progress_.accepted < stages->accepted_per_stage && progress_.tried < cap) return;
  progress_.frozen_stages = progress_.changed == 0 ? progress_.frozen_stages + 1 : 0;
  ++progress_.stage;
  progress_.tried = progress_.accepted = progress_.changed = 0;
}

bool Cooling::frozen() const {
  const auto* stages = std::get_if<KirkpatrickCooling>(&schedule_);
  return stages != nullptr && progress_.frozen_stages >= stages->frozen_stages;
}

}  // namespace bn
