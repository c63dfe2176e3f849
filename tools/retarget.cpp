// bn retarget: the retarget tiles of one image, with their proofs.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

/// A budget as it is typed: "2s" of wall time, or a number of proposals.
struct Budget {
  double seconds = 0.0;
  double proposals = 1e9;
};

struct Settings {
  RetargetEntry entry;
  AnnealMethod anneal;
  bool anneals = false;
  Budget budget;
  std::filesystem::path trace;
  std::filesystem::path image;
  MoveForm form = MoveForm::scatter;
  std::filesystem::path out;
  bool json = false;
};

/// The energies as the atlas has them: one row a motion in y.
std::string energy_table(const std::vector<TileRecord>& tiles, int range) {
  std::size_t width = 0;
  for (const auto& tile : tiles) width = std::max(width, std::to_string(tile.energy).size() + 2);
  std::string text = fmt::format("\nenergy by motion, x {}..{} to the right, y downwards\n", -range, range);
  std::size_t index = 0;
  for (int y = -range; y <= range; ++y) {
    for (int x = -range; x <= range; ++x) text += fmt::format("{:>{}}", tiles[index++].energy, width);
    text += '\n';
  }
  return text;
}

ValueKind<Budget> budget_value() {
  const std::string allowed = "proposals, such as 1e9, or seconds, such as 2s";
  return {.placeholder = "N|SECONDSs",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                Budget budget{.proposals = 0.0};
                const bool timed = text.ends_with('s');
                double& value = timed ? budget.seconds : budget.proposals;
                const char* const end = text.data() + text.size() - (timed ? 1 : 0);
                const auto [rest, failed] = std::from_chars(text.data(), end, value);
                if (text.empty() || failed != std::errc() || rest != end || !std::isfinite(value)) {
                  throw Error({.code = ErrorCode::usage,
                               .what = fmt::format("'{}' is no budget", text),
                               .where = std::string(where),
                               .limit = allowed,
                               .remedy = ""});
                }
                if (value <= 0.0) {
                  throw Error({.code = ErrorCode::invalid_input,
                               .what = fmt::format("a budget of {}", text),
                               .where = std::string(where),
                               .limit = "1..2^62 proposals, or above 0, at most 1e6 s",
                               .remedy = ""});
                }
                return budget;
              },
          .show = [](const Budget&) { return std::string("1e9"); }};
}

/// Any word, so that the library names the schedules that there are.
ValueKind<std::string> schedule_value() {
  ValueKind<std::string> kind{.placeholder = "NAME", .allowed = "", .parse = {}, .show = [](const std::string& s) { return s; }};
  for (const auto name : schedule_names()) kind.choices.emplace_back(name);
  kind.completion = Completion::choice;
  kind.parse = [](std::string_view text, std::string_view) {
    make_schedule(text, 1.0, 1.0, 1);  // for the name's sake
    return std::string(text);
  };
  return kind;
}

/// The entry's annealing: its budget in proposals, its checkpoint beside the tile.
AnnealMethod annealing(const Settings& settings, Session& session) {
  AnnealMethod method = settings.anneal;
  constexpr double kMostProposals = 0x1p62;
  method.proposals = static_cast<std::int64_t>(std::min(settings.budget.proposals, kMostProposals));
  if (settings.budget.seconds > 0.0) {
    AnnealProblem problem;
    problem.channels = {{levels_of_channel(read_image(settings.image, session.execution).image, settings.entry.channel).value}};
    problem.retarget = settings.entry.options;
    const Extent size = problem.channels[0].levels.size();
    problem.retarget.step = settings.entry.step ? *settings.entry.step : auto_step(size).step;
    AnnealOptions options;
    options.schedule = method.schedule;
    method.proposals = proposals_for(settings.budget.seconds, problem, options, session.execution);
    session.progress.note(fmt::format("{} s are {} proposals here; give --budget {} for the same bytes again",
                                      settings.budget.seconds, method.proposals, method.proposals));
  }
  if (!settings.out.empty() && settings.entry.motion == 0) method.checkpoint = settings.out.string() + ".checkpoint";
  return method;
}

void run(Settings& settings, Session& session) {
  RetargetEntry& entry = settings.entry;
  AnnealTrace trace;
  if (settings.anneals) {
    entry.anneal = annealing(settings, session);
    if (!settings.trace.empty()) entry.anneal->trace = &trace;
  }
  entry.name = "retarget";
  entry.image = settings.image.string();
  if (!settings.out.empty()) {
    entry.outputs = {{.path = settings.out.string(),
                      .kind = entry.motion > 0 ? RetargetOutput::Kind::atlas : RetargetOutput::Kind::tile,
                      .form = settings.form,
                      .motion = {0, 0}}};
  }
  const JobRecord job = make_retarget(entry, session.execution_showing("retarget"));
  session.progress.finish();
  if (entry.anneal && !settings.trace.empty()) write_text_file(settings.trace, trace.csv(job.tiles.front().lower_bound));
  for (const auto& note : job.notes) session.progress.note(note);

  Json result{{"source", entry.image},
              {"channel", entry.channel},
              {"step", to_json(job.step.value())},
              {"orbit_length", job.orbit_length.value()},
              {"radius", entry.options.radius},
              {"reach", name_of(entry.options.reach)},
              {"metric", name_of(entry.options.metric)},
              {"wrap", entry.options.wrap},
              {"motion", entry.motion},
              {"method", entry.anneal ? "anneal" : "exact"}};
  if (entry.anneal) {
    result["schedule"] = entry.anneal->schedule;
    result["proposals"] = entry.anneal->proposals;
    result["seed"] = entry.anneal->seed;
  }
  // The plain tile, motion (0, 0), stands in the middle of its set.
  const TileRecord& plain = job.tiles.at(job.tiles.size() / 2);
  bool all_optimal = true;
  for (const auto& tile : job.tiles) all_optimal = all_optimal && tile.energy == tile.lower_bound;
  result["start_energy"] = plain.start_energy;
  result["energy"] = plain.energy;
  result["lower_bound"] = plain.lower_bound;
  result["optimal"] = all_optimal;
  result["seconds"] = rounded_seconds(job.seconds);
  if (!job.files.empty()) {
    result["file"] = job.files.front().path;
    result["form"] = name_of(settings.form);
    result["pixel_hash"] = job.files.front().pixel_hash;
  }
  if (settings.json && entry.motion > 0) {
    for (const auto& tile : job.tiles) result["tiles"].push_back(to_json(tile));
  }
  session.output.write_result(result, settings.json);
  if (!settings.json && entry.motion > 0) session.output.write(energy_table(job.tiles, entry.motion));
}

}  // namespace

Verb retarget_verb() {
  const auto settings = std::make_shared<Settings>();
  RetargetEntry& entry = settings->entry;
  RetargetOptions& options = entry.options;
  Verb verb;
  verb.name = "retarget";
  verb.summary = "Make the retarget tiles of a mask, with a proof of how good they are.";
  verb.examples = {
      {"bn retarget mask.png --step 48,36 --radius 6 -o tile.png", "the optimal tile for one dither step"},
      {"bn retarget mask.png --motion 4 -o atlas.png", "all 81 motions of -4..4 pixels in one 9x9 atlas"},
      {"bn retarget mask.png --channel 0 --step 48,36 --radius 6", "only the figures; nothing is written"},
      {"bn retarget large.exr --gap 0.5% -o tile.png --json",
       "stop within a certified 0.5 % of the optimum"},
      {"bn retarget mask.png --method anneal --schedule kirkpatrick --budget 2s --seed 1 -o tile.png",
       "anneal for two seconds; Ctrl-C and the same command again go on from tile.png.checkpoint"}};
  verb.details =
      "A retarget tile says where the seed of each pixel goes so that seeds sorted like this frame's dither "
      "mask are "
      "sorted like the next frame's, which is the same mask moved by the step. The tile is a bijection of "
      "the torus, "
      "moves nothing farther than the radius, and has the least energy possible; lower_bound is the proof. "
      "Any image "
      "serves as a mask: 8 bit, 16 bit or float.\n\n"
      "With --motion N > 0 the printed energies are those of motion 0,0, optimal speaks for all, and --json "
      "lists every motion.";
  verb.arguments.positional("IMAGE", settings->image, file_path(),
                            "The mask: any image that OpenImageIO reads.");
  verb.arguments.option("--channel", entry.channel, integer_in(0, 63), "The channel to use, 0 for red.");
  verb.arguments.option(
      "--step", entry.step, offset_or_auto(),
      "How far the mask moves from frame to frame, in pixels; auto picks a step with a long orbit.");
  verb.arguments.option("--radius", options.radius, integer_in(1, 32),
                        "The farthest a seed may move, in pixels.");
  verb.arguments.option("--reach", options.reach,
                        choice_of<Reach>({{"chebyshev", Reach::chebyshev}, {"euclidean", Reach::euclidean}}),
                        "How that distance is measured: a square or a disc.");
  verb.arguments.option("--metric", options.metric,
                        choice_of<Metric>({{"l1", Metric::l1}, {"l2", Metric::l2}}),
                        "Cost of a difference of levels: its size or its square.");
  verb.arguments.flag("--no-wrap", options.wrap, false,
                      "No seed crosses the tile's border, for a tile used alone.");
  verb.arguments.option(
      "--motion", entry.motion, integer_in(0, 8),
      "Solve every motion of -N..N pixels in x and y; 0 makes one tile, 4 the 81 of a 9x9 atlas.");
  verb.arguments.option("--gap", options.gap, percentage_in(0, 100),
                        "Stop when the energy is proven to be within this of the optimum.");
  verb.arguments.option("--method", settings->anneals, choice_of<bool>({{"exact", false}, {"anneal", true}}),
                        "The proven optimum, or simulated annealing, which the following flags steer.");
  verb.arguments.option("--schedule", settings->anneal.schedule, schedule_value(), "How annealing cools.");
  verb.arguments.option("--budget", settings->budget, budget_value(),
                        "Of annealing, for each tile: proposals, or seconds, which are turned into proposals by a trial run.");
  verb.arguments.option("--seed", settings->anneal.seed, seed_value(), "Of annealing's random numbers.");
  verb.arguments.option("--start-temperature", settings->anneal.start_temperature, real_in(0, 1e15),
                        "Where annealing starts; 0 for automatic.");
  verb.arguments.option("--initial-acceptance", settings->anneal.initial_acceptance, real_in(0, 0.999),
                        "In its place: the share of worsening swaps accepted at the start, at least 0.001.");
  verb.arguments.option("--end-temperature", settings->anneal.end_temperature, real_in(0, 1e15),
                        "Where annealing ends; 0 for automatic.");
  verb.arguments.option("--trace", settings->trace, file_path(), "Write annealing's course as CSV (one tile only).");
  verb.arguments.option("--form", settings->form,
                        choice_of<MoveForm>({{"scatter", MoveForm::scatter}, {"gather", MoveForm::gather}}),
                        "What the file stores: where a seed goes, or where it comes from.");
  verb.arguments.option("--out", settings->out, file_path(),
                        "The file to write, 8 bit; .png, .exr, .tif, .h or .bin decides the format.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print the result as JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
