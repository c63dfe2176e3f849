// Cooling schedules: the formulas of bn/anneal.h, their checks, and the parameters that make them
// comparable. Powers go through reproducible_exp and reproducible_log: a temperature that differed in its
// last bit between C libraries would move an acceptance threshold and with it a baked texture.

#include "anneal/cooling.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/refuse.h"
#include "core/reproducible_math.h"

namespace bn {
namespace {

void require(bool in_range, std::string_view where, double value, std::string_view limit) {
  if (!in_range) refuse(std::string(where), fmt::format("{}", value), std::string(limit));
}

void check_start(double start) {
  require(start > 0.0 && std::isfinite(start), "start_temperature", start, "above 0, finite");
}

struct Check {
  void operator()(const ConstantCooling& s) const {
    require(s.temperature >= 0.0, "temperature", s.temperature, "0 or above; infinity accepts everything");
  }
  void operator()(const GreedyCooling&) const {}
  void operator()(const HajekCooling& s) const {
    require(s.c > 0.0 && std::isfinite(s.c), "hajek_c", s.c, "above 0, finite");
  }
  void operator()(const LinearCooling& s) const {
    check_start(s.start);
    require(s.slope >= 0.0 && std::isfinite(s.slope), "slope", s.slope, "0 or above, finite");
    require(s.end >= 0.0 && s.end <= s.start, "end_temperature", s.end,
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
    require(s.end >= 0.0 && s.end <= s.start, "end_temperature", s.end,
            fmt::format("0..{}, the start temperature", s.start));
    if (s.accepted_per_stage < 1)
      refuse("accepted_per_stage", fmt::format("{}", s.accepted_per_stage), "at least 1");
    if (s.tried_per_stage < 1) refuse("tried_per_stage", fmt::format("{}", s.tried_per_stage), "at least 1");
    if (s.stages > 0 && s.tried_per_stage > (std::int64_t{1} << 62) / s.stages) {
      refuse("tried_per_stage", fmt::format("{} in {} stages", s.tried_per_stage, s.stages), "2^62 in all");
    }
    if (s.stages < 0 || s.stages > 1'000'000) refuse("stages", fmt::format("{}", s.stages), "0..1000000");
    if (s.frozen_stages < 1) refuse("frozen_stages", fmt::format("{}", s.frozen_stages), "at least 1");
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

namespace {

/// Parameters belong to their schedules and have their ranges.
void check_parameters(std::string_view name, const ScheduleParameters& p) {
  const auto belongs = [&](bool given, const char* where, std::initializer_list<std::string_view> schedules) {
    if (!given || std::find(schedules.begin(), schedules.end(), name) != schedules.end()) return;
    refuse(where, fmt::format("given with the schedule '{}'", name),
           fmt::format("only with {}", fmt::join(schedules, ", ")));
  };
  belongs(p.factor.has_value(), "factor", {"exponential", "inverse", "kirkpatrick"});
  belongs(p.slope.has_value(), "slope", {"linear"});
  belongs(p.hajek_c.has_value(), "hajek_c", {"hajek"});
  belongs(p.stages.has_value(), "stages", {"kirkpatrick"});
  belongs(p.accepted_per_stage.has_value(), "accepted_per_stage", {"kirkpatrick"});
  belongs(p.tried_per_stage.has_value(), "tried_per_stage", {"kirkpatrick"});
  belongs(p.frozen_stages.has_value(), "frozen_stages", {"kirkpatrick"});
  // An inverse schedule could have more than 1, and would be cold after its first step.
  if (p.factor) require(*p.factor > 0.0 && *p.factor <= 1.0, "factor", *p.factor, "above 0, at most 1");
  if (p.stages && *p.stages < 1) refuse("stages", fmt::format("{}", *p.stages), "1..1000000");
}

KirkpatrickCooling kirkpatrick(double start, double end, std::int64_t proposals,
                               const ScheduleParameters& p) {
  constexpr int kStages = 100;
  KirkpatrickCooling schedule{.start = start, .end = end};
  schedule.stages = p.stages.value_or(p.tried_per_stage ? 0 : kStages);
  schedule.tried_per_stage =
      p.tried_per_stage.value_or(std::max<std::int64_t>(1, proposals / std::max(1, schedule.stages)));
  schedule.accepted_per_stage = p.accepted_per_stage.value_or(schedule.tried_per_stage / 500 + 1);
  schedule.frozen_stages = p.frozen_stages.value_or(3);
  const std::int64_t count =
      schedule.stages > 0 ? schedule.stages : proposals / std::max<std::int64_t>(1, schedule.tried_per_stage);
  // A run that does not cool at all still needs a factor below 1.
  schedule.factor =
      p.factor.value_or(std::min(reproducible_exp(reproducible_log(end / start) /
                                                  static_cast<double>(std::max<std::int64_t>(1, count - 1))),
                                 1.0 - 0x1p-40));
  return schedule;
}

}  // namespace

CoolingSchedule make_schedule(std::string_view name, double start, double end, std::int64_t proposals,
                              const ScheduleParameters& parameters) {
  const auto names = schedule_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    refuse("schedule", fmt::format("unknown schedule '{}'", name), fmt::format("{}", fmt::join(names, ", ")));
  }
  check_parameters(name, parameters);
  check_start(start);
  require(end >= 0.0 && end <= start, "end_temperature", end,
          fmt::format("0..{}, the start temperature", start));
  if (end == 0.0 &&
      (name == "exponential" || name == "inverse" || name == "hajek" || name == "kirkpatrick")) {
    refuse("end_temperature", fmt::format("0 with the schedule '{}'", name),
           "above 0, as this schedule never reaches 0");
  }
  if (proposals < 1 || proposals > (std::int64_t{1} << 62)) {
    refuse("proposals", fmt::format("a budget of {}", proposals), "1..2^62 proposals");
  }

  const auto steps = static_cast<double>(proposals);
  const ScheduleParameters& p = parameters;
  CoolingSchedule schedule = GreedyCooling{};
  if (name == "exponential") {
    schedule =
        ExponentialCooling{start, p.factor.value_or(reproducible_exp(reproducible_log(end / start) / steps))};
  } else if (name == "linear") {
    schedule = LinearCooling{start, p.slope.value_or((start - end) / steps), end};
  } else if (name == "inverse") {
    schedule = InverseCooling{start, p.factor.value_or((start / end - 1.0) / steps)};
  } else if (name == "hajek") {
    schedule = HajekCooling{p.hajek_c.value_or(end * reproducible_log(steps + 2.0))};
  } else if (name == "constant") {
    schedule = ConstantCooling{end};
  } else if (name == "kirkpatrick") {
    schedule = kirkpatrick(start, end, proposals, p);
  }
  check_schedule(schedule);
  return schedule;
}

namespace anneal {

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

}  // namespace anneal

}  // namespace bn
