// bn retarget: the retarget tiles of one image, with their proofs.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "bn/error.h"
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
  bool anneals = false;
  AnnealMethod anneal;
  std::vector<std::string> anneal_flags;  ///< those that were given
  std::optional<std::int64_t> stop_after;
  Budget budget;
  double start_temperature = 0.0;
  double initial_acceptance = 0.0;
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
  ValueKind<std::string> kind{
      .placeholder = "NAME", .allowed = "", .parse = {}, .show = [](const std::string& s) { return s; }};
  for (const auto name : schedule_names()) kind.choices.emplace_back(name);
  kind.completion = Completion::choice;
  kind.parse = [](std::string_view text, std::string_view) {
    make_schedule(text, 1.0, 1.0, 1);  // for the name's sake
    return std::string(text);
  };
  return kind;
}

/// A number or none; its range is the library's to know, and to state in exit code 3.
template <class T>
ValueKind<std::optional<T>> optional_number(std::string allowed) {
  return {.placeholder = std::is_integral_v<T> ? "N" : "NUMBER",
          .allowed = allowed,
          .parse = [=](std::string_view text, std::string_view where) -> std::optional<T> {
            T value{};
            const char* const end = text.data() + text.size();
            const auto [rest, failed] = std::from_chars(text.data(), end, value);
            if (!text.empty() && failed == std::errc() && rest == end) return value;
            throw Error({.code = ErrorCode::usage,
                         .what = fmt::format("'{}' is no number", text),
                         .where = std::string(where),
                         .limit = allowed,
                         .remedy = ""});
          },
          .show = [](const std::optional<T>&) { return std::string(); }};
}

/// `kind`, noting under its name that it was given.
template <class T>
ValueKind<T> noted(ValueKind<T> kind, std::vector<std::string>& given) {
  kind.parse = [parse = kind.parse, &given](std::string_view text, std::string_view where) {
    given.emplace_back(where);
    return parse(text, where);
  };
  return kind;
}

[[noreturn]] void refuse(std::string where, std::string what, std::string limit, std::string remedy) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = std::move(where),
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

/// The entry's annealing: its budget, its start, its checkpoint beside the tile.
AnnealMethod annealing(const Settings& settings) {
  AnnealMethod method = settings.anneal;
  constexpr double kMostProposals = 0x1p62;
  method.options.proposals = static_cast<std::int64_t>(std::min(settings.budget.proposals, kMostProposals));
  method.seconds = settings.budget.seconds;
  if (method.seconds > 0.0) method.options.proposals = 1;  // until the clock has spoken
  method.options.stop_after = settings.stop_after.value_or(0);
  if (method.seconds > 0.0 && settings.stop_after) {
    refuse("--stop-after", "given beside a budget in seconds", "a budget in proposals",
           "give --budget as proposals");
  }
  using Rule = StartTemperature::Rule;
  if (settings.start_temperature > 0.0 && settings.initial_acceptance > 0.0) {
    refuse("--initial-acceptance", "given beside --start-temperature", "one of the two", "leave one out");
  }
  if (settings.start_temperature > 0.0) method.options.start = {Rule::given, settings.start_temperature};
  if (settings.initial_acceptance > 0.0) {
    const bool all = settings.initial_acceptance == 1.0;
    method.options.start = {all ? Rule::everything : Rule::acceptance, settings.initial_acceptance};
  }
  if (!settings.out.empty()) method.checkpoint = settings.out.string() + ".checkpoint";
  return method;
}

void check_method(const Settings& settings) {
  if (!settings.anneals && !settings.anneal_flags.empty()) {
    refuse(settings.anneal_flags.front(), "given without annealing", "only with --method anneal",
           "add --method anneal");
  }
  if (settings.anneals && settings.entry.options.gap > 0.0)
    refuse("--gap", "given with annealing", "only with --method exact", "leave it out");
  if (settings.entry.channel > 0 && !settings.anneal.channels.empty())
    refuse("--channels", "given beside --channel", "one of the two", "leave --channel out");
  if (settings.entry.motion > 0 && !settings.trace.empty())
    refuse("--trace", "given for a set of motions", "one tile: --motion 0", "leave one of the two out");
}

void run(Settings& settings, Session& session) {
  RetargetEntry& entry = settings.entry;
  AnnealTrace trace;
  check_method(settings);
  if (settings.anneals) {
    entry.anneal = annealing(settings);
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
  if (entry.anneal && !settings.trace.empty())
    write_text_file(settings.trace, trace.csv(job.tiles.front().lower_bound));
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
    const AnnealMethod& method = *entry.anneal;
    if (!method.channels.empty()) {
      result.erase("channel");
      result["channels"] = method.channels;
    }
    if (!method.weights.empty()) result["weights"] = method.weights;
    if (method.residual_sigma_px > 0.0) result["residual_sigma"] = method.residual_sigma_px;
    result["schedule"] = method.options.schedule;
    result["proposals"] = job.proposals.value();
    result["seed"] = method.options.seed;
    if (method.options.stop_after > 0) result["stop_after"] = method.options.stop_after;
    if (method.options.chains.count > 1) result["chains"] = method.options.chains.count;
    if (method.seconds > 0.0) {
      session.progress.note(
          fmt::format("{} s are {} proposals here; give --budget {} for the same bytes again", method.seconds,
                      *job.proposals, *job.proposals));
    }
  }
  // The plain tile, motion (0, 0), stands in the middle of its set.
  const TileRecord& plain = job.tiles.at(job.tiles.size() / 2);
  bool all_optimal = true;
  for (const auto& tile : job.tiles) all_optimal = all_optimal && tile.energy == tile.lower_bound;
  result["start_energy"] = plain.start_energy;
  result["energy"] = plain.energy;
  if (job.recomputed_energy) result["recomputed_energy"] = *job.recomputed_energy;
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

/// The flags that only annealing has; in recipes they have the same names.
void declare_annealing(Arguments& arguments, Settings& settings) {
  const auto option = [&](const char* name, auto& target, auto kind, const char* help) {
    arguments.option(name, target, noted(std::move(kind), settings.anneal_flags), help);
  };
  AnnealOptions& options = settings.anneal.options;
  ScheduleParameters& parameters = options.parameters;
  option("--schedule", options.schedule, schedule_value(), "How annealing cools.");
  option("--budget", settings.budget, budget_value(),
         "Of each tile and chain: proposals, or seconds, which are turned into proposals by a trial run.");
  option("--seed", options.seed, seed_value(), "Of the random numbers.");
  option("--start-temperature", settings.start_temperature, real_in(0, 1e15),
         "Where it starts; 0 for automatic.");
  option("--initial-acceptance", settings.initial_acceptance, real_in(0, 1),
         "In its place: the share of worsening swaps accepted at the start, at least 0.001; 1 accepts "
         "everything.");
  option("--end-temperature", options.end_temperature, real_in(0, 1e15), "Where it ends; 0 for automatic.");
  option(
      "--factor", parameters.factor, optional_number<double>("above 0, at most 1"),
      "The factor a of exponential and inverse (a proposal) or kirkpatrick (a stage), in place of one that "
      "meets the end temperature.");
  option("--slope", parameters.slope, optional_number<double>("0 or above"), "Of linear, a proposal.");
  option("--hajek-c", parameters.hajek_c, optional_number<double>("above 0"), "The constant c of hajek.");
  option("--stages", parameters.stages, optional_number<int>("1..1000000"),
         "Of kirkpatrick: as many share the budget; 100 where nothing is given.");
  option("--accepted-per-stage", parameters.accepted_per_stage, optional_number<std::int64_t>("1 or above"),
         "Of kirkpatrick: a stage ends after as many accepted swaps.");
  option("--tried-per-stage", parameters.tried_per_stage, optional_number<std::int64_t>("1 or above"),
         "Of kirkpatrick: or after as many proposals.");
  option("--frozen-stages", parameters.frozen_stages, optional_number<int>("1 or above"),
         "Of kirkpatrick: the run ends after as many stages without a change; 3 where nothing is given.");
  option("--chains", options.chains.count, integer_in(1, 256), "Chains to run.");
  option("--coupling", options.chains.coupling,
         choice_of<ChainOptions::Coupling>({{"independent", ChainOptions::Coupling::independent},
                                            {"tempering", ChainOptions::Coupling::tempering}}),
         "Of several chains: the best of them, or parallel tempering between start and end temperature.");
  option("--swap-distance", options.swap_distance_px, integer_in(0, 64),
         "The farthest apart per axis two swapped seeds may be, at most twice the radius; 0 for 5/3 of it.");
  option("--stop-after", settings.stop_after, optional_number<std::int64_t>("1..the budget"),
         "End after so many proposals, cooled as for the whole budget: a run that was stopped, made again.");
  option("--channels", settings.anneal.channels, integer_list(0, 63, 16),
         "Minimise the weighted sum over these channels, in place of one.");
  option("--weights", settings.anneal.weights, integer_list(1, 1000, 16),
         "Of the channels; 1 each if not given.");
  option("--residual-sigma", settings.anneal.residual_sigma_px, real_in(0, 8, "pixels"),
         "Minimise what a Gaussian blur leaves of the difference, 0.3 pixels or more; needs --metric l2.");
  option("--trace", settings.trace, file_path(), "Write annealing's course as CSV (one tile only).");
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
      {"bn retarget large.exr --gap 0.5% -o tile.png --json", "stop within a certified 0.5 % of the optimum"},
      {"bn retarget mask.png --method anneal --schedule kirkpatrick --budget 2s --seed 1 -o tile.png",
       "anneal for two seconds; Ctrl-C and the same command again go on from tile.png.checkpoint"},
      {"bn retarget rgb.png --method anneal --channels 0,1,2 --weights 2,4,1 --budget 1e9 -o tile.png",
       "one tile for three channels at once"},
      {"bn retarget mask.png --method anneal --metric l2 --residual-sigma 1.5 --budget 1e8 -o tile.png",
       "the least difference as seen through a blur"}};
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
  declare_annealing(verb.arguments, *settings);
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
