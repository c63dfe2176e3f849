// The curves of annealing runs, as figures for plots.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "ui/optimum.h"
#include "ui/plot.h"
#include "ui/run.h"
#include "ui/run_settings.h"

namespace bn::ui {

/// A run with all that it came from. The Run view shows one, the Compare view keeps several.
struct RunEntry {
  int number = 0;  ///< counted from 1 in the session
  std::shared_ptr<const Source> source;
  RunSettings settings;
  std::string settings_text;  ///< RunSettings::all_text()
  std::shared_ptr<Run> run;
  std::shared_ptr<Optimum> optimum;  ///< null: this energy has no exact solver

  std::string name() const;  ///< "#2 exponential"
};

/// What a run has come to: the best once it has ended, else where it stands.
struct RunStanding {
  std::int64_t energy = 0;
  double seconds = 0.0;
  std::int64_t proposals = 0;
};
RunStanding standing_of(const RunEntry& entry);

/// A run as it is drawn.
struct DrawnRun {
  const RunEntry* entry;
  ImU32 colour;
};

/// What curves are drawn over.
enum class Over { proposals, seconds };

Figure energy_figure(std::span<const DrawnRun> runs, Over over = Over::proposals);
Figure temperature_figure(std::span<const DrawnRun> runs, Over over = Over::proposals);
/// Of all proposals; of a run alone, also of the worsening ones.
Figure acceptance_figure(std::span<const DrawnRun> runs, Over over = Over::proposals);
inline constexpr const char* kSurfaceTitle =
    "Accepted share of worsening swaps, by the rise of energy (hatched: too few tried)";
/// Accepted share of worsening swaps over the run and their size.
Figure surface_figure(const RunEntry& entry);

/// How far an energy is above the proven optimum, in percent. None:
/// there is no optimum, or it is 0.
std::optional<double> gap_percent(const RunEntry& entry, std::int64_t energy);

}  // namespace bn::ui
