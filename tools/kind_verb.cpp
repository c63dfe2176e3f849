#include "tools/kind_verb.h"

#include <fmt/format.h>

#include "bn/volume.h"
#include "tools/entry_arguments.h"

namespace bn::tools {
namespace {

struct Settings {
  explicit Settings(const Kind& kind) : arguments(kind) {}
  EntryArguments arguments;
  int count = 1;
  std::filesystem::path out;
  bool json = false;
};

Json file_json(const JobRecord& job) {
  return {{"file", job.files.front().path}, {"pixel_hash", job.files.front().pixel_hash}};
}

void run(Settings& settings, Session& session) {
  Entry& entry = settings.arguments.finish(settings.out.string());
  std::vector<std::shared_ptr<const Entry>> all = {entry.clone()};
  if (settings.count > 1) {
    all.clear();
    for (int i = 0; i < settings.count; ++i) all.push_back(numbered_entry(entry, i));
    make_folder_of(settings.out);
  }
  const Execution execution = session.execution_showing(entry.kind().table);
  std::vector<JobRecord> jobs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Execution part = execution;
    if (execution.progress) {
      part.progress = [&, i](double done) {
        execution.progress((static_cast<double>(i) + done) / static_cast<double>(all.size()));
      };
    }
    jobs.push_back(make_entry(*all[i], part));
  }
  session.progress.finish();
  double seconds = 0.0;
  for (const JobRecord& job : jobs) {
    for (const auto& note : job.notes) session.progress.note(note);
    seconds += job.seconds;
  }
  Json result = Json::object();
  if (jobs.size() == 1) result["file"] = jobs[0].files.front().path;
  result.update(settings.arguments.to_json());
  if (jobs.size() == 1) {
    result["pixel_hash"] = jobs[0].files.front().pixel_hash;
  } else {
    result["count"] = jobs.size();
    for (const JobRecord& job : jobs) result["files"].push_back(file_json(job));
  }
  result["seconds"] = rounded_seconds(seconds);
  session.output.write_result(result, settings.json);
}

}  // namespace

Verb kind_verb(const Kind& kind) {
  const auto settings = std::make_shared<Settings>(kind);
  Verb verb;
  verb.name = kind.verb;
  verb.summary = kind.summary;
  verb.details = kind.details;
  for (const auto& [command, purpose] : kind.examples) verb.examples.push_back({command, purpose});
  settings->arguments.declare(verb.arguments);
  verb.arguments.option("--count", settings->count, integer_in(1, 1024),
                        "How many to make; the path then has a place for the number, such as %03d.");
  verb.arguments.required_option("--out", settings->out, texture_path(),
                                 "The file to write; its extension decides the format.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print the result as JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
