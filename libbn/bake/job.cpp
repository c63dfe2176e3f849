#include "bake/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>

namespace bn {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Writes and records one file.
void write_file(const JobFile& file, const Image& image, const Metadata& metadata, JobRecord& job,
                const OnFile& on_file) {
  write_image(file.path, image, metadata);
  job.files.push_back(
      {.path = file.name, .kind = metadata.kind, .pixel_hash = pixel_hash(image), .tiles = metadata.tiles});
  if (on_file) on_file(job.files.back());
}

}  // namespace

Metadata mask_metadata(const MaskEntry& entry, const JobFile& file) {
  Metadata metadata;
  metadata.algorithm = "void-and-cluster";
  metadata.algorithm_version = kVoidAndClusterVersion;
  metadata.kind = "mask";
  metadata.recipe = file.recipe;
  metadata.seed = entry.options.seed;
  return metadata;
}

JobRecord run_mask_job(const MaskEntry& entry, const std::vector<JobFile>& files, const Execution& execution,
                       const OnFile& on_file) {
  const auto start = std::chrono::steady_clock::now();
  JobRecord job{.kind = JobKind::mask, .name = entry.name};
  const Grid<std::uint32_t> rank = void_and_cluster(entry.options, execution);
  for (std::size_t i = 0; i < files.size(); ++i) {
    write_file(files[i], encode_mask(rank, entry.outputs[i].type), mask_metadata(entry, files[i]), job,
               on_file);
  }
  job.seconds = seconds_since(start);
  return job;
}

Source read_source(const std::filesystem::path& path, int channel, const Execution& execution) {
  const FileContent file = read_image(path, execution);
  try {
    return {.path = path,
            .channel = channel,
            .hash = pixel_hash(file.image),
            .is_mask = file.metadata && file.metadata->kind == "mask",
            .levels = levels_of_channel(file.image, channel)};
  } catch (const Error& error) {
    ErrorInfo info = error.info();
    info.where = info.where.empty() ? path.string() : fmt::format("{}: {}", path.string(), info.where);
    throw Error(info);
  }
}

std::vector<std::string> source_notes(const Source& source, const RetargetOptions& options) {
  std::vector<std::string> notes;
  const Levels& levels = source.levels;
  const Offset step = options.step;
  const Extent size = levels.value.size();
  if (levels.distinct == 1) {
    notes.emplace_back("the source is constant: every permutation has energy 0");
  } else if (levels.distinct == 2) {
    notes.emplace_back("the source has two levels only: most permutations cost the same");
  } else if (!levels.is_permutation && !source.is_mask) {
    notes.emplace_back(
        "the source is no permutation (its levels are not equally frequent): energies do not compare with a "
        "mask's");
  }
  if (levels.rounding_error > 0.0) {
    notes.push_back(fmt::format("float samples rounded to 65536 levels of {:.3g}, by at most {:.3g}",
                                levels.unit, levels.rounding_error));
  }
  if (wrap(step.x, size.width) == 0 && wrap(step.y, size.height) == 0) {
    notes.emplace_back("the step is 0 on this tile: the dither never changes, and not moving is optimal");
  } else {
    const std::int64_t orbit = orbit_length(size, step);
    const AutoStep best = auto_step(size);
    if (orbit < best.orbit_length) {
      notes.push_back(fmt::format("step ({}, {}) repeats after {} frames; ({}, {}) would after {}", step.x,
                                  step.y, orbit, best.step.x, best.step.y, best.orbit_length));
    }
  }
  if (2 * options.radius >= std::min(size.width, size.height)) {
    notes.push_back(
        fmt::format("radius {} reaches around the tile of {}x{}: some offsets name the same pixel",
                    options.radius, size.width, size.height));
  }
  return notes;
}

Metadata retarget_metadata(const RetargetEntry& entry, const RetargetOutput& output, const Source& source,
                           const JobFile& file) {
  Metadata metadata;
  metadata.algorithm = entry.anneal ? "retarget-anneal" : "retarget-exact";
  metadata.algorithm_version = entry.anneal ? kAnnealVersion : kExactRetargetVersion;
  if (entry.anneal) metadata.seed = entry.anneal->seed;
  metadata.kind = output.kind == RetargetOutput::Kind::tile ? "retarget-tile" : "retarget-atlas";
  metadata.recipe = file.recipe;
  metadata.step = entry.step ? *entry.step : auto_step(source.levels.value.size()).step;
  metadata.radius = entry.options.radius;
  metadata.reach = name_of(entry.options.reach);
  metadata.metric = name_of(entry.options.metric);
  metadata.wrap = entry.options.wrap;
  metadata.form = name_of(output.form);
  const auto folder = std::filesystem::absolute(file.path).lexically_normal().parent_path();
  metadata.source =
      std::filesystem::absolute(source.path).lexically_normal().lexically_relative(folder).generic_string();
  metadata.source_channel = source.channel;
  metadata.source_hash = source.hash;
  return metadata;
}

namespace {

AnnealOptions anneal_options(const AnnealMethod& method) {
  AnnealOptions options;
  options.schedule = method.schedule;
  options.proposals = method.proposals;
  options.seed = method.seed;
  options.end_temperature = method.end_temperature;
  using Rule = StartTemperature::Rule;
  if (method.start_temperature > 0.0) options.start = {Rule::given, method.start_temperature};
  if (method.initial_acceptance > 0.0) options.start = {Rule::acceptance, method.initial_acceptance};
  return options;
}

/// One tile, going on from its checkpoint if there is one and leaving none behind.
AnnealResult anneal_with_checkpoint(const AnnealProblem& problem, AnnealOptions options, const AnnealMethod& method,
                                    const Execution& execution) {
  if (method.checkpoint.empty()) return anneal_retarget(problem, options, execution, method.trace);
  if (std::filesystem::exists(method.checkpoint)) {
    std::ifstream file(method.checkpoint, std::ios::binary);
    options.checkpoint.resume.assign(std::istreambuf_iterator<char>(file), {});
    if (!file.good() && !file.eof()) {
      throw Error({.code = ErrorCode::io,
                   .what = "cannot be read",
                   .where = method.checkpoint.string(),
                   .limit = "",
                   .remedy = "remove it to start afresh"});
    }
    // An empty file is no checkpoint; let the annealer say so.
    if (options.checkpoint.resume.empty()) options.checkpoint.resume = std::string(1, '\0');
  }
  options.checkpoint.save = [&](std::string_view bytes) { write_text_file(method.checkpoint, bytes); };
  AnnealResult result = anneal_retarget(problem, options, execution, method.trace);
  std::error_code ignored;
  std::filesystem::remove(method.checkpoint, ignored);
  return result;
}

/// The tiles of a motion set, with lower bounds from the exact solver: a certificate within 1 % comes soon.
std::vector<RetargetTile> anneal_tiles(const Grid<std::int32_t>& levels, const RetargetOptions& options,
                                       const AnnealMethod& method, int motion, const Execution& execution) {
  AnnealProblem problem;
  problem.channels = {{levels}};
  problem.retarget = options;
  problem.retarget.motion = {0, 0};
  std::vector<AnnealResult> results;
  if (motion == 0) {
    results.push_back(anneal_with_checkpoint(problem, anneal_options(method), method, execution));
  } else {
    results = anneal_motion_set(problem, anneal_options(method), motion, execution);
  }
  RetargetOptions bound = options;
  bound.gap = 0.01;
  const Execution silent{.threads = execution.threads, .stop = execution.stop, .memory_limit_bytes = execution.memory_limit_bytes};
  const std::vector<RetargetTile> bounds = solve_motion_set(levels, bound, motion, silent);
  std::vector<RetargetTile> tiles;
  for (std::size_t i = 0; i < results.size(); ++i) {
    results[i].tile.lower_bound = bounds[i].lower_bound;
    tiles.push_back(std::move(results[i].tile));
  }
  return tiles;
}

}  // namespace

JobRecord run_retarget_job(const RetargetEntry& entry, const Source& source,
                           const std::vector<JobFile>& files, const Execution& execution,
                           const OnFile& on_file) {
  const auto start = std::chrono::steady_clock::now();
  JobRecord job{.kind = JobKind::retarget, .name = entry.name};
  const Extent size = source.levels.value.size();
  if (entry.motion < 0 || entry.motion > std::min(8, largest_motion(size))) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("motion {} on a tile of {}x{}", entry.motion, size.width, size.height),
                 .where = "motion",
                 .limit = fmt::format("0..{}", std::min(8, largest_motion(size))),
                 .remedy = ""});
  }
  RetargetOptions options = entry.options;
  options.step = entry.step ? *entry.step : auto_step(size).step;
  job.step = options.step;
  job.orbit_length = orbit_length(size, options.step);
  job.notes = source_notes(source, options);

  const std::vector<RetargetTile> tiles =
      entry.anneal ? anneal_tiles(source.levels.value, options, *entry.anneal, entry.motion, execution)
                   : solve_motion_set(source.levels.value, options, entry.motion, execution);
  for (int y = -entry.motion; y <= entry.motion; ++y) {
    for (int x = -entry.motion; x <= entry.motion; ++x) {
      const RetargetTile& tile = tiles[motion_index({x, y}, entry.motion)];
      job.tiles.push_back({.motion = {x, y},
                           .start_energy = tile.start_energy,
                           .energy = tile.energy,
                           .lower_bound = tile.lower_bound});
    }
  }
  const auto encode = [&](std::size_t index, MoveForm form) {
    return encode_moves(form == MoveForm::scatter ? tiles[index].move : invert_moves(tiles[index].move));
  };
  for (std::size_t i = 0; i < files.size(); ++i) {
    throw_if_stopped(execution);
    const RetargetOutput& output = entry.outputs[i];
    Metadata metadata = retarget_metadata(entry, output, source, files[i]);
    Image image;
    if (output.kind == RetargetOutput::Kind::tile) {
      const std::size_t index = motion_index(output.motion, entry.motion);
      image = encode(index, output.form);
      metadata.tiles = {job.tiles[index]};
    } else {
      std::vector<Image> all;
      for (std::size_t index = 0; index < tiles.size(); ++index) all.push_back(encode(index, output.form));
      image = make_atlas(all, 2 * entry.motion + 1);
      metadata.tiles = job.tiles;
    }
    write_file(files[i], image, metadata, job, on_file);
  }
  job.seconds = seconds_since(start);
  return job;
}

JobRecord write_made_tile(const RetargetEntry& entry, const Source& source, const JobFile& file,
                          const RetargetTile& tile) {
  const RetargetOutput& output = entry.outputs.at(0);
  const Grid<std::int32_t>& levels = source.levels.value;
  RetargetOptions options = entry.options;
  options.step = entry.step ? *entry.step : auto_step(levels.size()).step;
  options.motion = output.motion;
  const auto require = [](bool holds, const char* what) {
    if (holds) return;
    throw Error({.code = ErrorCode::verification_failed,
                 .what = what,
                 .where = "tile",
                 .limit = "the figures of its moves on this source",
                 .remedy = "make it for this source and these options"});
  };
  require(tile.move.size() == levels.size(), "its size is not its source's");
  check_permutation(tile.move, options);
  require(retarget_energy(levels, tile.move, options) == tile.energy, "its energy is not that of its moves");
  require(retarget_energy(levels, Grid<Offset>(levels.size(), options.motion), options) == tile.start_energy,
          "its start energy is not the identity's");
  require(tile.lower_bound <= tile.energy, "its lower bound is above its energy");

  JobRecord job{.kind = JobKind::retarget, .name = entry.name};
  job.step = options.step;
  job.orbit_length = orbit_length(levels.size(), options.step);
  job.notes = source_notes(source, options);
  job.tiles = {{.motion = options.motion,
                .start_energy = tile.start_energy,
                .energy = tile.energy,
                .lower_bound = tile.lower_bound}};
  Metadata metadata = retarget_metadata(entry, output, source, file);
  metadata.tiles = job.tiles;
  const bool scatter = output.form == MoveForm::scatter;
  write_file(file, encode_moves(scatter ? tile.move : invert_moves(tile.move)), metadata, job, {});
  return job;
}

}  // namespace bn
