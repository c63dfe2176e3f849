#include "ui/run_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bn/palette.h"
#include "ui/theme.h"

namespace bn::ui {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// The trace with what came after its last point.
std::vector<TracePoint> points_of(const RunEntry& entry) {
  const AnnealTrace& trace = entry.run->trace();
  const std::size_t size = trace.size();
  std::vector<TracePoint> points;
  points.reserve(size + 1);
  for (std::size_t i = 0; i < size; ++i) points.push_back(trace[i]);
  const AnnealState now = entry.run->standing().state;
  if (!points.empty() && now.proposals > points.back().proposals) {
    TracePoint last{.proposals = now.proposals,
                    .seconds = now.seconds,
                    .temperature = now.temperature,
                    .energy = now.energy,
                    .best_energy = now.best_energy,
                    .accepted_share = kNothing};
    points.push_back(last);
  }
  return points;
}

Figure figure(std::string title, std::string y, bool logarithmic) {
  Figure figure;
  figure.title = std::move(title);
  figure.x.name = "proposals";
  figure.x.low = 0.0;
  figure.y.name = std::move(y);
  figure.y.logarithmic = logarithmic;
  figure.empty = "starts with the run";
  return figure;
}

/// Shows the whole budget from the start, so that the curve grows into the plot.
void span_budget(Figure& figure, std::span<const DrawnRun> runs, Over over) {
  figure.x.name = over == Over::proposals ? "proposals" : "seconds";
  if (over == Over::seconds) return;
  double most = 0.0;
  for (const DrawnRun& r : runs) {
    const Standing standing = r.entry->run->standing();
    const bool goes_on = standing.phase < Phase::finished;
    most = std::max(most, static_cast<double>(goes_on ? r.entry->run->setup().options.proposals
                                                      : standing.state.proposals));
  }
  if (most > 0.0) figure.x.high = most;
}

template <class Value>
Curve curve_of(const DrawnRun& run, Over over, std::string name, Value value) {
  Curve curve;
  curve.name = std::move(name);
  curve.colour = run.colour;
  for (const TracePoint& point : points_of(*run.entry)) {
    curve.x.push_back(over == Over::proposals ? static_cast<double>(point.proposals) : point.seconds);
    curve.y.push_back(value(point));
  }
  return curve;
}

std::int64_t sum(const std::array<std::int64_t, kWorseningClasses>& counts) {
  std::int64_t total = 0;
  for (const auto count : counts) total += count;
  return total;
}

}  // namespace

std::string RunEntry::name() const { return fmt::format("#{} {}", number, settings.schedule_name()); }

RunStanding standing_of(const RunEntry& entry) {
  const Standing standing = entry.run->standing();
  const auto result = entry.run->has_ended() ? entry.run->result() : nullptr;
  return {result ? result->tile.energy : standing.state.energy, standing.state.seconds,
          standing.state.proposals};
}

std::optional<double> gap_percent(const RunEntry& entry, std::int64_t energy) {
  const RetargetTile* tile = entry.optimum ? entry.optimum->tile() : nullptr;
  if (tile == nullptr || tile->energy <= 0) return {};
  return 100.0 * (static_cast<double>(energy) / static_cast<double>(tile->energy) - 1.0);
}

Figure energy_figure(std::span<const DrawnRun> runs, Over over) {
  Figure result = figure("Energy", "energy", true);
  span_budget(result, runs, over);
  for (const DrawnRun& run : runs) {
    result.curves.push_back(curve_of(run, over, runs.size() == 1 ? "energy" : run.entry->name(),
                                     [](const TracePoint& p) { return static_cast<double>(p.energy); }));
  }
  // The fall of the first moment would leave no room for all that follows.
  constexpr std::size_t kManyPoints = 20;
  double most = 0.0;
  for (const Curve& curve : result.curves) {
    if (curve.y.size() > 1) most = std::max(most, curve.y[curve.y.size() > kManyPoints ? 1 : 0]);
  }
  if (most > 0.0) result.y.high = 1.1 * most;
  std::vector<std::int64_t> optima;
  for (const DrawnRun& run : runs) {
    const RetargetTile* tile = run.entry->optimum ? run.entry->optimum->tile() : nullptr;
    if (tile == nullptr || std::find(optima.begin(), optima.end(), tile->energy) != optima.end()) continue;
    optima.push_back(tile->energy);
    result.levels.push_back({.name = fmt::format("optimum {}", tile->energy),
                             .colour = palette().good,
                             .y = static_cast<double>(tile->energy)});
  }
  return result;
}

Figure temperature_figure(std::span<const DrawnRun> runs, Over over) {
  Figure result = figure("Temperature", "temperature", true);
  span_budget(result, runs, over);
  for (const DrawnRun& run : runs) {
    result.curves.push_back(curve_of(run, over, runs.size() == 1 ? "temperature" : run.entry->name(),
                                     [](const TracePoint& p) { return p.temperature; }));
  }
  return result;
}

Figure acceptance_figure(std::span<const DrawnRun> runs, Over over) {
  Figure result = figure("Accepted", "accepted share", true);
  span_budget(result, runs, over);
  for (const DrawnRun& run : runs) {
    const auto points = points_of(*run.entry);
    const bool alone = runs.size() == 1;
    result.curves.push_back(
        curve_of(run, over, alone ? "of all" : run.entry->name(),
                 [](const TracePoint& p) { return p.proposals == 0 ? kNothing : p.accepted_share; }));
    if (!alone) continue;
    // Only watched sweeps tell, and one tells little: a point is a stretch of the run in which a few were
    // accepted.
    constexpr double kMostPoints = 64;
    std::int64_t seen = 0;
    for (const TracePoint& p : points) seen += sum(p.worsening_accepted);
    const std::int64_t few = std::clamp<std::int64_t>(seen / 8, 4, 16);
    Curve worse;
    worse.name = "of worsening";
    worse.colour = curve_colour(schedule_colour_number(run.entry->settings.schedule_name()) + 1);
    const double budget = static_cast<double>(run.entry->run->setup().options.proposals);
    std::int64_t tried = 0, accepted = 0;
    double last = 0.0;
    for (const TracePoint& p : points) {
      tried += sum(p.worsening_tried);
      accepted += sum(p.worsening_accepted);
      const auto at = static_cast<double>(p.proposals);
      if (accepted < few || at - last < budget / kMostPoints) continue;
      worse.x.push_back(0.5 * (at + last));
      worse.y.push_back(static_cast<double>(accepted) / static_cast<double>(tried));
      tried = accepted = 0;
      last = at;
    }
    result.curves.push_back(std::move(worse));
  }
  return result;
}

Figure surface_figure(const RunEntry& entry) {
  constexpr int kMostStretches = 32, kFewestStretches = 8;
  constexpr std::int64_t kFewest = 8;  // tried, to say a share
  Figure result = figure(kSurfaceTitle, "rise", false);
  const double budget = static_cast<double>(entry.run->setup().options.proposals);
  std::array<std::array<std::int64_t, kWorseningClasses>, kMostStretches> tried{}, accepted{};
  std::array<std::int64_t, kWorseningClasses> total{};
  const auto points = points_of(entry);
  // A run that is short, or begins, has few watched sweeps: some for each stretch.
  const auto watched = std::count_if(points.begin(), points.end(),
                                     [](const TracePoint& p) { return sum(p.worsening_tried) > 0; });
  const double made = points.empty() ? 0.0 : static_cast<double>(points.back().proposals) / budget;
  const int stretches =
      std::clamp(made > 0.0 ? static_cast<int>(static_cast<double>(watched) / made / 4.0) : 0,
                 kFewestStretches, kMostStretches);
  for (const TracePoint& p : points) {
    const auto stretch = static_cast<std::size_t>(
        std::min(stretches - 1, static_cast<int>(static_cast<double>(p.proposals) / budget * stretches)));
    for (std::size_t i = 0; i < kWorseningClasses; ++i) {
      tried[stretch][i] += p.worsening_tried[i];
      accepted[stretch][i] += p.worsening_accepted[i];
      total[i] += p.worsening_tried[i];
    }
  }
  std::size_t first = 0, last = kWorseningClasses;
  while (first < last && total[first] < kFewest) ++first;
  while (last > first && total[last - 1] < kFewest) --last;
  HeatMap heat;
  heat.columns = stretches;
  heat.x = {0.0, budget};
  heat.colours = {1e-3, 1.0};
  heat.logarithmic = true;
  std::vector<std::string> words;
  for (std::size_t i = first; i < last; ++i) {
    heat.rows.push_back(short_number(static_cast<double>(std::int64_t{1} << i)));
    for (std::size_t s = 0; s < static_cast<std::size_t>(stretches); ++s) {
      const bool known = tried[s][i] >= kFewest;
      heat.values.push_back(known ? static_cast<double>(accepted[s][i]) / static_cast<double>(tried[s][i])
                                  : kNothing);
      words.push_back(known ? fmt::format("{} of {} accepted", accepted[s][i], tried[s][i])
                            : fmt::format("{} tried: too few to say", tried[s][i]));
    }
  }
  heat.describe = [words, first, stretches](int column, int row) {
    const std::int64_t from = std::int64_t{1} << (first + static_cast<std::size_t>(row));
    return fmt::format("rise {}..{}\n{}", from, 2 * from - 1,
                       words[static_cast<std::size_t>(row * stretches + column)]);
  };
  if (!heat.rows.empty()) result.heat = std::move(heat);
  return result;
}

}  // namespace bn::ui
