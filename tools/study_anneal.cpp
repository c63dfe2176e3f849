// bn study anneal: the measurements and figures of docs/annealing.md.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

#include "bn/error.h"
#include "bn/report.h"
#include "bn/texture.h"
#include "bn_study/anneal.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

/// What may be measured alone.
enum class Part { all, runs, traces, throughput, costs, motions };

struct Settings {
  std::filesystem::path image;
  std::filesystem::path out = "study-anneal";
  int channel = 0;
  std::optional<Offset> step;
  std::vector<int> radii = {6};
  int seeds = 5;
  int budgets = 9;
  Part part = Part::all;

  bool wants(Part one) const { return part == Part::all || part == one; }
};

/// One schedule at one radius and budget, over the seeds.
struct Summary {
  double seconds = 0.0;
  double low = 0.0, median = 0.0, high = 0.0;  ///< energies
};
using SummaryKey = std::tuple<int, std::size_t, std::int64_t>;  ///< radius, schedule's place, budget

const AnnealStudyExact* exact_of(const AnnealStudy& study, int radius) {
  const auto found = std::find_if(study.exact.begin(), study.exact.end(),
                                  [&](const auto& exact) { return exact.radius == radius; });
  return found == study.exact.end() ? nullptr : &*found;
}

std::map<SummaryKey, Summary> summarise(const AnnealStudy& study, const std::vector<std::string>& schedules) {
  std::map<SummaryKey, std::vector<const AnnealStudyRun*>> groups;
  for (const auto& run : study.runs) {
    const auto place = std::find(schedules.begin(), schedules.end(), run.schedule) - schedules.begin();
    // Known runs of radii that were not asked for now have no optimum to be held against.
    if (exact_of(study, run.radius) == nullptr) continue;
    groups[{run.radius, static_cast<std::size_t>(place), run.proposals}].push_back(&run);
  }
  std::map<SummaryKey, Summary> summaries;
  for (auto& [key, runs] : groups) {
    const auto median_of = [&](auto value) {
      std::vector<double> values;
      for (const auto* run : runs) values.push_back(static_cast<double>(value(*run)));
      std::sort(values.begin(), values.end());
      const double median = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
      return std::tuple{values.front(), median, values.back()};
    };
    const auto [low, median, high] = median_of([](const AnnealStudyRun& r) { return r.energy; });
    const auto seconds = median_of([](const AnnealStudyRun& r) { return r.cpu_seconds; });
    summaries[key] = {std::get<1>(seconds), low, median, high};
  }
  return summaries;
}

std::string medians_csv(const AnnealStudy& study, const std::map<SummaryKey, Summary>& summaries,
                        const std::vector<std::string>& schedules) {
  std::string text = "schedule,radius,proposals,seconds,excess_low,excess_median,excess_high\n";
  for (const auto& [key, s] : summaries) {
    const auto& [radius, place, proposals] = key;
    const AnnealStudyExact* exact = exact_of(study, radius);
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

/// Other people's figures for the reference instance (docs/annealing.md cites them). Peers made the published
/// code 34.6 times as fast by removing its copies, 48,000 swaps a second for 1,386; what that makes of the
/// published times is reckoned, not measured.
constexpr const char* kOthers =
    "| published annealing (Ryzen 5 2600X, one thread) | 10714 | 3.08 % | 194.5 % | 17.07 min |\n"
    "| published annealing, longer | 9444 | 2.71 % | 159.6 % | 35.36 min |\n"
    "| peers: the same, copies removed (reckoned from their speed) | 10714 | 3.08 % | 194.5 % | 30 s |\n"
    "| peers: the same, longer (reckoned) | 9444 | 2.71 % | 159.6 % | 61 s |\n";
constexpr std::int64_t kReferenceStart = 348180, kReferenceOptimum = 3638;

/// "published / peers / ours annealed / ours exact"; others' rows only where they are of this instance.
std::string table(const AnnealStudy& study, const std::map<SummaryKey, Summary>& summaries,
                  const std::vector<std::string>& schedules) {
  std::string text =
      "| result | energy | of the start | above the optimum | time |\n|---|---:|---:|---:|---:|\n";
  const auto& exact = study.exact.front();
  if (exact.start_energy == kReferenceStart && exact.energy == kReferenceOptimum) text += kOthers;
  const auto share = [&](double energy) {
    return 100.0 * energy / static_cast<double>(std::max<std::int64_t>(1, exact.start_energy));
  };
  for (const auto& [key, s] : summaries) {
    const auto& [radius, place, proposals] = key;
    const double decades = std::log10(static_cast<double>(proposals));
    if (radius != exact.radius || schedules[place] != "exponential" || decades != std::round(decades))
      continue;
    fmt::format_to(std::back_inserter(text),
                   "| ours, annealed, 1e{} proposals | {:.0f} | {:.3f} % | {:.1f} % | {:.3g} s |\n",
                   static_cast<int>(decades), s.median, share(s.median),
                   100.0 * (s.median / static_cast<double>(std::max<std::int64_t>(1, exact.energy)) - 1.0),
                   s.seconds);
  }
  fmt::format_to(std::back_inserter(text), "| ours, exact, proven | {} | {:.3f} % | 0 % | {:.3g} s |\n",
                 exact.energy, share(static_cast<double>(exact.energy)), exact.cpu_seconds);
  return text;
}

/// What all parts work on.
struct Subject {
  AnnealProblem problem;
  std::vector<std::string> schedules;
  std::vector<std::int64_t> budgets;
};

Subject subject_of(const Settings& settings, const Image& image) {
  Subject subject;
  subject.problem.channels = {{levels_of_channel(image, settings.channel).value}};
  const Extent size = subject.problem.channels[0].levels.size();
  subject.problem.retarget.step = settings.step ? *settings.step : auto_step(size).step;
  subject.problem.retarget.radius = settings.radii.front();
  for (const auto name : schedule_names()) {
    if (name != "constant") subject.schedules.emplace_back(name);
  }
  // Half decades from 1e6 on.
  for (int i = 0; i < settings.budgets; ++i) {
    subject.budgets.push_back(static_cast<std::int64_t>(std::llround(std::pow(10.0, 6.0 + 0.5 * i))));
  }
  return subject;
}

/// One folder holds figures of one subject, so that parts measured one by one belong together.
void claim_folder(const Settings& settings, const Subject& subject, const Image& image) {
  make_folder(settings.out);
  const auto file = settings.out / "study.txt";
  const Offset step = subject.problem.retarget.step;
  const std::string mine = fmt::format("image {}\nchannel {}\nstep {},{}\nannealing version {}\n",
                                       pixel_hash(image), settings.channel, step.x, step.y, kAnnealVersion);
  if (std::filesystem::exists(file) && read_text_file(file) != mine) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "holds a study of another image, channel, step or version of bn",
                 .where = settings.out.string(),
                 .limit = "",
                 .remedy = "name another folder, or remove this one"});
  }
  write_text_file(file, mine);
}

void measure_runs(const Settings& settings, const Subject& subject, Session& session) {
  AnnealStudyOptions options;
  options.retarget = subject.problem.retarget;
  options.schedules = subject.schedules;
  options.budgets = subject.budgets;
  options.radii = settings.radii;
  options.seeds = settings.seeds;
  const auto file = settings.out / "runs.csv";
  if (std::filesystem::exists(file)) {
    options.known = runs_from_csv(read_text_file(file));
    std::erase_if(options.known, [&](const AnnealStudyRun& run) {
      return std::find(options.schedules.begin(), options.schedules.end(), run.schedule) ==
             options.schedules.end();
    });
    session.progress.note(fmt::format("{} has {} runs, which are kept; remove it to measure them again",
                                      file.string(), options.known.size()));
  }
  options.save = [&](const std::vector<AnnealStudyRun>& runs) { write_text_file(file, runs_csv(runs)); };
  const AnnealStudy study =
      study_anneal(subject.problem.channels[0].levels, options, session.execution_showing("anneal"));
  session.progress.finish();
  const auto summaries = summarise(study, options.schedules);
  write_text_file(settings.out / "medians.csv", medians_csv(study, summaries, options.schedules));
  const std::string markdown = table(study, summaries, options.schedules);
  write_text_file(settings.out / "table.md", markdown);
  session.output.tell(markdown);
}

void measure_traces(const Settings& settings, const Subject& subject, Session& session) {
  session.progress.start("traces");
  Execution alone = session.execution;
  alone.threads = 1;
  const std::int64_t optimum =
      solve_retarget(subject.problem.channels[0].levels, subject.problem.retarget, alone).energy;
  AnnealOptions run;
  run.proposals = subject.budgets.back();
  for (const auto& schedule : subject.schedules) {
    run.schedule = schedule;
    AnnealTrace trace;
    anneal_retarget(subject.problem, run, alone, &trace);
    write_text_file(settings.out / ("trace_" + schedule + ".csv"), trace.csv(optimum));
  }
  // From a start that accepts nearly everything, so that the surface shows all of the way down.
  run.schedule = "exponential";
  run.start.rule = StartTemperature::Rule::everything;
  AnnealTrace hot_trace;
  anneal_retarget(subject.problem, run, alone, &hot_trace);
  write_text_file(settings.out / "surface.csv", surface_csv(hot_trace, run.proposals));
  session.progress.finish();
}

void measure_throughput(const Settings& settings, Session& session) {
  session.progress.start("throughput");
  std::string text = "engine,side,threads,temperature,proposals_per_second\n";
  for (const auto& row : study_anneal_throughput(session.execution)) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.4g}\n", row.engine, row.side, row.threads,
                   row.temperature, row.proposals_per_second);
  }
  session.progress.finish();
  write_text_file(settings.out / "throughput.csv", text);
  session.output.tell(text);
}

void measure_costs(const Settings& settings, const Subject& subject, Session& session) {
  session.progress.start("costs");
  const auto file = settings.out / "costs.checkpoint";
  const AnnealCosts costs = study_anneal_costs(
      subject.problem, [&](std::string_view bytes) { write_text_file(file, bytes); }, session.execution);
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  session.progress.finish();
  write_text_file(
      settings.out / "costs.csv",
      fmt::format("what,share\ntrace,{:.5f}\ntrace_low,{:.5f}\ntrace_high,{:.5f}\ncheckpoints,{:.6f}\n",
                  costs.trace, costs.trace_low, costs.trace_high, costs.checkpoints));
  session.output.tell(fmt::format(
      "trace {:.2f} % (95 % interval {:.2f}..{:.2f}), checkpoints {:.3f} % ({:.2g} ms and {} bytes each)\n",
      100.0 * costs.trace, 100.0 * costs.trace_low, 100.0 * costs.trace_high, 100.0 * costs.checkpoints,
      1e3 * costs.save_seconds, costs.checkpoint_bytes));
}

/// All 81 motions, on all threads, by the clock on the wall.
void measure_motions(const Settings& settings, const Subject& subject, Session& session) {
  constexpr int kRange = 4, kSide = 2 * kRange + 1;
  const AnnealOptions run;
  const auto start = std::chrono::steady_clock::now();
  const auto results =
      anneal_motion_set(subject.problem, run, kRange, session.execution_showing("81 motions"));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  session.progress.finish();
  std::string text = "motion_x,motion_y,start_energy,energy\n";
  double worst = 0.0;
  std::int64_t least = results.front().tile.energy, most = least;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const RetargetTile& tile = results[i].tile;
    const int index = static_cast<int>(i);
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", index % kSide - kRange, index / kSide - kRange,
                   tile.start_energy, tile.energy);
    worst = std::max(worst, static_cast<double>(tile.energy) /
                                static_cast<double>(std::max<std::int64_t>(1, tile.start_energy)));
    least = std::min(least, tile.energy);
    most = std::max(most, tile.energy);
  }
  write_text_file(settings.out / "motions.csv", text);
  session.output.tell(
      fmt::format("81 motions, {:.0e} proposals each: {}..{}, at worst {:.3f} % of the start, {:.1f} s on {} "
                  "threads\n",
                  static_cast<double>(run.proposals), least, most, 100.0 * worst, seconds,
                  thread_count(session.execution)));
}

constexpr std::string_view kFigures =
#include "tools/study_anneal.gnuplot.inc"
    ;

/// The figures of all data in the folder, those of earlier parts too.
std::string figures(const Settings& settings, const std::vector<std::string>& schedules) {
  const auto stands = [&](const char* file) { return std::filesystem::exists(settings.out / file) ? 1 : 0; };
  return fmt::format("schedules = \"{}\"\nruns = {}\ntraces = {}\nthroughput = {}\n\n{}",
                     fmt::join(schedules, " "), stands("medians.csv"), stands("surface.csv"),
                     stands("throughput.csv"), kFigures);
}

void run(const Settings& settings, Session& session) {
  const Image image = read_image(settings.image, session.execution).image;
  const Subject subject = subject_of(settings, image);
  claim_folder(settings, subject, image);
  if (settings.wants(Part::runs)) measure_runs(settings, subject, session);
  if (settings.wants(Part::traces)) measure_traces(settings, subject, session);
  if (settings.wants(Part::throughput)) measure_throughput(settings, session);
  if (settings.wants(Part::costs)) measure_costs(settings, subject, session);
  if (settings.wants(Part::motions)) measure_motions(settings, subject, session);
  const std::string failure =
      draw_figures(settings.out, figures(settings, subject.schedules), session.execution);
  if (!failure.empty()) session.progress.note("no figures: " + failure);
}

}  // namespace

Verb study_anneal_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "study anneal";
  verb.summary = "Measure annealing's schedules against the proven optimum.";
  verb.examples = {
      {"bn study anneal mask.png --step 48,36 -o study",
       "the data and figures of docs/annealing.md, about ten minutes"},
      {"bn study anneal mask.png --part throughput -o study", "proposals a second only, ten seconds"}};
  verb.details =
      "Anneals one channel by every schedule with budgets from a million proposals upwards, several seeds "
      "and radii each, and solves each radius exactly. Runs are made one after another on one thread; times "
      "are processor time. Writes runs.csv, medians.csv and table.md (printed too). traces: a trace of each "
      "schedule, and surface.csv (acceptance over step and worsening). throughput: proposals a second by "
      "engine, temperature and threads, throughput.csv. costs: of a trace and of checkpoints, costs.csv. "
      "motions: all 81, by the clock on the wall, motions.csv.\n\n"
      "gnuplot draws the figures of all data in the folder, as SVG, by the script figures.gp that is left "
      "there; without gnuplot a note says what to install. Parts measured one by one into the same folder "
      "come together, and runs that stand in its runs.csv are not made again: a stopped study goes on.";
  verb.arguments.positional("IMAGE", settings->image, file_path(),
                            "The mask: any image that OpenImageIO reads.");
  verb.arguments.option("--channel", settings->channel, integer_in(0, 63), "The channel to use, 0 for red.");
  verb.arguments.option("--step", settings->step, offset_or_auto(),
                        "How far the mask moves from frame to frame.");
  verb.arguments.option("--radii", settings->radii, integer_list(1, 32, 16),
                        "The farthest a seed may move, in pixels; traces and motions take the first.");
  verb.arguments.option("--seeds", settings->seeds, integer_in(1, 100), "Runs of each setting.");
  verb.arguments.option("--budgets", settings->budgets, integer_in(1, 11),
                        "How many budgets: 1e6 proposals, then half a decade more each.");
  verb.arguments.option("--part", settings->part,
                        choice_of<Part>({{"all", Part::all},
                                         {"runs", Part::runs},
                                         {"traces", Part::traces},
                                         {"throughput", Part::throughput},
                                         {"costs", Part::costs},
                                         {"motions", Part::motions}}),
                        "Measure one part alone.");
  verb.arguments.option("--out", settings->out, folder_path(), "The folder to write; made if missing.", "-o");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
