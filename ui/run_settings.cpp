#include "ui/run_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bn/error.h"
#include "ui/declared.h"
#include "ui/parameters.h"
#include "ui/plot.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

using Rule = StartTemperature::Rule;

constexpr double kAny = std::numeric_limits<double>::max();
constexpr double kLeastBlur = 0.3;  ///< the option's own least, 0, is "none"
constexpr int kMostThreads = 64;

const std::vector<std::string>& schedules() {
  static const std::vector<std::string> names = [] {
    const auto views = schedule_names();
    return std::vector<std::string>(views.begin(), views.end());
  }();
  return names;
}

/// "0.98", or "1 − 2.5e-9" where the first digits would say nothing.
std::string factor_text(double factor) {
  return factor > 0.999 && factor < 1.0 ? fmt::format("1 − {}", short_number(1.0 - factor))
                                        : fmt::format("{:.6g}", factor);
}

}  // namespace

void RunSettings::parameters(Parameters& p) {
  const auto whole = [&](const char* name, auto& value, const Option& option) {
    using Number = std::remove_reference_t<decltype(value)>;
    p(name, value, static_cast<Number>(option.least), static_cast<Number>(option.most));
  };
  p("run.bake", bakes_mask);
  whole("run.mask.width", mask_width, declared("mask", "size"));
  whole("run.mask.height", mask_height, declared("mask", "size"));
  const Option& sigma = declared("mask", "sigma");
  p("run.mask.sigma", mask_sigma_px, sigma.least_real, sigma.most_real);
  whole("run.mask.seed", mask_seed, declared("mask", "seed"));
  p("run.image", file);
  whole("run.channel", channel, declared("retarget", "channel"));
  p("run.step.auto", auto_step);
  whole("run.step.x", step_x, declared("retarget", "step"));
  whole("run.step.y", step_y, declared("retarget", "step"));
  whole("run.radius", radius, declared("retarget", "radius"));
  p("run.reach", reach, 0, 1);
  p("run.metric", metric, 0, 2);
  p("run.residual_sigma", residual_sigma_px, kLeastBlur, declared("retarget", "residual_sigma").most_real);
  const int most_motion = static_cast<int>(declared("retarget", "motion").most);
  p("run.motion.x", motion_x, -most_motion, most_motion);
  p("run.motion.y", motion_y, -most_motion, most_motion);
  p("run.wrap", wraps);
  p("run.schedule", schedule, 0, static_cast<int>(schedules().size()) - 1);
  p("run.start.rule", start_rule, 0, 3);
  p("run.start.temperature", start_temperature);
  p("run.start.acceptance", start_acceptance);
  p("run.end.temperature", end_temperature);
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const auto name = [&](const char* key) { return "run." + schedules().at(i) + "." + key; };
    ScheduleParameters& c = constants[i];
    p(name("factor").c_str(), c.factor);
    p(name("slope").c_str(), c.slope);
    p(name("hajek_c").c_str(), c.hajek_c);
    p(name("stages").c_str(), c.stages);
    p(name("accepted_per_stage").c_str(), c.accepted_per_stage);
    p(name("tried_per_stage").c_str(), c.tried_per_stage);
    p(name("frozen_stages").c_str(), c.frozen_stages);
  }
  p("run.proposals", proposals, -kAny, kAny);
  whole("run.seed", seed, declared("retarget", "seed"));
  p("run.threads", threads, 1, kMostThreads);
}

SourceChoice RunSettings::source() const {
  SourceChoice choice;
  choice.baked = bakes_mask;
  if (bakes_mask) {
    choice.mask.size = {static_cast<int>(mask_width), static_cast<int>(mask_height)};
    choice.mask.sigma_px = mask_sigma_px;
    choice.mask.seed = static_cast<std::uint64_t>(mask_seed);
  } else {
    choice.file = file;
    choice.channel = channel;
  }
  return choice;
}

Offset RunSettings::step() const { return {static_cast<int>(step_x), static_cast<int>(step_y)}; }

RetargetOptions RunSettings::retarget(const Source& source) const {
  RetargetOptions options;
  options.step = auto_step ? bn::auto_step(source.levels.value.size()).step : step();
  options.motion = {motion_x, motion_y};
  options.radius = radius;
  options.reach = static_cast<Reach>(reach);
  options.metric = metric == 0 ? Metric::l1 : Metric::l2;
  options.wrap = wraps;
  return options;
}

AnnealProblem RunSettings::problem(const Source& source) const {
  AnnealProblem problem;
  problem.channels = {{source.levels.value}};
  problem.retarget = retarget(source);
  if (metric == 2) problem.residual_sigma_px = residual_sigma_px;
  return problem;
}

AnnealOptions RunSettings::options() const {
  AnnealOptions options;
  options.schedule = schedule_name();
  options.parameters = constants.at(static_cast<std::size_t>(schedule));
  options.start.rule = static_cast<Rule>(start_rule);
  options.start.value =
      (options.start.rule == Rule::acceptance ? start_acceptance : start_temperature).value_or(0.0);
  options.end_temperature = end_temperature.value_or(0.0);
  options.proposals = static_cast<std::int64_t>(std::clamp(proposals, -0x1p62, 0x1p63 - 1024.0));
  options.seed = static_cast<std::uint64_t>(seed);
  return options;
}

std::string RunSettings::schedule_name() const { return schedules().at(static_cast<std::size_t>(schedule)); }

std::string RunSettings::all_text() const {
  Settings all;
  Parameters saving = Parameters::saving(all);
  const_cast<RunSettings*>(this)->parameters(saving);
  all.erase("run.threads");  // which change no byte
  std::string text;
  for (const auto& [name, value] : all) text += name + '=' + value + '\n';
  return text;
}

std::string RunSettings::text() const {
  return fmt::format("{}, {} proposals, seed {}", schedule_name(), short_number(proposals), seed);
}

RetargetEntry RunSettings::entry(const AnnealResult& result, const std::filesystem::path& tile) const {
  const auto refuse = [&](std::string what, std::string remedy) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::move(what),
                 .where = tile.string(),
                 .limit = "what a recipe can make again",
                 .remedy = std::move(remedy)});
  };
  const int range = std::max(std::abs(motion_x), std::abs(motion_y));
  const std::int64_t most = declared("retarget", "motion").most;
  if (range > most) {
    refuse(fmt::format("motion ({}, {})", motion_x, motion_y),
           fmt::format("recipes go up to {} pixels; choose a smaller motion", most));
  }
  RetargetEntry entry;
  entry.name = tile.stem().string();
  entry.channel = bakes_mask ? 0 : channel;
  if (!auto_step) entry.step = step();
  entry.problem.radius = radius;
  entry.problem.reach = static_cast<Reach>(reach);
  entry.problem.metric = metric == 0 ? Metric::l1 : Metric::l2;
  entry.problem.wrap = wraps;
  entry.motion = range;
  entry.outputs = {{.path = tile.string(), .motion = {motion_x, motion_y}}};
  AnnealMethod method;
  method.options = options();
  if (metric == 2) method.residual_sigma_px = residual_sigma_px;
  if (!result.frozen && result.proposals < method.options.proposals)
    method.options.stop_after = result.proposals;
  entry.anneals = true;
  entry.anneal = method;
  return entry;
}

void draw_image_settings(RunSettings& s, const Source* source) {
  heading("Image");
  static constexpr const char* kFrom[] = {"Bake", "File"};
  int from = s.bakes_mask ? 0 : 1;
  if (choice("From", kFrom, from, "A void-and-cluster mask made on the spot, or an image file"))
    s.bakes_mask = from == 0;
  if (s.bakes_mask) {
    field("Width", s.mask_width, declared("mask", "size"));
    field("Height", s.mask_height, declared("mask", "size"));
    slider("Sigma", s.mask_sigma_px, declared("mask", "sigma"), "%.2f px");
    field("Mask seed", s.mask_seed, declared("mask", "seed"));
  } else {
    std::string path = s.file.string();
    if (field("Image file", path, "Any image that OpenImageIO reads; or drop a file onto the window"))
      s.file = path;
    const int most = source != nullptr && !source->choice.baked ? source->channels - 1 : 63;
    slider("Channel", s.channel, 0, std::max(most, s.channel), "0 is red");
  }
}

void draw_energy_settings(RunSettings& s, const Source* source) {
  heading("Energy");
  checkbox("Auto step", s.auto_step, "A step near the size over the plastic number, with the longest orbit");
  ImGui::SameLine(0, em(1.5f));
  checkbox("Wrap", s.wraps, "Seeds may cross the tile's border; off for a tile used alone");
  if (s.auto_step) {
    const Offset step = source != nullptr ? bn::auto_step(source->levels.value.size()).step : Offset{};
    value("Step", source != nullptr ? fmt::format("({}, {})", step.x, step.y) : "–");
  } else {
    const Option& step = declared("retarget", "step");
    field("Step x", s.step_x, step.least, step.most,
          "How far the mask moves to the right from frame to frame, in pixels");
    field("Step y", s.step_y, step.least, step.most,
          "How far the mask moves down from frame to frame, in pixels");
  }
  slider("Radius", s.radius, declared("retarget", "radius"));
  static constexpr const char* kShapes[] = {"Square", "Disc"};
  choice("Shape", kShapes, s.reach, "How the radius is measured: Chebyshev or Euclidean");
  static constexpr const char* kMetrics[] = {"L1", "L2", "Blurred"};
  choice("Metric", kMetrics, s.metric,
         "Cost of a difference of levels: its size, its square, or the square of what a blur leaves of all "
         "differences; the "
         "last has no exact solver");
  if (s.metric == 2)
    slider("Blur", s.residual_sigma_px, kLeastBlur, declared("retarget", "residual_sigma").most_real,
           "%.2f px", false, "Standard deviation of that blur");
  const int most = static_cast<int>(declared("retarget", "motion").most);
  slider("Motion x", s.motion_x, -most, most, "How far the picture moves to the right from frame to frame");
  slider("Motion y", s.motion_y, -most, most, "How far the picture moves down from frame to frame");
}

namespace {

/// "auto: 0.5" while what follows from the other settings is known.
std::string automatic(const std::optional<double>& value) {
  return value ? "auto: " + short_number(*value) : "auto";
}

/// The constants of the schedule, whichever it is.
struct Constants {
  std::optional<double> factor, slope, c, end, stages, accepted, tried, frozen;
};
Constants constants_of(const Plan& plan) {
  Constants known;
  known.end = plan.temperatures.end;
  if (const auto* s = std::get_if<ExponentialCooling>(&plan.schedule)) known.factor = s->factor;
  if (const auto* s = std::get_if<InverseCooling>(&plan.schedule)) known.factor = s->factor;
  if (const auto* s = std::get_if<LinearCooling>(&plan.schedule)) known.slope = s->slope;
  if (const auto* s = std::get_if<HajekCooling>(&plan.schedule)) known.c = s->c;
  if (const auto* s = std::get_if<KirkpatrickCooling>(&plan.schedule)) {
    known.factor = s->factor, known.frozen = s->frozen_stages;
    if (s->stages > 0) known.stages = s->stages;
    known.accepted = static_cast<double>(s->accepted_per_stage);
    known.tried = static_cast<double>(s->tried_per_stage);
  }
  return known;
}

}  // namespace

void draw_schedule_settings(RunSettings& s, const Plan* plan, const ErrorInfo* refusal) {
  const Constants known = plan != nullptr ? constants_of(*plan) : Constants{};
  ScheduleParameters& c = s.constants.at(static_cast<std::size_t>(s.schedule));
  const std::string name = s.schedule_name();
  // `where` is the setting's name in recipes, by which the library calls it.
  const auto complain_of = [&](std::string_view where) {
    if (refusal == nullptr || (refusal->where != where && !where.empty())) return;
    complaint("Refused", Error(*std::exchange(refusal, nullptr)).what());
  };
  const auto constant = [&](const char* label, const char* where, auto& value, const std::string& otherwise,
                            const char* hint) {
    field(label, value, otherwise, hint);
    complain_of(where);
  };
  heading("Annealing");
  combo("Schedule", schedules(), s.schedule, "How the temperature falls");
  static constexpr const char* kRules[] = {"Auto", "T", "Accept", "All"};
  choice("Start", kRules, s.start_rule,
         "The first temperature: from the image; a number; one that accepts a share of the worsening swaps; "
         "one that accepts nearly all");
  if (s.start_rule == 1) {
    constant("Start T", "start_temperature", s.start_temperature, "", "In units of the energy");
  } else if (s.start_rule == 2) {
    constant("Acceptance", "initial_acceptance", s.start_acceptance, "",
             "Share of the worsening swaps that are accepted at first");
  }
  complain_of("start_temperature");
  constant("End T", "end_temperature", s.end_temperature, automatic(known.end),
           "The last temperature; at most the first. Empty: from the image");
  if (name == "exponential" || name == "inverse") {
    // So near to 1, or so small, that what differs is said.
    const bool near_one = known.factor && name == "exponential" && *known.factor > 0.999;
    constant("Factor a", "factor", c.factor,
             near_one ? "auto: " + factor_text(*known.factor) : automatic(known.factor),
             "Of a proposal. Empty: the one that meets the end temperature");
  }
  if (name == "linear") {
    constant(
        "Slope μ", "slope", c.slope, automatic(known.slope),
        "By how much the temperature falls with a proposal. Empty: so that it meets the end temperature");
  }
  if (name == "hajek") {
    constant("Constant c", "hajek_c", c.hajek_c, automatic(known.c),
             "The depth of the deepest local minimum, or more, for a proof of convergence. Empty: so that it "
             "meets the end temperature");
  }
  if (name == "kirkpatrick") {
    constant("Factor a", "factor", c.factor, automatic(known.factor),
             "Of a stage, below 1. Empty: the one that meets the end temperature");
    constant("Stages", "stages", c.stages,
             known.tried && !known.stages ? "as many as it takes" : automatic(known.stages),
             "So many share the proposals: what one saves goes to those that follow");
    constant("Accepted cap", "accepted_per_stage", c.accepted_per_stage, automatic(known.accepted),
             "A stage ends after so many accepted swaps: quasi-equilibrium");
    constant("Tried cap", "tried_per_stage", c.tried_per_stage, automatic(known.tried),
             "Or after so many proposals; without stages, of each alone");
    constant("Frozen after", "frozen_stages", c.frozen_stages, automatic(known.frozen),
             "The run ends after so many stages in a row without a change");
  }
  field("Proposals", s.proposals, -kAny, kAny, "%.6g",
        "The budget: pairs of seeds that are tried, such as 1e9");
  complain_of("proposals");
  field("Seed", s.seed, declared("retarget", "seed"));
  slider("Threads", s.threads, 1, kMostThreads, "Useful from 128 rows on; they change no byte");
  complain_of("");
}

Plan plan_of(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution) {
  // An annealing that makes no step knows what it would do.
  const Annealing annealing(problem, options, execution);
  const AnnealResult result = annealing.result();
  return {{result.start_temperature, result.end_temperature},
          annealing.schedule(),
          std::max<std::int64_t>(1, options.proposals - options.proposals / 64)};
}

Formula formula_of(const CoolingSchedule& schedule) {
  struct Write {
    Formula operator()(const ConstantCooling& s) const {
      return {"T = end", {fmt::format("end = {:.4g}", s.temperature)}};
    }
    Formula operator()(const GreedyCooling&) const { return {"T = 0", {}}; }
    Formula operator()(const HajekCooling& s) const {
      return {"T(k) = c / ln(k + 2)", {fmt::format("c = {:.4g}", s.c)}};
    }
    Formula operator()(const LinearCooling& s) const {
      return {"T(k) = max(start − μ k, end)",
              {fmt::format("start = {:.4g}, end = {:.4g}", s.start, s.end),
               fmt::format("μ = {}", short_number(s.slope))}};
    }
    Formula operator()(const ExponentialCooling& s) const {
      return {"T(k) = start · a^k",
              {fmt::format("start = {:.4g}", s.start), fmt::format("a = {}", factor_text(s.factor))}};
    }
    Formula operator()(const InverseCooling& s) const {
      return {"T(k) = start / (1 + a k)",
              {fmt::format("start = {:.4g}", s.start), fmt::format("a = {}", short_number(s.factor))}};
    }
    Formula operator()(const KirkpatrickCooling& s) const {
      return {"T(s) = max(start · a^s, end) in stage s",
              {fmt::format("start = {:.4g}, end = {:.4g}", s.start, s.end),
               fmt::format("a = {}", factor_text(s.factor)),
               fmt::format("a stage ends after {} accepted or {} tried",
                           short_number(static_cast<double>(s.accepted_per_stage)),
                           short_number(static_cast<double>(s.tried_per_stage))),
               fmt::format("the run ends after {} stages without a change", s.frozen_stages)}};
    }
  };
  return std::visit(Write{}, schedule);
}

PlannedCurve planned_curve(const Plan& plan, int count) {
  PlannedCurve curve;
  for (int i = 0; i < count; ++i) {
    const double step = static_cast<double>(plan.proposals) * i / (count - 1);
    const double temperature = std::visit(
        [&](const auto& s) {
          if constexpr (requires { s.at_stage(0); }) {
            return s.at_stage(static_cast<std::int64_t>(step / static_cast<double>(s.tried_per_stage)));
          } else {
            return s.at(step);
          }
        },
        plan.schedule);
    curve.proposals.push_back(step);
    curve.temperature.push_back(temperature);
  }
  return curve;
}

}  // namespace bn::ui
