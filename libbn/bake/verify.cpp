// Does a file keep what it says? Nothing that is recorded is believed: pixels are hashed, masks baked
// again, energies recomputed from the definition, and lower bounds compared with a new proof.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "bake/anneal_job.h"
#include "bake/job.h"
#include "bake/manifest.h"
#include "bn/bake.h"
#include "bn/error.h"

namespace bn {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::optional<Offset>& value) {
  return value ? fmt::format("({}, {})", value->x, value->y) : "none";
}

class FileVerifier {
 public:
  FileVerifier(fs::path file, const Execution& execution, std::vector<VerifyItem>& items)
      : file_(std::move(file)), execution_(execution), items_(items) {}

  void verify() {
    FileContent content;
    const bool readable = attempt("metadata", [&] {
      content = read_image(file_, execution_);
      return std::string();
    });
    if (!readable) return;
    if (!content.metadata) {
      add("metadata", false,
          content.metadata_fault.empty() ? "none of this toolkit's; only files that it wrote can be verified"
                                         : "broken: " + content.metadata_fault);
      return;
    }
    image_ = std::move(content.image);
    metadata_ = std::move(*content.metadata);
    add("metadata", true,
        fmt::format("{}, {} {}, tool {}", metadata_.kind, metadata_.algorithm, metadata_.algorithm_version,
                    metadata_.tool_version));
    const std::string hash = pixel_hash(image_);
    add("hash", hash == metadata_.pixel_hash,
        hash == metadata_.pixel_hash
            ? hash
            : fmt::format("pixels have {}, recorded is {}", hash, metadata_.pixel_hash));
    if (!attempt("recipe", [&] { return check_recipe(); })) return;
    if (metadata_.kind == "mask") {
      attempt("pixels", [&] { return check_mask(); });
    } else if (metadata_.kind != "contact-sheet") {
      verify_tiles();
    }
  }

 private:
  void add(const char* check, bool pass, std::string detail) {
    items_.push_back({.file = file_, .check = check, .pass = pass, .detail = std::move(detail)});
  }

  [[noreturn]] static void fail(std::string what) {
    throw Error({.code = ErrorCode::verification_failed,
                 .what = std::move(what),
                 .where = "",
                 .limit = "",
                 .remedy = ""});
  }

  /// One item: passed with the text that `check` returns, or failed with what it throws.
  template <class Check>
  bool attempt(const char* name, Check check) {
    try {
      const std::string detail = check();
      if (!detail.empty()) add(name, true, detail);
      return true;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
      add(name, false, error.what());
      return false;
    }
  }

  /// The recipe must name this one file and agree with every recorded option.
  std::string check_recipe() {
    recipe_ = parse_recipe(metadata_.recipe, "recipe", file_.parent_path());
    const auto expect = [](bool same, const char* what, const std::string& recipe,
                           const std::string& recorded) {
      if (!same) fail(fmt::format("{} is {} in the recipe, {} in the record", what, recipe, recorded));
    };
    if (metadata_.kind == "contact-sheet") return "parses";
    if (metadata_.kind == "mask") {
      if (recipe_.masks.size() != 1 || !recipe_.retargets.empty() || recipe_.masks[0].outputs.size() != 1) {
        fail("names not just this mask");
      }
      const MaskEntry& mask = recipe_.masks[0];
      expect(metadata_.seed == mask.options.seed, "seed", fmt::format("{}", mask.options.seed),
             metadata_.seed ? fmt::format("{}", *metadata_.seed) : "none");
      expect(mask.outputs[0].type == image_.type, "sample type", std::string(name_of(mask.outputs[0].type)),
             std::string(name_of(image_.type)));
      return fmt::format("{}x{}, sigma {}, seed {}", mask.options.size.width, mask.options.size.height,
                         mask.options.sigma_px, mask.options.seed);
    }
    if (metadata_.kind != "retarget-tile" && metadata_.kind != "retarget-atlas") {
      fail(fmt::format("kind '{}' is unknown to this version", metadata_.kind));
    }
    if (recipe_.retargets.size() != 1 || recipe_.retargets[0].outputs.size() != 1)
      fail("names not just this file");
    const RetargetEntry& set = recipe_.retargets[0];
    const RetargetOutput& output = set.outputs[0];
    expect(!set.step || set.step == metadata_.step, "step", text_of(set.step), text_of(metadata_.step));
    expect(metadata_.radius == set.options.radius, "radius", fmt::format("{}", set.options.radius),
           metadata_.radius ? fmt::format("{}", *metadata_.radius) : "none");
    const auto same_word = [&](const char* what, std::string_view recipe,
                               const std::optional<std::string>& recorded) {
      expect(recorded == recipe, what, std::string(recipe), recorded.value_or("none"));
    };
    same_word("reach", name_of(set.options.reach), metadata_.reach);
    same_word("metric", name_of(set.options.metric), metadata_.metric);
    same_word("form", name_of(output.form), metadata_.form);
    same_word("wrap", set.options.wrap ? "true" : "false",
              metadata_.wrap ? std::optional<std::string>(*metadata_.wrap ? "true" : "false") : std::nullopt);
    const bool is_tile = output.kind == RetargetOutput::Kind::tile;
    same_word("kind", is_tile ? "retarget-tile" : "retarget-atlas", metadata_.kind);
    const int side = is_tile ? 1 : 2 * set.motion + 1;
    const int count = static_cast<int>(metadata_.tiles.size());
    expect(count == side * side, "number of tiles", fmt::format("{}", side * side), fmt::format("{}", count));
    for (int i = 0; i < count; ++i) {
      const Offset motion = is_tile ? output.motion : Offset{i % side - set.motion, i / side - set.motion};
      const Offset recorded = metadata_.tiles[static_cast<std::size_t>(i)].motion;
      expect(motion == recorded, "motion", text_of(motion), text_of(recorded));
    }
    if (image_.size.width % side != 0 || image_.size.height % side != 0) {
      fail(
          fmt::format("{}x{} pixels hold no {}x{} tiles", image_.size.width, image_.size.height, side, side));
    }
    options_ = set.options;
    options_.step = *metadata_.step;
    tile_size_ = {image_.size.width / side, image_.size.height / side};
    return fmt::format("step ({}, {}), radius {} {}, {}, {}", options_.step.x, options_.step.y,
                       options_.radius, name_of(options_.reach), name_of(options_.metric),
                       name_of(output.form));
  }

  std::string check_mask() {
    const MaskEntry& mask = recipe_.masks[0];
    if (metadata_.algorithm_version != kVoidAndClusterVersion) {
      fail(fmt::format(
          "made by version {} of void-and-cluster; this tool has version {} and cannot make it again",
          metadata_.algorithm_version, kVoidAndClusterVersion));
    }
    const Image again = encode_mask(void_and_cluster(mask.options, execution_), image_.type);
    if (again.size != image_.size) {
      fail(fmt::format("the recipe makes {}x{} pixels, the file has {}x{}", again.size.width,
                       again.size.height, image_.size.width, image_.size.height));
    }
    const std::size_t bytes = bytes_per_sample(image_.type);
    if (image_.channels != 1) fail(fmt::format("{} channels instead of 1", image_.channels));
    const auto [at, other] =
        std::mismatch(again.samples.begin(), again.samples.end(), image_.samples.begin());
    if (at != again.samples.end()) {
      const auto pixel =
          static_cast<std::int64_t>(at - again.samples.begin()) / static_cast<std::int64_t>(bytes);
      fail(fmt::format("differs from the mask that its recipe makes, first at pixel ({}, {})",
                       pixel % image_.size.width, pixel / image_.size.width));
    }
    return "equal to the mask made again from its recipe";
  }

  void verify_tiles() {
    const std::size_t count = metadata_.tiles.size();
    std::vector<Grid<Offset>> moves(count);  // in scatter form
    const bool bijective = attempt("bijection", [&] {
      for_each_tile([&](std::size_t i, const RetargetOptions&) {
        const Grid<Offset> stored = decode_moves(atlas_tile(image_, tile_size_, static_cast<int>(i)));
        const Grid<Offset> inverse = invert_moves(stored);
        moves[i] = metadata_.form == "gather" ? inverse : stored;
      });
      return fmt::format("{} of {} tiles", count, count);
    });
    if (!bijective) return;
    attempt("radius", [&] {
      for_each_tile(
          [&](std::size_t i, const RetargetOptions& options) { check_permutation(moves[i], options); });
      return fmt::format("every move within {} {}", options_.radius, name_of(options_.reach));
    });

    Source source;
    const bool has_source = attempt("source", [&] {
      if (!metadata_.source || !metadata_.source_channel || !metadata_.source_hash)
        fail("the file names none");
      const RetargetEntry& set = recipe_.retargets[0];
      std::vector<int> channels{*metadata_.source_channel};
      if (set.mask.empty()) channels = channels_of(set);
      if (channels[0] != *metadata_.source_channel)
        fail("the recipe reads another channel than the record says");
      source = read_source(file_.parent_path() / *metadata_.source, channels, execution_);
      if (source.hash != *metadata_.source_hash) {
        fail(fmt::format("{}: pixels have {}, recorded is {}", *metadata_.source, source.hash,
                         *metadata_.source_hash));
      }
      if (source.levels[0].value.size() != tile_size_) fail("the source and the tile differ in size");
      return fmt::format("{} {}", *metadata_.source, source.hash);
    });
    if (!has_source) return;
    attempt("energy", [&] { return check_energies(source, moves); });
    attempt("bound", [&] { return check_bounds(source); });
  }

  /// Calls each(index, options of that motion); an error tells which motion it was.
  template <class Each>
  void for_each_tile(Each each) {
    for (std::size_t i = 0; i < metadata_.tiles.size(); ++i) {
      RetargetOptions options = options_;
      options.motion = metadata_.tiles[i].motion;
      try {
        each(i, options);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::verification_failed) throw;
        fail(fmt::format("motion ({}, {}): {}", options.motion.x, options.motion.y, error.what()));
      }
    }
  }

  std::string check_energies(const Source& source, const std::vector<Grid<Offset>>& moves) {
    std::int64_t least = metadata_.tiles[0].energy, most = least;
    for_each_tile([&](std::size_t i, const RetargetOptions& options) {
      const TileRecord& recorded = metadata_.tiles[i];
      const std::int64_t energy = energy_of(recipe_.retargets[0], source, moves[i], options);
      if (energy != recorded.energy)
        fail(fmt::format("energy is {}, recorded is {}", energy, recorded.energy));
      const std::int64_t start =
          energy_of(recipe_.retargets[0], source, Grid<Offset>(tile_size_, options.motion), options);
      if (start != recorded.start_energy) {
        fail(fmt::format("start energy is {}, recorded is {}", start, recorded.start_energy));
      }
      least = std::min(least, energy);
      most = std::max(most, energy);
    });
    return least == most ? fmt::format("{}", least) : fmt::format("{}..{}", least, most);
  }

  /// A recorded bound holds if a new proof reaches it. The new proof may stop at the recipe's gap;
  /// only a bound between that proof and its permutation's energy needs the full one.
  std::string check_bounds(const Source& source) {
    const RetargetEntry& set = recipe_.retargets[0];
    if (set.anneal &&
        (source.levels.size() > 1 || set.anneal->residual_sigma_px > 0.0 || !set.anneal->weights.empty()))
      return check_anneal_bounds(anneal_problem(set, source));
    const Grid<std::int32_t>& levels = source.levels[0].value;
    std::vector<std::string> failures(metadata_.tiles.size());
    std::int64_t optimal = 0;
    for (const TileRecord& tile : metadata_.tiles) optimal += tile.energy == tile.lower_bound;
    Execution single = execution_;
    single.progress = {};
    const auto count = static_cast<std::int64_t>(failures.size());
    if (count > 1) single.threads = 1;
    parallel_for(execution_, count, [&](std::int64_t index) {
      const auto i = static_cast<std::size_t>(index);
      const TileRecord& recorded = metadata_.tiles[i];
      RetargetOptions options = options_;
      options.motion = recorded.motion;
      RetargetTile proof = solve_retarget(levels, options, single);
      if (recorded.lower_bound > proof.lower_bound && recorded.lower_bound <= proof.energy) {
        options.gap = 0.0;
        proof = solve_retarget(levels, options, single);
      }
      const auto claimed_gap = static_cast<double>(recorded.energy - recorded.lower_bound);
      if (recorded.lower_bound > proof.lower_bound) {
        failures[i] = fmt::format("recorded bound {} is none: a permutation with energy {} exists",
                                  recorded.lower_bound, proof.energy);
      } else if (!recipe_.retargets[0].anneal &&
                 claimed_gap > options_.gap * static_cast<double>(recorded.lower_bound)) {
        failures[i] =
            fmt::format("recorded bound {} is farther from the energy {} than the gap {} of the recipe",
                        recorded.lower_bound, recorded.energy, options_.gap);
      }
    });
    for_each_tile([&](std::size_t i, const RetargetOptions&) {
      if (!failures[i].empty()) fail(failures[i]);
    });
    return fmt::format("proven again, {} of {} tiles optimal", optimal, count);
  }

  /// Of energies that no exact solver handles whole: proven channel by channel.
  std::string check_anneal_bounds(AnnealProblem problem) {
    problem.retarget = options_;
    int range = 0;
    for (const TileRecord& tile : metadata_.tiles)
      range = std::max({range, std::abs(tile.motion.x), std::abs(tile.motion.y)});
    const std::vector<std::int64_t> bounds = anneal_bounds(problem, range, 0.0, execution_);
    for_each_tile([&](std::size_t i, const RetargetOptions& options) {
      const std::int64_t bound = bounds[motion_index(options.motion, range)];
      if (metadata_.tiles[i].lower_bound > bound) {
        fail(fmt::format("recorded bound {} is above {}, the most that is proven",
                         metadata_.tiles[i].lower_bound, bound));
      }
    });
    return problem.residual_sigma_px > 0.0 ? "0, as no energy is below it"
                                           : "proven again, channel by channel";
  }

  fs::path file_;
  const Execution& execution_;
  std::vector<VerifyItem>& items_;
  Image image_;
  Metadata metadata_;
  Recipe recipe_;
  RetargetOptions options_;
  Extent tile_size_;
};

bool is_ours_by_name(const fs::path& path) {
  static const std::vector<std::string> kExtensions = {".png", ".exr", ".tif", ".tiff", ".h", ".bin"};
  return std::find(kExtensions.begin(), kExtensions.end(), path.extension().string()) != kExtensions.end();
}

void verify_manifest(const fs::path& path, std::vector<VerifyItem>& items, const Execution& execution) {
  Manifest manifest;
  try {
    manifest = read_manifest(path);
  } catch (const Error& error) {
    items.push_back({.file = path, .check = "manifest", .pass = false, .detail = error.what()});
    return;
  }
  if (!manifest.complete) {
    items.push_back({.file = path,
                     .check = "manifest",
                     .pass = false,
                     .detail = "the bake was stopped before its end; run it again to complete it"});
  }
  for (const JobRecord& job : manifest.jobs) {
    for (const FileRecord& file : job.files) {
      VerifyItem item{
          .file = path.parent_path() / file.path, .check = "manifest", .pass = false, .detail = ""};
      try {
        const FileContent content = read_image(item.file, execution);
        const std::string hash = pixel_hash(content.image);
        const bool same_tiles = content.metadata && content.metadata->tiles == file.tiles;
        item.pass = hash == file.pixel_hash && same_tiles;
        item.detail = hash != file.pixel_hash
                          ? fmt::format("pixels have {}, listed is {}", hash, file.pixel_hash)
                      : same_tiles ? "as listed"
                                   : "energies or bounds differ from those listed";
      } catch (const Error& error) {
        if (error.code() == ErrorCode::over_limit) throw;
        item.detail = error.what();
      }
      items.push_back(std::move(item));
    }
  }
}

}  // namespace

std::vector<VerifyItem> verify_path(const fs::path& path, const Execution& execution) {
  std::error_code failed;
  if (!fs::exists(path, failed)) {
    throw Error(
        {.code = ErrorCode::io, .what = "does not exist", .where = path.string(), .limit = "", .remedy = ""});
  }
  std::vector<VerifyItem> items;
  if (!fs::is_directory(path)) {
    FileVerifier(path, execution, items).verify();
    return items;
  }
  std::vector<fs::path> files, manifests;
  for (auto entry = fs::recursive_directory_iterator(path, failed);
       !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
    if (!entry->is_regular_file(failed)) continue;
    if (entry->path().filename() == kManifestName) manifests.push_back(entry->path());
    if (is_ours_by_name(entry->path())) files.push_back(entry->path());
  }
  if (failed) {
    throw Error({.code = ErrorCode::io,
                 .what = "cannot be listed: " + failed.message(),
                 .where = path.string(),
                 .limit = "",
                 .remedy = ""});
  }
  std::sort(files.begin(), files.end());
  std::sort(manifests.begin(), manifests.end());
  if (files.empty() && manifests.empty()) {
    items.push_back(
        {.file = path, .check = "metadata", .pass = false, .detail = "no texture in this folder"});
  }
  Execution each = execution;
  for (std::size_t i = 0; i < files.size(); ++i) {
    throw_if_stopped(execution);
    each.progress = {};
    FileVerifier(files[i], each, items).verify();
    if (execution.progress)
      execution.progress(static_cast<double>(i + 1) / static_cast<double>(files.size()));
  }
  for (const fs::path& manifest : manifests) verify_manifest(manifest, items, execution);
  return items;
}

}  // namespace bn
