#include "ui/run_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/parameters.h"
#include "ui/plot.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

using Rule = StartTemperature::Rule;

constexpr double kMostProposals = 1e15;
constexpr double kHottest = 1e15;

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
  constexpr std::int64_t kMostSide = 16384, kMostSeed = std::numeric_limits<std::int64_t>::max();
  p("run.bake", bakes_mask);
  p("run.mask.width", mask_width, 1, kMostSide);
  p("run.mask.height", mask_height, 1, kMostSide);
  p("run.mask.sigma", mask_sigma_px, 0.3, 16.0);
  p("run.mask.seed", mask_seed, 0, kMostSeed);
  p("run.image", file);
  p("run.channel", channel, 0, 63);
  p("run.step.auto", auto_step);
  p("run.step.x", step_x, -65536, 65536);
  p("run.step.y", step_y, -65536, 65536);
  p("run.radius", radius, 1, 32);
  p("run.reach", reach, 0, 1);
  p("run.metric", metric, 0, 2);
  p("run.residual_sigma", residual_sigma_px, 0.3, 8.0);
  p("run.motion.x", motion_x, -127, 127);
  p("run.motion.y", motion_y, -127, 127);
  p("run.wrap", wraps);
  p("run.schedule", schedule, 0, static_cast<int>(schedules().size()) - 1);
  p("run.start.rule", start_rule, 0, 3);
  p("run.start.temperature", start_temperature, 1e-9, kHottest);
  p("run.start.acceptance", start_acceptance, 0.001, 0.999);
  p("run.end.auto", auto_end);
  p("run.end.temperature", end_temperature, 1e-9, kHottest);
  p("run.proposals", proposals, 1.0, kMostProposals);
  p("run.seed", seed, 0, kMostSeed);
  p("run.threads", threads, 1, 64);
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

AnnealProblem RunSettings::problem(const Source& source) const {
  AnnealProblem problem;
  problem.channels = {{source.levels.value}};
  problem.retarget.step = auto_step ? bn::auto_step(source.levels.value.size()).step : Offset{step_x, step_y};
  problem.retarget.motion = {motion_x, motion_y};
  problem.retarget.radius = radius;
  problem.retarget.reach = static_cast<Reach>(reach);
  problem.retarget.metric = metric == 0 ? Metric::l1 : Metric::l2;
  problem.retarget.wrap = wraps;
  if (metric == 2) problem.residual_sigma_px = residual_sigma_px;
  return problem;
}

AnnealOptions RunSettings::options() const {
  AnnealOptions options;
  options.schedule = schedule_name();
  options.start.rule = static_cast<Rule>(start_rule);
  options.start.value = options.start.rule == Rule::acceptance ? start_acceptance : start_temperature;
  options.end_temperature = auto_end ? 0.0 : end_temperature;
  options.proposals = static_cast<std::int64_t>(std::clamp(proposals, 1.0, kMostProposals));
  options.seed = static_cast<std::uint64_t>(seed);
  return options;
}

std::string RunSettings::schedule_name() const { return schedules().at(static_cast<std::size_t>(schedule)); }

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
  if (metric == 2)
    refuse("a filtered residual, which recipes do not know", "anneal with L1 or L2 to save a texture");
  const int range = std::max(std::abs(motion_x), std::abs(motion_y));
  constexpr int kMostMotion = 8;
  if (range > kMostMotion) {
    refuse(fmt::format("motion ({}, {})", motion_x, motion_y),
           "recipes go up to 8 pixels; choose a smaller motion");
  }
  RetargetEntry entry;
  entry.name = tile.stem().string();
  entry.channel = bakes_mask ? 0 : channel;
  if (!auto_step) entry.step = Offset{step_x, step_y};
  entry.options.radius = radius;
  entry.options.reach = static_cast<Reach>(reach);
  entry.options.metric = static_cast<Metric>(metric);
  entry.options.wrap = wraps;
  entry.motion = range;
  entry.outputs = {{.path = tile.string(), .motion = {motion_x, motion_y}}};
  AnnealMethod method;
  method.options = options();
  method.options.checkpoint = {};
  // Where the temperatures came from a sample, those that it came to.
  if (options().start.rule == Rule::everything)
    method.options.start = {Rule::given, result.start_temperature};
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
    field("Width", s.mask_width, 1, 16384, "Pixels, 1..16384");
    field("Height", s.mask_height, 1, 16384, "Pixels, 1..16384");
    slider("Sigma", s.mask_sigma_px, 0.5, 4.0, "%.2f px", false,
           "Of the Gaussian of void-and-cluster, in pixels; 1.9 suits most");
    field("Mask seed", s.mask_seed, 0, std::numeric_limits<std::int64_t>::max(),
          "Equal seeds give equal masks");
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
    slider("Step x", s.step_x, 0, 255, "How far the mask moves to the right from frame to frame, in pixels");
    slider("Step y", s.step_y, 0, 255, "How far the mask moves down from frame to frame, in pixels");
  }
  slider("Radius", s.radius, 1, 32, "The farthest a seed may move, in pixels");
  static constexpr const char* kShapes[] = {"Square", "Disc"};
  choice("Shape", kShapes, s.reach, "How the radius is measured: Chebyshev or Euclidean");
  static constexpr const char* kMetrics[] = {"L1", "L2", "Blurred"};
  choice("Metric", kMetrics, s.metric,
         "Cost of a difference of levels: its size, its square, or the square of what a blur leaves of all "
         "differences; the "
         "last has no exact solver");
  if (s.metric == 2)
    slider("Blur", s.residual_sigma_px, 0.3, 8.0, "%.2f px", false, "Standard deviation of that blur");
  slider("Motion x", s.motion_x, -8, 8, "How far the picture moves to the right from frame to frame");
  slider("Motion y", s.motion_y, -8, 8, "How far the picture moves down from frame to frame");
}

void draw_schedule_settings(RunSettings& s) {
  heading("Annealing");
  combo("Schedule", schedules(), s.schedule, "How the temperature falls");
  static constexpr const char* kRules[] = {"Auto", "T", "Accept", "All"};
  choice("Start", kRules, s.start_rule,
         "The first temperature: from the image; a number; one that accepts a share of the worsening swaps; "
         "one that accepts "
         "nearly all");
  if (s.start_rule == 1)
    field("Start T", s.start_temperature, 1e-9, kHottest, "%.6g", "In units of the energy");
  if (s.start_rule == 2)
    slider("Accepted", s.start_acceptance, 0.001, 0.999, "%.3f", true,
           "Share of worsening swaps accepted at first");
  checkbox("Auto end", s.auto_end, "The last temperature from the image");
  if (!s.auto_end) field("End T", s.end_temperature, 1e-9, kHottest, "%.6g", "At most the start");
  field("Proposals", s.proposals, 1.0, kMostProposals, "%.6g",
        "The budget: pairs of seeds that are tried, such as 1e9");
  field("Seed", s.seed, 0, std::numeric_limits<std::int64_t>::max(), "Of annealing's random numbers");
  slider("Threads", s.threads, 1, 16, "Useful from 128 rows on; they change no byte");
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

PlannedCurve planned_curve(const CoolingSchedule& schedule, std::int64_t proposals, int count) {
  PlannedCurve curve;
  for (int i = 0; i < count; ++i) {
    const double step = static_cast<double>(proposals) * i / (count - 1);
    const double temperature = std::visit(
        [&](const auto& s) {
          if constexpr (requires { s.at_stage(0); }) {
            return s.at_stage(static_cast<std::int64_t>(step / static_cast<double>(s.tried_per_stage)));
          } else {
            return s.at(step);
          }
        },
        schedule);
    curve.proposals.push_back(step);
    curve.temperature.push_back(temperature);
  }
  return curve;
}

}  // namespace bn::ui
