#include "bake/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "bake/anneal_job.h"
#include "bn/error.h"

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

std::vector<int> channels_of(const RetargetEntry& entry) {
  if (entry.anneal && !entry.anneal->channels.empty()) return entry.anneal->channels;
  return {entry.channel};
}

Source read_source(const std::filesystem::path& path, const std::vector<int>& channels,
                   const Execution& execution) {
  const FileContent file = read_image(path, execution);
  try {
    Source source{.path = path,
                  .channel = channels.front(),
                  .hash = pixel_hash(file.image),
                  .is_mask = file.metadata && file.metadata->kind == "mask",
                  .levels = {}};
    for (const int channel : channels) source.levels.push_back(levels_of_channel(file.image, channel));
    return source;
  } catch (const Error& error) {
    ErrorInfo info = error.info();
    info.where = info.where.empty() ? path.string() : fmt::format("{}: {}", path.string(), info.where);
    throw Error(info);
  }
}

std::vector<std::string> source_notes(const Source& source, const RetargetOptions& options) {
  std::vector<std::string> notes;
  const Levels& levels = source.levels[0];
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
  for (const Levels& channel : source.levels) {
    if (channel.rounding_error == 0.0) continue;
    notes.push_back(fmt::format("float samples rounded to 65536 levels of {:.3g}, by at most {:.3g}",
                                channel.unit, channel.rounding_error));
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

Offset step_of(const RetargetEntry& entry, const Source& source) {
  return entry.step ? *entry.step : auto_step(source.levels[0].value.size()).step;
}

Metadata retarget_metadata(const RetargetEntry& entry, const RetargetOutput& output, const Source& source,
                           const JobFile& file) {
  Metadata metadata;
  metadata.algorithm = entry.anneal ? "retarget-anneal" : "retarget-exact";
  metadata.algorithm_version = entry.anneal ? kAnnealVersion : kExactRetargetVersion;
  if (entry.anneal) metadata.seed = entry.anneal->options.seed;
  metadata.kind = output.kind == RetargetOutput::Kind::tile ? "retarget-tile" : "retarget-atlas";
  metadata.recipe = file.recipe;
  metadata.step = step_of(entry, source);
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

JobRecord run_retarget_job(const RetargetEntry& entry, const Source& source,
                           const std::vector<JobFile>& files, const Execution& execution,
                           const OnFile& on_file) {
  const auto start = std::chrono::steady_clock::now();
  JobRecord job{.kind = JobKind::retarget, .name = entry.name};
  const Extent size = source.levels[0].value.size();
  if (entry.motion < 0 || entry.motion > std::min(8, largest_motion(size))) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("motion {} on a tile of {}x{}", entry.motion, size.width, size.height),
                 .where = "motion",
                 .limit = fmt::format("0..{}", std::min(8, largest_motion(size))),
                 .remedy = ""});
  }
  RetargetOptions options = entry.options;
  options.step = step_of(entry, source);
  job.step = options.step;
  job.orbit_length = orbit_length(size, options.step);
  job.notes = source_notes(source, options);

  const std::vector<RetargetTile> tiles =
      entry.anneal ? anneal_tiles(entry, source, execution)
                   : solve_motion_set(source.levels[0].value, options, entry.motion, execution);
  if (entry.anneal) job.proposals = entry.anneal->options.proposals;
  for (int y = -entry.motion; y <= entry.motion; ++y) {
    for (int x = -entry.motion; x <= entry.motion; ++x) {
      const RetargetTile& tile = tiles[motion_index({x, y}, entry.motion)];
      job.tiles.push_back({.motion = {x, y},
                           .start_energy = tile.start_energy,
                           .energy = tile.energy,
                           .lower_bound = tile.lower_bound});
      if (!entry.anneal) continue;
      RetargetOptions moving = options;
      moving.motion = {x, y};
      const std::int64_t recomputed = energy_of(entry, source, tile.move, moving);
      if (recomputed != tile.energy) {
        throw Error(
            {.code = ErrorCode::verification_failed,
             .what = fmt::format("annealing says energy {}, its tile has {}", tile.energy, recomputed),
             .where = fmt::format("{}, motion ({}, {})", entry.name, x, y),
             .limit = "equal",
             .remedy = "report it, with the image and the options"});
      }
      if (moving.motion == Offset{0, 0}) job.recomputed_energy = recomputed;
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
  if (entry.anneal && !entry.anneal->checkpoint.empty()) {
    std::error_code ignored;
    std::filesystem::remove(entry.anneal->checkpoint, ignored);
  }
  job.seconds = seconds_since(start);
  return job;
}

JobRecord write_made_tile(const RetargetEntry& entry, const Source& source, const JobFile& file,
                          const RetargetTile& tile) {
  const RetargetOutput& output = entry.outputs.at(0);
  const Grid<std::int32_t>& levels = source.levels[0].value;
  RetargetOptions options = entry.options;
  options.step = step_of(entry, source);
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
  require(energy_of(entry, source, tile.move, options) == tile.energy, "its energy is not that of its moves");
  require(energy_of(entry, source, Grid<Offset>(levels.size(), options.motion), options) == tile.start_energy,
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
