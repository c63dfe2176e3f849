// bn retarget: the retarget tiles of one image, with their proofs.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "tools/entry_arguments.h"

namespace bn::tools {
namespace {

struct Settings {
  Settings() : arguments(*find_kind("retarget")) {}
  EntryArguments arguments;
  double seconds = 0.0;  ///< a budget by the clock; 0: none
  std::filesystem::path trace;
  std::filesystem::path out;
  bool json = false;
  std::vector<std::string> notes;  ///< about older names of flags
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

[[noreturn]] void refuse(std::string where, std::string what, std::string limit, std::string remedy) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = std::move(where),
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

/// What is no part of a recipe: a budget by the clock, the trace, the checkpoint beside the tile.
void finish_annealing(Settings& settings, AnnealMethod& method, AnnealTrace& trace) {
  if (settings.seconds > 0.0 && settings.arguments.was_given("stop_after")) {
    refuse("--stop-after", "given beside --seconds", "a budget in proposals", "give --proposals");
  }
  if (settings.seconds > 0.0 && settings.arguments.was_given("proposals")) {
    refuse("--seconds", "given beside --proposals", "one of the two", "leave one out");
  }
  method.seconds = settings.seconds;
  if (method.seconds > 0.0) method.options.proposals = 1;  // until the clock has spoken
  if (!settings.out.empty()) method.checkpoint = settings.out.string() + ".checkpoint";
  if (!settings.trace.empty()) method.trace = &trace;
}

void check_flags(const Settings& settings, const RetargetEntry& entry) {
  if (!entry.anneals && settings.seconds > 0.0)
    refuse("--seconds", "does not apply", "only with --method anneal", "add --method anneal");
  if (!entry.anneals && !settings.trace.empty())
    refuse("--trace", "does not apply", "only with --method anneal", "add --method anneal");
  if (entry.motion > 0 && !settings.trace.empty())
    refuse("--trace", "given for a set of motions", "one tile: --motion 0", "leave one of the two out");
}

Json result_of(const Settings& settings, const RetargetEntry& entry, const JobRecord& job) {
  Json result{{"source", entry.image}};
  result.update(settings.arguments.to_json());
  result.update(to_json(job.facts));
  if (!entry.anneals) result["method"] = "exact";
  // The plain tile, motion (0, 0), stands in the middle of its set; a stack has as many sets as slices.
  const auto motions = static_cast<std::size_t>((2 * entry.motion + 1) * (2 * entry.motion + 1));
  TileRecord plain;
  for (std::size_t i = motions / 2; i < job.tiles.size(); i += motions) {
    plain.start_energy += job.tiles[i].start_energy;
    plain.energy += job.tiles[i].energy;
    plain.lower_bound += job.tiles[i].lower_bound;
  }
  result["start_energy"] = plain.start_energy;
  result["energy"] = plain.energy;
  result["lower_bound"] = plain.lower_bound;
  result["optimal"] = std::all_of(job.tiles.begin(), job.tiles.end(),
                                  [](const auto& tile) { return tile.energy == tile.lower_bound; });
  result["seconds"] = rounded_seconds(job.seconds);
  if (!job.files.empty()) {
    result["file"] = job.files.front().path;
    result["pixel_hash"] = job.files.front().pixel_hash;
  }
  if (settings.json && job.tiles.size() > 1) {
    for (const auto& tile : job.tiles) result["tiles"].push_back(to_json(tile));
  }
  return result;
}

void run(Settings& settings, Session& session) {
  auto& entry = static_cast<RetargetEntry&>(settings.arguments.finish(settings.out.string()));
  AnnealTrace trace;
  check_flags(settings, entry);
  if (entry.anneals) finish_annealing(settings, entry.anneal, trace);
  const JobRecord job = make_entry(entry, session.execution_showing("retarget"));
  session.progress.finish();
  if (!settings.trace.empty()) write_text_file(settings.trace, trace.csv(job.tiles.front().lower_bound));
  for (const auto& note : settings.notes) session.progress.note(note);
  for (const auto& note : job.notes) session.progress.note(note);
  if (settings.seconds > 0.0) {
    const auto proposals = job.facts.get<std::int64_t>("proposals").value_or(0);
    session.progress.note(
        fmt::format("{} s are {} proposals here; give --proposals {} for the same bytes again",
                    settings.seconds, proposals, proposals));
  }
  session.output.write_result(result_of(settings, entry, job), settings.json);
  const bool has_table = entry.motion > 0 && !job.facts.find("slices");
  if (!settings.json && has_table) session.output.tell(energy_table(job.tiles, entry.motion));
}

/// Flags of version 0.1, which go on working.
void declare_older_names(Arguments& arguments, Settings& settings) {
  arguments.older_name("--budget", "N|SECONDSs", [&settings](std::string_view text) {
    const bool timed = text.ends_with('s');
    settings.notes.emplace_back(timed ? "--budget is --seconds now" : "--budget is --proposals now");
    if (!timed) return settings.arguments.assign("proposals", text, "--budget");
    settings.seconds = real_in(0.0, 1e6, "seconds").parse(text.substr(0, text.size() - 1), "--budget");
  });
  arguments.older_name("--no-wrap", "", [&settings](std::string_view) {
    settings.notes.emplace_back("--no-wrap is --wrap false now");
    settings.arguments.assign("wrap", "false", "--no-wrap");
  });
}

}  // namespace

Verb retarget_verb() {
  const auto settings = std::make_shared<Settings>();
  const Kind& kind = *find_kind("retarget");
  Verb verb;
  verb.name = kind.verb;
  verb.summary = kind.summary;
  verb.details = kind.details;
  for (const auto& [command, purpose] : kind.examples) verb.examples.push_back({command, purpose});
  settings->arguments.declare(verb.arguments);
  verb.arguments.option(
      "--seconds", settings->seconds, real_in(0.0, 1e6, "seconds"),
      "A budget by the clock in place of --proposals: a trial run turns it into proposals.");
  verb.arguments.in_group("With --method anneal");
  verb.arguments.option(
      "--trace", settings->trace, text_path(),
      "Write annealing's course as CSV (one tile only); docs/annealing.md lists its columns.");
  verb.arguments.in_group("With --method anneal");
  declare_older_names(verb.arguments, *settings);
  verb.arguments.option("--out", settings->out, texture_path(),
                        "The file to write, 8 bit, in .exr float; its extension decides the format. Without "
                        "it only the figures are "
                        "printed.",
                        "-o");
  verb.arguments.flag("--json", settings->json, true, "Print the result as JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
