// Finding textures.
//
// Files say what they are in their metadata; a file without any is a texture of as many channels as differ.
// Slices of one stack, in files of their own or in one, are one volume. Files with the same samples, and
// files that a manifest lists under one mask's job, are encodings of one texture: the first stands for all.
// Tiles and atlases of one mask and one set of options are one retarget set. Nothing that a file names is
// opened but its mask, which must lie beside or below it and have the recorded hash.

#include "report/sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bn/error.h"
#include "bn/judgement.h"
#include "bn/retarget.h"
#include "bn/volume.h"
#include "report/candidates.h"
#include "report/stacks.h"
#include "texture/codec.h"

namespace bn::report {
namespace {

namespace fs = std::filesystem;

constexpr int kMostChannels = 4;

/// Throws invalid_input on NaN or infinity, as the analysis would, before anything else is done with them.
void check_finite(const Texture& texture) {
  for (const double value : texture.samples.value) {
    if (!std::isfinite(value)) {
      throw Error({.code = ErrorCode::invalid_input,
                   .what = "it holds NaN or infinity",
                   .where = texture.name,
                   .limit = "",
                   .remedy = ""});
    }
  }
}

/// Three equal channels; a fourth like them is a mask again, not an alpha.
bool is_grey_as_colour(const Image& image) {
  if (image.channels < 3) return false;
  const auto channel = [&](int c) { return samples_of_channel(image, c).value; };
  const std::vector<double> first = channel(0);
  return channel(1) == first && channel(2) == first && (image.channels != 4 || channel(3) != first);
}

class Collector {
 public:
  Collector(Collection& collection, const Execution& execution)
      : collection_(collection), execution_(execution) {}

  void add(const Candidate& candidate) {
    throw_if_stopped(execution_);
    try {
      FileContent content = texture::read_any(candidate.path, execution_);
      if (!content.metadata_fault.empty()) {
        note(candidate.name, fmt::format("its metadata cannot be read ({}), so it is taken as a picture",
                                         content.metadata_fault));
      }
      const std::string kind = content.metadata ? content.metadata->kind : "";
      if (kind == "contact-sheet" || kind == "spectrum") return;
      if (content.metadata && content.metadata->pixel_hash != pixel_hash(content.image)) {
        note(candidate.name, "its samples are not those it was written with (the recorded hash differs)");
      }
      if (slices_of(content) == 1 || content.image.depth > 1) return add_content(candidate, content);
      // One of several; alone it is a picture like any other.
      if (auto stack = stacks_.add(candidate, std::move(content))) {
        Candidate whole = stack->first;
        whole.name = fmt::format("{} and {} more", whole.name, stack->names.size() - 1);
        add_content(whole, stack->content);
      }
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
      keep_fault(error);
      note(candidate.name, error.info().what);
    }
  }

  /// Slices whose stack is not whole: masks are pictures, each for itself; tiles lead nowhere.
  void add_incomplete_stacks() {
    for (const Stacks::Part& part : stacks_.incomplete()) {
      const Candidate& first = part.slices.front().first;
      const bool tiles = is_retarget(part.slices.front().second);
      note(first.name, fmt::format("{} of {} slices are here, so {}", part.slices.size(), part.wanted,
                                   tiles ? "they are left out" : "each is shown for itself"));
      for (const auto& [candidate, content] : part.slices) {
        if (tiles) break;
        try {
          add_content(candidate, content);
        } catch (const Error& error) {
          if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
          note(candidate.name, error.info().what);
        }
      }
    }
  }

  void add_volume(const std::string& name, std::span<const fs::path> paths) {
    try {
      const Volume read = read_volume(paths, {}, execution_);
      collection_.notes.insert(collection_.notes.end(), read.notes.begin(), read.notes.end());
      if (read.image.depth < 2) return note(name, "a volume needs at least two slices");
      check_memory(execution_, static_cast<std::uint64_t>(read.image.shape().count()) * 64, name);
      Texture volume;
      volume.name = name;
      volume.shape = read.image.shape();
      volume.samples = samples_of_channel(read.image, 0);
      volume.type = read.image.type;
      volume.metadata = read.metadata;
      check_finite(volume);
      keep(std::move(volume));
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
      keep_fault(error);
      note(error.info().where, fmt::format("{}, so the volume {} is left out", error.info().what, name));
    }
  }

  /// Gives every set the levels of its masks.
  void find_masks() {
    for (RetargetSet& set : collection_.retarget_sets) {
      set.levels = find_levels(set, "source", set.mask_name);
      std::string next_name;
      const bool goes_elsewhere = set.metadata.facts.get<std::string>("to_hash").has_value();
      if (goes_elsewhere && set.levels) {
        set.to = find_levels(set, "to", next_name);
        if (!set.to) set.levels.reset();
      }
      if (set.levels) continue;
      note(set.name,
           fmt::format("{} not among the files, so residual, dither and energies are not recomputed",
                       goes_elsewhere ? "its masks are" : "its mask is"));
    }
  }

 private:
  static bool is_retarget(const FileContent& content) {
    const std::string kind = content.metadata ? content.metadata->kind : "";
    return kind == "retarget-tile" || kind == "retarget-atlas";
  }

  /// A file, or a stack of them.
  void add_content(const Candidate& candidate, const FileContent& content) {
    const std::string hash = pixel_hash(content.image);
    if (const auto known = known_.find(hash); known != known_.end()) {
      if (known->second) add_encoding(*known->second, candidate.name);
      return;
    }
    known_[hash] = std::nullopt;
    if (is_retarget(content)) {
      add_moves(candidate, content);
    } else {
      add_textures(candidate, content, hash);
    }
  }

  /// The levels of the mask that a set's metadata name as `which`, "source" or "to"; its name too.
  std::optional<Grid<std::int32_t>> find_levels(const RetargetSet& set, const std::string& which,
                                                std::string& name) const {
    const Facts& facts = set.metadata.facts;
    const std::string hash = facts.get<std::string>(which + "_hash").value_or("");
    const auto path = facts.get<std::string>(which);
    std::optional<Image> image;
    if (const auto in_set = images_.find(hash); in_set != images_.end()) {
      image = in_set->second.second;
      name = in_set->second.first;
    } else if (path) {
      const fs::path relative(*path);
      const bool below =
          relative.is_relative() && std::find(relative.begin(), relative.end(), "..") == relative.end();
      try {
        if (below) {
          Volume mask = read_volume(folder_of_.at(set.name) / relative, {}, execution_);
          if (pixel_hash(mask.image) == hash) image = std::move(mask.image);
          name = *path;
        }
      } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) throw;
      }
    }
    const int channel = facts.get<int>("source_channel").value_or(0);
    const Extent size = set.tiles.front().move.size();
    if (!image || channel >= image->channels || image->size != size || image->depth != set.slices) return {};
    return levels_of_channel(*image, channel).value;
  }

  void note(const std::string& name, std::string_view what) {
    collection_.notes.push_back(fmt::format("{}: {}", name, what));
  }

  void keep_fault(const Error& error) {
    if (!collection_.first_fault) collection_.first_fault = error.info();
  }

  void keep(Texture texture) {
    if (collection_.textures.size() + collection_.retarget_sets.size() >=
        static_cast<std::size_t>(kMaxReportTextures)) {
      throw Error({.code = ErrorCode::over_limit,
                   .what = "too many textures for one page",
                   .where = texture.name,
                   .limit = fmt::format("{} textures", kMaxReportTextures),
                   .remedy = "report on them in groups"});
    }
    collection_.textures.push_back(std::move(texture));
  }

  void add_encoding(std::size_t texture, const std::string& name) {
    collection_.textures[texture].also.push_back(name);
  }

  void add_textures(const Candidate& candidate, const FileContent& content, const std::string& hash) {
    images_.try_emplace(hash, candidate.name, content.image);
    if (candidate.job.kind == "mask" || candidate.job.kind == "spatiotemporal") {
      const auto [place, is_new] = mask_of_job_.try_emplace(candidate.job.job, collection_.textures.size());
      if (!is_new) return add_encoding(place->second, candidate.name);
    }
    check_memory(execution_, static_cast<std::uint64_t>(content.image.shape().count()) * 64, candidate.name);
    const bool grey = is_grey_as_colour(content.image);
    if (grey) note(candidate.name, "channels 0, 1 and 2 are equal, grey stored as colour, so one is shown");
    std::vector<Texture> channels;
    std::vector<int> numbers;
    for (int c = 0; c < std::min(content.image.channels, kMostChannels); ++c) {
      Texture texture;
      texture.name = candidate.name;
      texture.shape = content.image.shape();
      texture.samples = samples_of_channel(content.image, c);
      texture.type = content.image.type;
      texture.metadata = content.metadata;
      texture.seconds = candidate.job.seconds;
      check_finite(texture);
      const std::vector<double>& values = texture.samples.value;
      const bool constant =
          std::all_of(values.begin(), values.end(), [&](double value) { return value == values[0]; });
      if (c > 0 && constant) {
        const bool last = c + 1 == content.image.channels && (c == 1 || c == 3);
        note(candidate.name, fmt::format("channel {} is constant (every value is {}), so it is not shown{}",
                                         c, values[0], last ? "; an opaque alpha channel is" : ""));
        continue;
      }
      if (grey && (c == 1 || c == 2)) continue;
      if (content.image.channels > 1) texture.name += fmt::format(", channel {}", c);
      compare_channels(channels, numbers, texture);
      channels.push_back(std::move(texture));
      numbers.push_back(c);
    }
    if (content.image.channels > kMostChannels) {
      note(candidate.name,
           fmt::format("it has {} channels, the first {} are shown", content.image.channels, kMostChannels));
    }
    if (channels.size() == 1) channels[0].name = candidate.name;
    known_[hash] = collection_.textures.size();
    for (Texture& texture : channels) keep(std::move(texture));
  }

  /// What `texture` has in common with the channels before it.
  void compare_channels(const std::vector<Texture>& channels, const std::vector<int>& numbers,
                        Texture& texture) {
    double largest = 0.0, chance = 0.0;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const CrossSpectrum cross =
          cross_spectrum(channels[i].samples.value, texture.samples.value, texture.shape, execution_);
      if (!cross.can_tell()) return;
      const std::string relation = relation_of(cross, fmt::format("channel {}", numbers[i]));
      if (!relation.empty()) {
        texture.relations.push_back(relation);
        return;  // the first says enough
      }
      largest = std::max(largest, std::abs(cross.peak_correlation));
      chance = std::max(chance, cross.limit);
    }
    if (channels.empty()) return;
    texture.independence = fmt::format(
        "Independent of the channels before it: correlation at most {:.3f} at any displacement (chance: "
        "{:.3f}).",
        largest, chance);
  }

  void add_moves(const Candidate& candidate, const FileContent& content) {
    const Metadata& metadata = *content.metadata;
    const Facts& facts = metadata.facts;
    if (facts.get<int>("step_z")) {
      return note(candidate.name, "its seeds move between slices, which this page does not show");
    }
    const int slices = content.image.depth;
    const int motions = static_cast<int>(metadata.tiles.size()) / slices;
    const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(motions))));
    const int radius = facts.get<int>("radius").value_or(0);
    if (metadata.tiles.empty() || metadata.tiles.size() % static_cast<std::size_t>(slices) != 0 ||
        !facts.get<Offset>("step") || radius < 1 || radius > 32 || side * side != motions ||
        (metadata.kind == "retarget-tile" && motions != 1) || content.image.size.width % side != 0 ||
        content.image.size.height % side != 0) {
      return note(candidate.name, "its metadata do not fit its picture");
    }
    std::vector<RetargetSet::Tile> tiles;
    const Extent size{content.image.size.width / side, content.image.size.height / side};
    for (int i = 0; i < slices * motions; ++i) {
      const Image slice = slice_of(content.image, i / motions);
      Grid<Offset> move = decode_moves(side == 1 ? slice : atlas_tile(slice, size, i % motions));
      if (facts.get<std::string>("form") == "gather") move = invert_moves(move);
      tiles.push_back({metadata.tiles[static_cast<std::size_t>(i)], std::move(move), i / motions});
    }
    const auto text = [&](const char* name) { return facts.get<std::string>(name).value_or(""); };
    const Offset step = *facts.get<Offset>("step");
    const std::string key =
        fmt::format("{} {} {} {},{} {} {} {} {} {}x{}x{}", text("source_hash"), text("to_hash"),
                    facts.get<int>("source_channel").value_or(0), step.x, step.y, radius, text("reach"),
                    text("metric"), facts.get<bool>("wrap").value_or(true), size.width, size.height, slices);
    auto place = set_of_.find(key);
    if (place == set_of_.end()) {
      place = set_of_.emplace(key, collection_.retarget_sets.size()).first;
      RetargetSet set{.name = candidate.job.job.empty() ? candidate.name : candidate.job.job,
                      .files = {},
                      .metadata = metadata,
                      .tiles = {},
                      .slices = slices,
                      .levels = {},
                      .to = {},
                      .mask_name = {},
                      .seconds = candidate.job.seconds};
      folder_of_[set.name] = candidate.path.parent_path();
      collection_.retarget_sets.push_back(std::move(set));
    }
    RetargetSet& set = collection_.retarget_sets[place->second];
    set.files.push_back(candidate.name);
    for (auto& tile : tiles) {
      const auto same = [&](const RetargetSet::Tile& other) {
        return other.slice == tile.slice && other.record.motion == tile.record.motion;
      };
      if (std::none_of(set.tiles.begin(), set.tiles.end(), same)) set.tiles.push_back(std::move(tile));
    }
    std::sort(set.tiles.begin(), set.tiles.end(), [](const auto& a, const auto& b) {
      return std::tuple(a.slice, a.record.motion.y, a.record.motion.x) <
             std::tuple(b.slice, b.record.motion.y, b.record.motion.x);
    });
  }

  Collection& collection_;
  const Execution& execution_;
  std::map<std::string, std::optional<std::size_t>> known_;      // pixel hash to texture, if it is one
  std::map<std::string, std::pair<std::string, Image>> images_;  // pixel hash to name and samples
  std::map<std::string, std::size_t> mask_of_job_, set_of_;
  std::map<std::string, fs::path> folder_of_;
  Stacks stacks_;
};

}  // namespace

Collection collect(const ReportOptions& options, const Execution& execution) {
  Collection collection;
  Collector collector(collection, execution);
  std::vector<fs::path> slices;
  for (const fs::path& input : options.inputs) {
    std::error_code error;
    if (!fs::is_directory(input, error)) {
      if (options.volume) {
        slices.push_back(input);
      } else {
        collector.add({input, input.generic_string(), {}});
      }
    } else if (options.volume) {
      collector.add_volume(input.string(), std::span(&input, 1));
    } else {
      const auto found = candidates_in(input, options.inputs.size() > 1, execution, collection.notes);
      if (found.empty())
        collection.notes.push_back(fmt::format("{}: no textures in this folder", input.string()));
      for (const Candidate& candidate : found) collector.add(candidate);
    }
  }
  if (!slices.empty()) {
    const std::string first = slices[0].generic_string();
    collector.add_volume(slices.size() == 1 ? first : fmt::format("{} and {} more", first, slices.size() - 1),
                         slices);
  }
  collector.add_incomplete_stacks();
  collector.find_masks();
  return collection;
}

}  // namespace bn::report
