// What a run is made from: the parameters of the Run view, and the column that shows them.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bn/bake.h"
#include "bn/error.h"
#include "ui/source.h"

namespace bn::ui {

class Parameters;

struct RunSettings {
  // the image
  bool bakes_mask = true;
  std::int64_t mask_width = 64, mask_height = 64;
  double mask_sigma_px = 1.9;
  std::int64_t mask_seed = 1;
  std::filesystem::path file;
  int channel = 0;
  // the energy
  bool auto_step = true;
  std::int64_t step_x = 48, step_y = 36;
  int radius = 6;
  int reach = 0;                 ///< as Reach
  int metric = 0;                ///< as Metric; 2: L2 of the residual
  double residual_sigma_px = 1;  ///< of that
  int motion_x = 0, motion_y = 0;
  bool wraps = true;
  // annealing
  int schedule = 0;                                                       ///< index into schedule_names()
  int start_rule = 0;                                                     ///< as StartTemperature::Rule
  std::optional<double> start_temperature = 3.0, start_acceptance = 0.2;  ///< of those rules
  std::optional<double> end_temperature = {};                             ///< none: automatic
  std::array<ScheduleParameters, std::variant_size_v<CoolingSchedule>> constants =
      {};  ///< of schedule_names()
  double proposals = 1e9;
  std::int64_t seed = 1;
  int threads = 1;

  void parameters(Parameters& p);

  SourceChoice source() const;
  Offset step() const;
  RetargetOptions retarget(const Source& source) const;
  AnnealProblem problem(const Source& source) const;  ///< a copy of the levels: not for every frame
  AnnealOptions options() const;
  std::string schedule_name() const;
  /// "exponential, 1e9 proposals, seed 1".
  std::string text() const;
  /// All that decides a run: two are equal iff their runs are.
  std::string all_text() const;
  /// The same run as a recipe has it, for a tile at `file`: where `result` is of a run that was not finished,
  /// ended where that one is. Errors: invalid_input, saying what recipes cannot.
  RetargetEntry entry(const AnnealResult& result, const std::filesystem::path& file) const;
};

/// What settings make of an image before any run.
struct Plan {
  TemperatureRange temperatures;
  CoolingSchedule schedule;
  std::int64_t proposals = 0;  ///< that it cools over: the last 64th of the budget is spent at temperature 0
};

/// Errors: as anneal_retarget() of these. May take a trial run: off the window's thread.
Plan plan_of(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution = {});

/// The widgets of these settings, one group each. `source` may be null.
void draw_image_settings(RunSettings& settings, const Source* source);
void draw_energy_settings(RunSettings& settings, const Source* source);
/// `plan`: what the settings came to; null: nothing yet. `refusal`: what the library says against them, which
/// is shown below the setting in question; null: nothing.
void draw_schedule_settings(RunSettings& settings, const Plan* plan, const ErrorInfo* refusal);

/// The formula of a schedule, and what stands in it.
struct Formula {
  std::string text;
  std::vector<std::string> where;
};
Formula formula_of(const CoolingSchedule& schedule);

/// The temperature at each of `count` steps, evenly over a run, as it is planned: stages at their longest.
struct PlannedCurve {
  std::vector<double> proposals, temperature;
};
PlannedCurve planned_curve(const Plan& plan, int count);

}  // namespace bn::ui
