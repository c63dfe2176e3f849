// bn bake: everything a recipe names.

#include <fmt/format.h>

#include "bn/error.h"
#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

struct Settings {
  std::filesystem::path recipe;
  BakeOptions options;
  bool dry_run = false;
  bool json = false;
};

/// The events of a bake on the display: a program gets each as a JSON line, a person the bar.
class EventPrinter {
 public:
  explicit EventPrinter(ProgressDisplay& display) : display_(display) {}

  void operator()(const JobStarted& started) {
    const std::string number =
        started.count > 1 ? fmt::format("{}/{} ", started.index + 1, started.count) : "";
    display_.rename(fmt::format("{}{} {}", number, started.job.kind, started.job.name));
    display_.event({{"event", "job_started"},
                    {"index", started.index},
                    {"count", started.count},
                    {"kind", started.job.kind},
                    {"name", started.job.name}});
  }
  void operator()(const BakeProgress& progress) { display_.update(progress.done, progress.seconds_left); }
  void operator()(const FileWritten& written) {
    Json line{{"event", "file_written"}};
    line.update(to_json(written.file));
    display_.event(line);
  }
  void operator()(const JobFinished& finished) {
    Json line{{"event", "job_finished"}, {"index", finished.index}, {"count", finished.count}};
    line.update(to_json(finished.job));
    display_.event(line);
  }

 private:
  ProgressDisplay& display_;
};

std::string files_text(const std::vector<std::string>& paths) {
  return fmt::format("{}", fmt::join(paths, ", "));
}

void print_plan(const BakePlan& plan, const Settings& settings, Output& output) {
  if (settings.json) {
    Json result{{"recipe", settings.recipe.string()},
                {"out", settings.options.out_dir.string()},
                {"dry_run", true},
                {"estimated_seconds", rounded_seconds(plan.estimated_seconds)},
                {"memory_bytes", plan.memory_bytes},
                {"jobs", Json::array()}};
    for (const auto& job : plan.jobs) result["jobs"].push_back(to_json(job));
    return output.write_result(result, true);
  }
  std::string text;
  for (const auto& job : plan.jobs) {
    text += fmt::format("{:10} {:13} {:20} {:>10}  {}\n", job.up_to_date ? "up to date" : "to bake", job.kind,
                        job.name, job.up_to_date ? "" : fmt::format("{:.2f} s", job.estimated_seconds),
                        files_text(job.files));
  }
  output.tell(text + fmt::format("about {} on one core, {:.0f} MiB of memory; nothing was written\n",
                                 readable_duration(plan.estimated_seconds),
                                 static_cast<double>(plan.memory_bytes) / (1024.0 * 1024.0)));
}

void print_result(const BakeResult& result, const Settings& settings, Session& session) {
  if (settings.json) {
    Json json{{"recipe", settings.recipe.string()},
              {"out", settings.options.out_dir.string()},
              {"manifest", result.manifest.string()},
              {"seconds", rounded_seconds(result.seconds)},
              {"jobs", Json::array()}};
    for (const auto& job : result.jobs) json["jobs"].push_back(to_json(job));
    return session.output.write_result(json, true);
  }
  std::string text;
  for (const auto& job : result.jobs) {
    std::vector<std::string> paths;
    for (const auto& file : job.files) paths.push_back(file.path);
    const std::string energy = energy_text(job.tiles);
    text +=
        // What took no time now has none to show.
        fmt::format("{:10} {:13} {:20} {:>10}  {}{}\n", job.skipped ? "up to date" : "baked", job.kind,
                    job.name, job.skipped ? "" : fmt::format("{:.2f} s", job.seconds), files_text(paths),
                    energy.empty() ? "" : "  energy " + energy);
    for (const auto& note : job.notes) session.progress.note(fmt::format("{}: {}", job.name, note));
  }
  session.output.tell(text + fmt::format("{} in {:.2f} s\n", result.manifest.string(), result.seconds));
}

void run(const Settings& settings, Session& session) {
  const Recipe recipe = read_recipe(settings.recipe);
  if (settings.dry_run) {
    return print_plan(plan_bake(recipe, settings.options, session.execution), settings, session.output);
  }
  session.progress.start("bake");
  EventPrinter printer(session.progress);
  try {
    const BakeResult result = bake(recipe, settings.options, session.execution,
                                   [&](const BakeEvent& event) { std::visit(printer, event); });
    session.progress.finish();
    print_result(result, settings, session);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) throw;
    ErrorInfo info = error.info();
    info.remedy = "the same command goes on where it stopped";
    throw Error(info);
  }
}

}  // namespace

Verb bake_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "bake";
  verb.summary = "Make every texture a recipe names, with proofs, manifest and contact sheet.";
  verb.examples = {
      {"bn bake textures/default.toml --out out", "bake a recipe into the folder out"},
      {"bn bake recipe.toml --dry-run", "what would be made, how long and with how much memory"},
      {"bn bake recipe.toml --out out --progress json 2> events.jsonl", "progress for a program"}};
  verb.details =
      "Checks the whole recipe first: a mistake costs no time. Results in the folder that are up to date, "
      "made by the "
      "same entry and with intact pixels, are kept. Ctrl-C stops cleanly; the same command goes on where it "
      "stopped "
      "and ends with the same bytes. manifest.json lists every file with its hash, energy and bound.";
  verb.arguments.positional("RECIPE", settings->recipe, file_path(),
                            "The recipe, a TOML file; docs/recipes.md lists its keys.");
  verb.arguments.option("--out", settings->options.out_dir, folder_path(),
                        "The folder to bake into; made if missing.", "-o");
  verb.arguments.flag("--dry-run", settings->dry_run, true,
                      "Check everything and say what would be made; write nothing.");
  verb.arguments.flag("--force", settings->options.force, true,
                      "Make everything again, also what is up to date.");
  verb.arguments.flag("--json", settings->json, true, "Print the result (or the plan) as JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
