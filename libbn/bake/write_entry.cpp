// One entry: made, written, recorded. Single commands come through here too, with files anywhere.

#include "bake/write_entry.h"

#include <chrono>

#include "bake/bake_meter.h"
#include "bake/inputs.h"
#include "bake/kinds/retarget_source.h"
#include "bake/texture_files.h"
#include "bn/error.h"
#include "core/utf8.h"

namespace bn {

using namespace baking;

namespace {

Metadata metadata_of(const Entry& entry, std::size_t output, const std::vector<Input>& inputs,
                     const OutputFile& file, const std::vector<TileRecord>& tiles) {
  Metadata metadata = entry.metadata(output, inputs, file.path.parent_path());
  metadata.recipe = file.recipe;
  metadata.tiles = tiles;
  return metadata;
}

JobRecord record_of(const Entry& entry, const Made& made) {
  return {.kind = entry.kind().table,
          .name = entry.name,
          .facts = made.facts,
          .tiles = made.tiles,
          .notes = made.notes};
}

/// Makes the entry and hands every picture with its metadata to `take`.
template <class Take>
JobRecord make_files(const Entry& entry, const std::vector<Input>& inputs,
                     const std::vector<OutputFile>& files, const Execution& execution, Take take) {
  const auto start = std::chrono::steady_clock::now();
  const Made made = entry.make(inputs, execution);
  JobRecord job = record_of(entry, made);
  for (std::size_t i = 0; i < files.size(); ++i) {
    throw_if_stopped(execution);
    Picture picture = made.picture(i);
    Metadata metadata = metadata_of(entry, i, inputs, files[i], picture.tiles);
    job.files.push_back({.path = files[i].name,
                         .kind = metadata.kind,
                         .pixel_hash = pixel_hash(picture.image),
                         .tiles = picture.tiles});
    take(files[i], std::move(picture), std::move(metadata), job.files.back());
  }
  const std::filesystem::path checkpoint = entry.checkpoint();
  std::error_code ignored;
  if (!checkpoint.empty()) std::filesystem::remove(checkpoint, ignored);
  job.seconds = seconds_since(start);
  return job;
}

OnFile written(const BakeEvents& events) {
  return [&events](const FileRecord& file) {
    if (events) events(FileWritten{file});
  };
}

/// Passes the progress of a single entry on as that of a bake.
Execution metered(const Execution& execution, BakeMeter& meter) {
  Execution inner = execution;
  inner.progress = [&meter](double done) { meter.update(0, done); };
  return inner;
}

/// The recipe that a file will carry must be one: this holds the options to the ranges of a recipe,
/// and paths to text that TOML can hold, before any work.
void check_recipes(const Entry& entry, const std::vector<OutputFile>& files) {
  const auto check_name = [](const std::string& name) {
    if (is_utf8(name)) return;
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "its name is not UTF-8, and files record it as text",
                 .where = name,
                 .limit = "UTF-8",
                 .remedy = "give the file another name"});
  };
  const Options options = options_of(entry);
  for (const Option& option : options.list()) {
    if (!option.names_file || !option.applies()) continue;
    const Value value = option.get();
    if (const auto* const name = std::get_if<std::string>(&value)) check_name(*name);
  }
  for (const OutputFile& file : files) {
    check_name(file.name);
    try {
      parse_recipe(file.recipe, file.name, "");
    } catch (const Error& error) {
      ErrorInfo info = error.info();
      info.where = file.name;  // the line is one of a text that nobody has seen
      throw Error(info);
    }
  }
}

/// What can be checked of an entry's outputs before the work starts.
std::vector<OutputFile> checked_files(const Entry& entry, const std::vector<Input>& inputs) {
  const std::vector<OutputFile> files = free_output_files(entry);
  check_recipes(entry, files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const int depth = entry.output_depth(i, shapes_of(inputs));
    check_texture_writable(files[i].path, depth, entry.output_type(i), entry.output_channels(i));
    for (const Input& input : inputs) {
      if (!would_replace(files[i].path, input.path)) continue;
      throw Error({.code = ErrorCode::invalid_input,
                   .what = "would replace the image that it is made for",
                   .where = files[i].path.string(),
                   .limit = "",
                   .remedy = "write to another file"});
    }
  }
  return files;
}

std::vector<Input> read_inputs(const Entry& entry, const Execution& execution) {
  std::vector<Input> inputs;
  for (const InputName& input : input_names(entry)) {
    if (!input.is_file()) {
      throw Error({.code = ErrorCode::invalid_input,
                   .what = "names another entry",
                   .where = input.key,
                   .limit = "a file",
                   .remedy = "bake a recipe that has both"});
    }
    inputs.push_back(read_input(input.text, execution));
  }
  return inputs;
}

BakePlan plan_of(const Entry& entry) {
  BakePlan plan;
  plan.jobs = {{.kind = entry.kind().table, .name = entry.name, .estimated_seconds = 1.0}};
  return plan;
}

}  // namespace

JobRecord baking::write_entry(const Entry& entry, const std::vector<Input>& inputs,
                              const std::vector<OutputFile>& files, const Execution& execution,
                              const OnFile& on_file) {
  return make_files(entry, inputs, files, execution,
                    [&](const OutputFile& file, const Picture& picture, const Metadata& metadata,
                        const FileRecord& record) {
                      write_texture(file.path, picture, metadata);
                      if (on_file) on_file(record);
                    });
}

JobRecord make_entry(const Entry& given, const Execution& execution, const BakeEvents& events) {
  const std::vector<Input> inputs = read_inputs(given, execution);
  std::vector<OutputFile> files = checked_files(given, inputs);
  std::shared_ptr<Entry> entry = given.clone();
  if (entry->settle(inputs, execution)) files = free_output_files(*entry);
  const BakePlan plan = plan_of(*entry);
  BakeMeter meter(plan, execution, events);
  JobRecord job = write_entry(*entry, inputs, files, metered(execution, meter), written(events));
  meter.finish();
  return job;
}

BakedEntry bake_entry(const Entry& entry, const Execution& execution) {
  const std::vector<OutputFile> files = free_output_files(entry);
  check_recipes(entry, files);
  BakedEntry baked;
  baked.record =
      make_files(entry, read_inputs(entry, execution), files, execution,
                 [&](const OutputFile& file, Picture picture, Metadata metadata, const FileRecord& record) {
                   metadata.pixel_hash = record.pixel_hash;
                   baked.files.push_back({file.name, std::move(picture.image), std::move(metadata)});
                 });
  return baked;
}

JobRecord write_retarget(const RetargetEntry& entry, const RetargetTile& tile, const Execution& execution) {
  if (entry.outputs.size() != 1 || entry.outputs[0].kind != RetargetOutput::Kind::tile) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "an entry of several outputs, or an atlas",
                 .where = "outputs",
                 .limit = "one tile",
                 .remedy = ""});
  }
  const std::vector<Input> inputs = read_inputs(entry, execution);
  const OutputFile file = checked_files(entry, inputs).front();
  const Made made = entry.made_elsewhere(inputs, tile);
  JobRecord job = record_of(entry, made);
  const Picture picture = made.picture(0);
  write_image(file.path, picture.image, metadata_of(entry, 0, inputs, file, picture.tiles));
  job.files.push_back({.path = file.name,
                       .kind = "retarget-tile",
                       .pixel_hash = pixel_hash(picture.image),
                       .tiles = picture.tiles});
  return job;
}

}  // namespace bn
