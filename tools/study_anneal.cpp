// bn study anneal: the measurements and figures of docs/annealing.md.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

#include "bn/anneal.h"
#include "bn/texture.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

struct Settings {
  std::filesystem::path image;
  std::filesystem::path out = "study-anneal";
  int channel = 0;
  std::optional<Offset> step;
  int radius = 6;
  int seeds = 5;
  int budgets = 9;
};

/// One schedule at one radius and budget, over the seeds.
struct Summary {
  double seconds = 0.0;
  double low = 0.0, median = 0.0, high = 0.0;  ///< energies
};
using SummaryKey = std::tuple<int, std::size_t, std::int64_t>;  ///< radius, schedule's place, budget

std::map<SummaryKey, Summary> summarise(const AnnealStudy& study, const std::vector<std::string>& schedules) {
  std::map<SummaryKey, std::vector<const AnnealStudyRun*>> groups;
  for (const auto& run : study.runs) {
    const auto place = std::find(schedules.begin(), schedules.end(), run.schedule) - schedules.begin();
    groups[{run.radius, static_cast<std::size_t>(place), run.proposals}].push_back(&run);
  }
  std::map<SummaryKey, Summary> summaries;
  for (auto& [key, runs] : groups) {
    const auto median_of = [&](auto value) {
      std::vector<double> values;
      for (const auto* run : runs) values.push_back(static_cast<double>(value(*run)));
      std::sort(values.begin(), values.end());
      return std::tuple{values.front(), values[values.size() / 2], values.back()};
    };
    const auto [low, median, high] = median_of([](const AnnealStudyRun& r) { return r.energy; });
    const auto seconds = median_of([](const AnnealStudyRun& r) { return r.cpu_seconds; });
    summaries[key] = {std::get<1>(seconds), low, median, high};
  }
  return summaries;
}

std::string runs_csv(const AnnealStudy& study) {
  std::string text = "schedule,radius,proposals,seed,seconds,energy\n";
  for (const auto& r : study.runs) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.4f},{}\n", r.schedule, r.radius, r.proposals,
                   r.seed, r.cpu_seconds, r.energy);
  }
  return text;
}

std::string medians_csv(const AnnealStudy& study, const std::map<SummaryKey, Summary>& summaries,
                        const std::vector<std::string>& schedules) {
  std::string text = "schedule,radius,proposals,seconds,excess_low,excess_median,excess_high\n";
  for (const auto& [key, s] : summaries) {
    const auto& [radius, place, proposals] = key;
    const auto exact = std::find_if(study.exact.begin(), study.exact.end(),
                                    [r = radius](const auto& e) { return e.radius == r; });
    const auto optimum = static_cast<double>(std::max<std::int64_t>(1, exact->energy));
    const auto percent = [&](double energy) {
      return 100.0 * (energy - static_cast<double>(exact->energy)) / optimum;
    };
    fmt::format_to(std::back_inserter(text), "{},{},{},{:.5f},{:.4f},{:.4f},{:.4f}\n", schedules[place],
                   radius, proposals, s.seconds, percent(s.low), percent(s.median), percent(s.high));
  }
  return text;
}

/// The accepted share of worsening swaps over a grid of steps and classes, each the mean over a stretch of
/// the run; NaN where too few were tried to say.
std::string surface_csv(const AnnealTrace& trace, std::int64_t proposals) {
  constexpr std::size_t kStretches = 32, kClasses = 9;
  constexpr std::int64_t kFewest = 8;
  std::array<std::array<std::int64_t, kClasses>, kStretches> tried{}, accepted{};
  for (std::size_t p = 0; p < trace.size(); ++p) {
    const TracePoint& point = trace[p];
    const double share = static_cast<double>(point.proposals) / static_cast<double>(proposals);
    const auto stretch = std::min(kStretches - 1, static_cast<std::size_t>(share * kStretches));
    for (std::size_t i = 0; i < kClasses; ++i) {
      tried[stretch][i] += point.worsening_tried[i];
      accepted[stretch][i] += point.worsening_accepted[i];
    }
  }
  std::string text = "step,worsening_class,share\n";
  for (std::size_t i = 0; i < kClasses; ++i) {
    for (std::size_t s = 0; s < kStretches; ++s) {
      fmt::format_to(std::back_inserter(text), "{:.0f},{},",
                     (static_cast<double>(s) + 0.5) / kStretches * static_cast<double>(proposals), i);
      if (tried[s][i] < kFewest) {
        text += "NaN\n";
      } else {
        fmt::format_to(std::back_inserter(text), "{:.6g}\n",
                       static_cast<double>(accepted[s][i]) / static_cast<double>(tried[s][i]));
      }
    }
  }
  return text;
}

/// "published / peers / ours annealed / ours exact". The first rows are other people's figures for the
/// reference instance (docs/annealing.md cites them), the rest were just measured.
std::string table(const AnnealStudy& study, const std::map<SummaryKey, Summary>& summaries,
                  const std::vector<std::string>& schedules) {
  std::string text =
      "| result | energy | of the start | above the optimum | time |\n|---|---:|---:|---:|---:|\n"
      "| published annealing (Ryzen 5 2600X, one thread) | 10714 | 3.08 % | 194.5 % | 17.07 min |\n"
      "| published annealing, longer | 9444 | 2.71 % | 159.6 % | 35.36 min |\n"
      "| peers: 1,386 swaps/s; with its copies removed 48,000 | - | - | - | - |\n";
  const auto& exact = study.exact.front();
  const auto share = [&](double energy) {
    return 100.0 * energy / static_cast<double>(std::max<std::int64_t>(1, exact.start_energy));
  };
  for (const auto& [key, s] : summaries) {
    const auto& [radius, place, proposals] = key;
    if (radius != exact.radius || schedules[place] != "exponential") continue;
    fmt::format_to(std::back_inserter(text),
                   "| ours, annealed, {:.0e} proposals | {:.0f} | {:.3f} % | {:.1f} % | {:.3g} s |\n",
                   static_cast<double>(proposals), s.median, share(s.median),
                   100.0 * (s.median / static_cast<double>(std::max<std::int64_t>(1, exact.energy)) - 1.0),
                   s.seconds);
  }
  fmt::format_to(std::back_inserter(text), "| ours, exact, proven | {} | {:.3f} % | 0 % | {:.3g} s |\n",
                 exact.energy, share(static_cast<double>(exact.energy)), exact.cpu_seconds);
  return text;
}

void run(const Settings& settings, Session& session) {
  const Image image = read_image(settings.image, session.execution).image;
  const Grid<std::int32_t> levels = levels_of_channel(image, settings.channel).value;
  std::error_code failed;
  std::filesystem::create_directories(settings.out, failed);
  if (failed) {
    throw Error({.code = ErrorCode::io,
                 .what = "cannot be made: " + failed.message(),
                 .where = settings.out.string(),
                 .limit = "",
                 .remedy = "choose a folder you may write to"});
  }

  AnnealStudyOptions options;
  options.retarget.step = settings.step ? *settings.step : auto_step(levels.size()).step;
  for (const auto name : schedule_names()) {
    if (name != "constant") options.schedules.emplace_back(name);
  }
  // Half decades from 1e6 on.
  for (int i = 0; i < settings.budgets; ++i) {
    options.budgets.push_back(static_cast<std::int64_t>(std::llround(std::pow(10.0, 6.0 + 0.5 * i))));
  }
  options.radii = {settings.radius};
  options.seeds = settings.seeds;
  const AnnealStudy study = study_anneal(levels, options, session.execution_showing("anneal"));
  const auto summaries = summarise(study, options.schedules);

  session.progress.start("traces");
  Execution alone = session.execution;
  alone.threads = 1;
  AnnealProblem problem;
  problem.channels = {{levels}};
  problem.retarget = options.retarget;
  problem.retarget.radius = settings.radius;
  for (const auto& schedule : options.schedules) {
    AnnealOptions one;
    one.schedule = schedule;
    one.proposals = options.budgets.back();
    AnnealTrace trace;
    anneal_retarget(problem, one, alone, &trace);
    write_text_file(settings.out / ("trace_" + schedule + ".csv"), trace.csv(study.exact.front().energy));
  }
  // From a start that accepts nearly everything, so that the surface shows all of the way down.
  AnnealOptions hot;
  hot.proposals = options.budgets.back();
  hot.start.rule = StartTemperature::Rule::everything;
  AnnealTrace hot_trace;
  anneal_retarget(problem, hot, alone, &hot_trace);
  write_text_file(settings.out / "surface.csv", surface_csv(hot_trace, hot.proposals));

  session.progress.start("throughput");
  std::vector<int> threads;
  for (int count = 1; count <= thread_count(session.execution); count *= 2) threads.push_back(count);
  std::string throughput = "side,threads,proposals,seconds,cpu_seconds\n";
  for (const auto& row : study_anneal_throughput({64, 256, 512}, threads, session.execution)) {
    fmt::format_to(std::back_inserter(throughput), "{},{},{},{:.4f},{:.4f}\n", row.side, row.threads,
                   row.proposals, row.seconds, row.cpu_seconds);
  }
  session.progress.finish();

  write_text_file(settings.out / "runs.csv", runs_csv(study));
  write_text_file(settings.out / "medians.csv", medians_csv(study, summaries, options.schedules));
  write_text_file(settings.out / "throughput.csv", throughput);
  const std::string markdown = table(study, summaries, options.schedules);
  write_text_file(settings.out / "table.md", markdown);
  session.output.write(markdown);
  session.progress.note(
      fmt::format("figures: cd {} && gnuplot scripts/gnuplot/anneal.gp", settings.out.string()));
}

}  // namespace

Verb study_anneal_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "study anneal";
  verb.summary = "Measure annealing's schedules against the proven optimum.";
  verb.examples = {
      {"bn study anneal mask.png --step 48,36 -o study", "the data of docs/annealing.md, about ten minutes"},
      {"cd study && gnuplot ../scripts/gnuplot/anneal.gp", "its figures, as SVG"}};
  verb.details =
      "Anneals one channel by every schedule with budgets from a million proposals upwards, several seeds "
      "each, and "
      "solves it exactly. Runs are made one after another on one thread; times are processor time. Writes "
      "runs.csv, "
      "medians.csv, a trace of each schedule, surface.csv (acceptance over step and worsening), "
      "throughput.csv "
      "(threads) and table.md, which is also printed.";
  verb.arguments.positional("IMAGE", settings->image, file_path(),
                            "The mask: any image that OpenImageIO reads.");
  verb.arguments.option("--channel", settings->channel, integer_in(0, 63), "The channel to use, 0 for red.");
  verb.arguments.option("--step", settings->step, offset_or_auto(),
                        "How far the mask moves from frame to frame.");
  verb.arguments.option("--radius", settings->radius, integer_in(1, 32),
                        "The farthest a seed may move, in pixels.");
  verb.arguments.option("--seeds", settings->seeds, integer_in(1, 100), "Runs of each setting.");
  verb.arguments.option("--budgets", settings->budgets, integer_in(1, 11),
                        "How many budgets: 1e6 proposals, then half a decade more each.");
  verb.arguments.option("--out", settings->out, folder_path(), "The folder to write; made if missing.", "-o");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
