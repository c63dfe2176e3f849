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

using Json = nlohmann::ordered_json;

/// What may be measured alone.
enum class Part { all, runs, traces, throughput, costs, motions };

/// Half decades from 1e6 proposals on.
std::vector<std::int64_t> half_decades(int count) {
  std::vector<std::int64_t> budgets;
  for (int i = 0; i < count; ++i)
    budgets.push_back(static_cast<std::int64_t>(std::llround(std::pow(10.0, 6.0 + 0.5 * i))));
  return budgets;
}

/// What may be annealed with; constant is no schedule that cools.
std::vector<std::string> cooling_schedules() {
  std::vector<std::string> names;
  for (const auto name : schedule_names()) {
    if (name != "constant") names.emplace_back(name);
  }
  return names;
}

struct Settings {
  std::filesystem::path image;
  std::filesystem::path out = "study-anneal";
  int channel = 0;
  std::optional<Offset> step;
  std::vector<int> radii = {6};
  int seeds = 5;
  std::vector<std::string> schedules;  ///< empty: all
  std::vector<std::int64_t> budgets = half_decades(9);
  Part part = Part::all;
  bool json = false;

  bool wants(Part one) const { return part == Part::all || part == one; }
};

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
  for (const std::string& name : cooling_schedules()) {
    const auto& chosen = settings.schedules;
    if (chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end())
      subject.schedules.push_back(name);
  }
  subject.budgets = settings.budgets;
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

Json to_json(const AnnealStudyExact& exact) {
  return {{"radius", exact.radius},
          {"seconds", exact.cpu_seconds},
          {"start_energy", exact.start_energy},
          {"energy", exact.energy}};
}

Json to_json(const AnnealStudySummary& s) {
  return {{"schedule", s.schedule},
          {"radius", s.radius},
          {"proposals", s.proposals},
          {"seconds", s.seconds},
          {"energy_low", s.low},
          {"energy_median", s.median},
          {"energy_high", s.high},
          {"excess_low_percent", s.excess_low},
          {"excess_median_percent", s.excess_median},
          {"excess_high_percent", s.excess_high}};
}

/// Printed for people as it is measured; for programs all at the end.
void tell(const Settings& settings, Session& session, std::string_view text) {
  if (!settings.json) session.output.tell(text);
}

void measure_runs(const Settings& settings, const Subject& subject, Session& session, Json& result) {
  AnnealStudyOptions options;
  options.retarget = subject.problem.retarget;
  options.schedules = subject.schedules;
  options.budgets = subject.budgets;
  options.radii = settings.radii;
  options.seeds = settings.seeds;
  const auto file = settings.out / "runs.csv";
  if (std::filesystem::exists(file)) {
    options.known = runs_from_csv(read_text_file(file));
    session.progress.note(fmt::format("{} has {} runs, which are kept; remove it to measure them again",
                                      file.string(), options.known.size()));
  }
  options.save = [&](const std::vector<AnnealStudyRun>& runs) { write_text_file(file, runs_csv(runs)); };
  const AnnealStudy study =
      study_anneal(subject.problem.channels[0].levels, options, session.execution_showing("anneal"));
  session.progress.finish();
  const auto summaries = summarise(study, options.schedules);
  write_text_file(settings.out / "medians.csv", medians_csv(summaries));
  write_text_file(settings.out / "medians.md", medians_md(summaries));
  const std::string markdown = results_md(study, summaries);
  write_text_file(settings.out / "table.md", markdown);
  tell(settings, session, markdown);
  for (const AnnealStudyExact& exact : study.exact) result["exact"].push_back(to_json(exact));
  for (const AnnealStudySummary& summary : summaries) result["medians"].push_back(to_json(summary));
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

void measure_throughput(const Settings& settings, Session& session, Json& result) {
  session.progress.start("throughput");
  std::string text = "engine,side,threads,temperature,proposals_per_second\n";
  for (const auto& row : study_anneal_throughput(session.execution)) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.4g}\n", row.engine, row.side, row.threads,
                   row.temperature, row.proposals_per_second);
    result["throughput"].push_back({{"engine", row.engine},
                                    {"side", row.side},
                                    {"threads", row.threads},
                                    {"temperature", row.temperature},
                                    {"proposals_per_second", row.proposals_per_second}});
  }
  session.progress.finish();
  write_text_file(settings.out / "throughput.csv", text);
  tell(settings, session, text);
}

void measure_costs(const Settings& settings, const Subject& subject, Session& session, Json& result) {
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
  result["costs"] = {{"trace", costs.trace},
                     {"trace_low", costs.trace_low},
                     {"trace_high", costs.trace_high},
                     {"checkpoints", costs.checkpoints},
                     {"save_seconds", costs.save_seconds},
                     {"checkpoint_bytes", costs.checkpoint_bytes}};
  tell(settings, session,
       fmt::format("trace {:.2f} % (95 % interval {:.2f}..{:.2f}), checkpoints {:.3f} % ({:.2g} ms and {} "
                   "bytes each)\n",
                   100.0 * costs.trace, 100.0 * costs.trace_low, 100.0 * costs.trace_high,
                   100.0 * costs.checkpoints, 1e3 * costs.save_seconds, costs.checkpoint_bytes));
}

/// All 81 motions, on all threads, by the clock on the wall.
void measure_motions(const Settings& settings, const Subject& subject, Session& session, Json& result) {
  constexpr int kRange = 4, kSide = 2 * kRange + 1;
  AnnealOptions run;
  run.proposals = std::min(run.proposals, subject.budgets.back());
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
  result["motions"] = {
      {"proposals", run.proposals}, {"least", least},     {"most", most},
      {"worst_of_start", worst},    {"seconds", seconds}, {"threads", thread_count(session.execution)}};
  tell(
      settings, session,
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
  Json result{{"out", settings.out.string()}};
  if (settings.wants(Part::runs)) measure_runs(settings, subject, session, result);
  if (settings.wants(Part::traces)) measure_traces(settings, subject, session);
  if (settings.wants(Part::throughput)) measure_throughput(settings, session, result);
  if (settings.wants(Part::costs)) measure_costs(settings, subject, session, result);
  if (settings.wants(Part::motions)) measure_motions(settings, subject, session, result);
  const std::string failure =
      draw_figures(settings.out, figures(settings, subject.schedules), session.execution);
  if (!failure.empty()) session.progress.note("no figures: " + failure);
  if (settings.json) session.output.write_result(result, true);
}

/// A list of budgets; a lone number up to eleven means so many of the usual ones, as it did at first.
ValueKind<std::vector<std::int64_t>> budget_list() {
  ValueKind<std::vector<std::int64_t>> kind = count_list(1000, 1'000'000'000'000);
  kind.parse = [list = kind.parse](std::string_view text, std::string_view where) {
    const bool a_count = !text.empty() && text.size() <= 2 &&
                         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!a_count) return list(text, where);
    return half_decades(integer_in(1, 11).parse(text, where));
  };
  return kind;
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
      {"bn study anneal mask.png --schedules linear,inverse --budgets 1e7,1e8 --seeds 3 --part runs -o study",
       "two schedules, two budgets, a few seconds"},
      {"bn study anneal mask.png --part throughput -o study", "proposals a second only, ten seconds"}};
  verb.details =
      "Anneals one channel by every schedule with budgets from a million proposals upwards, several seeds "
      "and radii each, and solves each radius exactly. Runs are made one after another on one thread; times "
      "are processor time. Writes runs.csv, medians.csv, medians.md and table.md (printed too). traces: a "
      "trace of each "
      "schedule, and surface.csv (acceptance over proposals and worsening). throughput: proposals a second "
      "by "
      "engine, temperature and threads, throughput.csv. costs: of a trace and of checkpoints, costs.csv. "
      "motions: all 81 with the largest budget, 1e9 at most, by the clock on the wall, motions.csv.\n\n"
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
  verb.arguments.option("--schedules", settings->schedules, word_list(cooling_schedules()),
                        "How the runs cool.");
  verb.arguments.option("--budgets", settings->budgets, budget_list(),
                        "Proposals of the runs. A lone number up to 11 is so many of the default ones.");
  verb.arguments.option("--part", settings->part,
                        choice_of<Part>({{"all", Part::all},
                                         {"runs", Part::runs},
                                         {"traces", Part::traces},
                                         {"throughput", Part::throughput},
                                         {"costs", Part::costs},
                                         {"motions", Part::motions}}),
                        "Measure one part alone.");
  verb.arguments.option("--out", settings->out, folder_path(), "The folder to write; made if missing.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print the results as JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
