// What a bake would do. Everything that can fail without computing fails here.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "bake/contact_sheet.h"
#include "bake/inputs.h"
#include "bake/texture_files.h"
#include "bake/up_to_date.h"
#include "bn/bake.h"
#include "bn/error.h"
#include "core/diagnostics.h"

namespace bn {

using namespace baking;

namespace {

namespace fs = std::filesystem;

/// The nearest folder of `path` that exists.
fs::path existing_folder(fs::path path) {
  path = fs::absolute(path).lexically_normal();
  std::error_code failed;
  while (!fs::exists(path, failed) && path.has_relative_path()) path = path.parent_path();
  return path;
}

class Planner {
 public:
  Planner(const Recipe& recipe, const BakeOptions& options, const Execution& execution)
      : recipe_(recipe), options_(options), execution_(execution), diagnostics_(recipe.name) {}

  BakePlan plan() {
    thread_count(execution_);
    check_out_dir();
    if (!options_.force) earlier_ = earlier_manifest(options_.out_dir);
    for (const std::size_t index : baking_order(recipe_)) plan_entry(*recipe_.entries[index]);
    if (!recipe_.contact_sheet.empty()) plan_contact_sheet();
    for (const auto& entry : recipe_.entries) check_inputs_survive(*entry);
    diagnostics_.throw_if_any();
    for (const PlannedJob& job : plan_.jobs) {
      if (!job.up_to_date) plan_.estimated_seconds += job.estimated_seconds;
      plan_.memory_bytes = std::max(plan_.memory_bytes, job.memory_bytes);
    }
    return std::move(plan_);
  }

 private:
  void check_out_dir() {
    const fs::path folder = existing_folder(options_.out_dir);
    if (!fs::is_directory(folder)) {
      throw Error({.code = ErrorCode::io,
                   .what = "is a file, no folder",
                   .where = folder.string(),
                   .limit = "",
                   .remedy = "name another output folder with --out"});
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
      throw Error({.code = ErrorCode::io,
                   .what = "no permission to write into this folder",
                   .where = folder.string(),
                   .limit = "",
                   .remedy = "change its permissions or name another output folder with --out"});
    }
  }

  /// Notes as a mistake in `line` what `check` throws as invalid input.
  template <class Check>
  bool passes(int line, const std::string& what, Check check) {
    try {
      check();
      return true;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::invalid_input) throw;
      const ErrorInfo& info = error.info();
      diagnostics_.add(line, fmt::format("{}: {}", what, info.what), info.limit, info.remedy);
      return false;
    }
  }

  void check_file(int line, const std::string& what, const std::string& path, int depth, SampleType type,
                  int channels) {
    // The folders of a new bake do not exist yet; the nearest one that does answers for them.
    const fs::path file = options_.out_dir / path;
    const fs::path probe = existing_folder(file.parent_path()) / file.filename();
    passes(line, fmt::format("{}: output '{}'", what, path),
           [&] { check_texture_writable(probe, depth, type, channels); });
  }

  const PlannedJob* job_of(const Entry& entry) const {
    for (const PlannedJob& job : plan_.jobs) {
      if (job.kind == entry.kind().table && job.name == entry.name) return &job;
    }
    return nullptr;
  }

  void plan_entry(const Entry& entry) {
    const std::string what = fmt::format("{} '{}'", entry.kind().table, entry.name);
    PlannedJob job{.kind = entry.kind().table, .name = entry.name};
    for (std::size_t i = 0; i < entry.output_count(); ++i) job.files.push_back(entry.path_of(i));
    std::vector<Shape> shapes;
    std::vector<Input> inputs;
    bool can_look = true;
    const std::vector<InputName> names = input_names(entry);
    const std::vector<fs::path> paths = input_paths(recipe_, entry, options_.out_dir);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].is_file()) {
        const std::string input = fmt::format("{}: {} '{}'", what, names[i].key, names[i].text);
        if (!passes(entry.line, input, [&] { inputs.push_back(read_input(paths[i], execution_)); })) return;
        shapes.push_back(inputs.back().image.shape());
        continue;
      }
      const auto source = find_entry(recipe_, names[i]);
      if (const auto shape = source->shape()) shapes.push_back(*shape);
      const PlannedJob* made_by = job_of(*source);
      can_look = can_look && made_by && made_by->up_to_date;
      if (can_look) inputs.push_back(read_input(paths[i], execution_));
    }
    for (std::size_t i = 0; i < entry.output_count(); ++i) {
      check_file(entry.line_of_output(i), what, entry.path_of(i), entry.output_depth(i, shapes),
                 entry.output_type(i), entry.output_channels(i));
    }
    entry.check_inputs(shapes,
                       [&](std::string_view key, std::string problem, std::string limit, std::string remedy) {
                         diagnostics_.add(entry.line, fmt::format("{}: {} {}", what, key, problem),
                                          std::move(limit), std::move(remedy));
                       });
    const Cost cost = entry.cost(shapes, execution_);
    job.estimated_seconds = cost.seconds;
    job.memory_bytes = cost.memory_bytes;
    check_memory(execution_, job.memory_bytes, fmt::format("{}:{}: {}", recipe_.name, entry.line, what));
    // What an entry reads of its inputs, a channel say, must be there too.
    const bool fits = !can_look || passes(entry.line, what, [&] {
      const auto files = output_files(recipe_, entry, options_.out_dir);
      job.up_to_date = up_to_date(job.kind, job.name, files, earlier_, execution_, [&](std::size_t i) {
                         return entry.metadata(i, inputs, files[i].path.parent_path());
                       }).has_value();
      if (!job.up_to_date) entry.check_input_contents(inputs);
    });
    if (fits) plan_.jobs.push_back(std::move(job));
  }

  void check_inputs_survive(const Entry& entry) {
    for (const InputName& input : input_names(entry)) {
      if (!input.is_file()) continue;
      for (const PlannedJob& job : plan_.jobs) {
        for (const std::string& file : job.files) {
          if (!would_replace(options_.out_dir / file, recipe_.folder / input.text)) continue;
          diagnostics_.add(entry.line,
                           fmt::format("{} '{}': {} '{}' would be replaced by the output '{}' of '{}'",
                                       entry.kind().table, entry.name, input.key, input.text, file, job.name),
                           "", "give the output another path, or bake into another folder");
        }
      }
    }
  }

  void plan_contact_sheet() {
    constexpr double kContactSheetSeconds = 0.3;
    check_file(0, "contact_sheet", recipe_.contact_sheet, 1, SampleType::u8, 3);
    const bool others_hold =
        std::all_of(plan_.jobs.begin(), plan_.jobs.end(), [](auto& job) { return job.up_to_date; });
    const OutputFile file = contact_sheet_file(recipe_, options_.out_dir);
    plan_.jobs.push_back(
        {.kind = kContactSheetKind,
         .name = kContactSheetJob,
         .files = {file.name},
         .estimated_seconds = kContactSheetSeconds,
         .memory_bytes = std::uint64_t{64} << 20,
         .up_to_date =
             others_hold &&
             up_to_date(kContactSheetKind, kContactSheetJob, {file}, earlier_, execution_, [](std::size_t) {
               return contact_sheet_metadata();
             }).has_value()});
  }

  const Recipe& recipe_;
  const BakeOptions& options_;
  const Execution& execution_;
  document::Diagnostics diagnostics_;
  Manifest earlier_;
  BakePlan plan_;
};

}  // namespace

BakePlan plan_bake(const Recipe& recipe, const BakeOptions& options, const Execution& execution) {
  return Planner(recipe, options, execution).plan();
}

}  // namespace bn
