// Finding textures.
//
// Files say what they are in their metadata; a file without any is a texture of as many channels as differ.
// Files with the same samples, and files that a manifest lists under one mask's job, are encodings of one
// texture: the first stands for all. Tiles and atlases of one mask and one set of options are one retarget
// set. Nothing that a file names is opened but its mask, which must lie beside or below it and have the
// recorded hash.

#include "report/sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bn/error.h"
#include "bn/judgement.h"
#include "bn/retarget.h"
#include "report/candidates.h"

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
      FileContent content = read_image(candidate.path, execution_);
      ++collection_.readable;
      if (!content.metadata_fault.empty()) {
        note(candidate.name, fmt::format("its metadata cannot be read ({}), so it is taken as a picture",
                                         content.metadata_fault));
      }
      const std::string kind = content.metadata ? content.metadata->kind : "";
      if (kind == "contact-sheet" || kind == "spectrum") return;
      const std::string hash = pixel_hash(content.image);
      if (content.metadata && content.metadata->pixel_hash != hash) {
        note(candidate.name, "its samples are not those it was written with (the recorded hash differs)");
      }
      const bool retarget = kind == "retarget-tile" || kind == "retarget-atlas";
      if (const auto known = known_.find(hash); known != known_.end()) {
        if (known->second) add_encoding(*known->second, candidate.name);
        return;
      }
      known_[hash] = std::nullopt;
      if (retarget) {
        add_moves(candidate, content);
      } else {
        add_textures(candidate, content, hash);
      }
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
      note(candidate.name, error.info().what);
    }
  }

  void add_volume(const std::string& name, const std::vector<Candidate>& slices) {
    Texture volume;
    volume.name = name;
    std::string at = name;
    try {
      for (const Candidate& slice : slices) {
        at = slice.name;
        throw_if_stopped(execution_);
        const FileContent content = read_image(slice.path, execution_);
        ++collection_.readable;
        const Shape shape{content.image.size.width, content.image.size.height, volume.shape.depth};
        if (volume.samples.value.empty()) {
          volume.shape = {shape.width, shape.height, 1};
          volume.type = content.image.type;
          volume.metadata = content.metadata;
          check_memory(execution_,
                       static_cast<std::uint64_t>(shape.width) * static_cast<std::uint64_t>(shape.height) *
                           slices.size() * 64,
                       name);
        } else if (shape != volume.shape || content.image.type != volume.type) {
          return note(
              slice.name,
              fmt::format("a slice of another size or depth than the first, so {} is left out", name));
        } else {
          ++volume.shape.depth;
        }
        append_samples(volume.samples, samples_of_channel(content.image, 0));
      }
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
      return note(at, fmt::format("{}, so the volume {} is left out", error.info().what, name));
    }
    if (volume.shape.depth < 2) return note(name, "a volume needs at least two slices");
    try {
      check_finite(volume);
    } catch (const Error& error) {
      return note(name, error.info().what);
    }
    keep(std::move(volume));
  }

  /// Gives every set the levels of its mask.
  void find_masks() {
    for (RetargetSet& set : collection_.retarget_sets) {
      const std::string hash = set.metadata.facts.get<std::string>("source_hash").value_or("");
      const auto in_set = images_.find(hash);
      std::optional<Image> image;
      if (in_set != images_.end()) {
        image = in_set->second.second;
        set.mask_name = in_set->second.first;
      } else if (set.metadata.facts.get<std::string>("source")) {
        const fs::path relative(*set.metadata.facts.get<std::string>("source"));
        const bool below =
            relative.is_relative() && std::find(relative.begin(), relative.end(), "..") == relative.end();
        try {
          if (below) {
            FileContent content = read_image(folder_of_.at(set.name) / relative, execution_);
            if (pixel_hash(content.image) == hash) image = std::move(content.image);
            set.mask_name = *set.metadata.facts.get<std::string>("source");
          }
        } catch (const Error& error) {
          if (error.code() == ErrorCode::cancelled) throw;
        }
      }
      const int channel = set.metadata.facts.get<int>("source_channel").value_or(0);
      if (image && channel < image->channels && image->size == set.tiles.front().move.size()) {
        set.levels = levels_of_channel(*image, channel).value;
      } else {
        note(set.name,
             "its mask is not among the files, so residual, dither and energies are not recomputed");
      }
    }
  }

 private:
  void note(const std::string& name, std::string_view what) {
    collection_.notes.push_back(fmt::format("{}: {}", name, what));
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
    if (candidate.job.kind == "mask") {
      const auto [place, is_new] = mask_of_job_.try_emplace(candidate.job.job, collection_.textures.size());
      if (!is_new) return add_encoding(place->second, candidate.name);
    }
    const bool grey = is_grey_as_colour(content.image);
    if (grey) note(candidate.name, "channels 0, 1 and 2 are equal, grey stored as colour, so one is shown");
    std::vector<Texture> channels;
    std::vector<int> numbers;
    for (int c = 0; c < std::min(content.image.channels, kMostChannels); ++c) {
      Texture texture;
      texture.name = candidate.name;
      texture.shape = content.image.size;
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
    std::vector<RetargetSet::Tile> tiles;
    const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(metadata.tiles.size()))));
    if (metadata.tiles.empty() || !metadata.facts.get<Offset>("step") || !metadata.facts.get<int>("radius") ||
        *metadata.facts.get<int>("radius") < 1 || *metadata.facts.get<int>("radius") > 32 ||
        (metadata.kind == "retarget-atlas" && side * side != static_cast<int>(metadata.tiles.size())) ||
        (metadata.kind == "retarget-tile" && metadata.tiles.size() != 1) ||
        content.image.size.width % side != 0 || content.image.size.height % side != 0) {
      return note(candidate.name, "its metadata do not fit its picture");
    }
    const Extent size{content.image.size.width / side, content.image.size.height / side};
    for (std::size_t i = 0; i < metadata.tiles.size(); ++i) {
      Grid<Offset> move =
          decode_moves(side == 1 ? content.image : atlas_tile(content.image, size, static_cast<int>(i)));
      if (metadata.facts.get<std::string>("form") == "gather") move = invert_moves(move);
      tiles.push_back({metadata.tiles[i], std::move(move)});
    }
    const std::string key = fmt::format(
        "{} {} {},{} {} {} {} {} {}x{}", metadata.facts.get<std::string>("source_hash").value_or(""),
        metadata.facts.get<int>("source_channel").value_or(0), metadata.facts.get<Offset>("step")->x,
        metadata.facts.get<Offset>("step")->y, *metadata.facts.get<int>("radius"),
        metadata.facts.get<std::string>("reach").value_or(""),
        metadata.facts.get<std::string>("metric").value_or(""),
        metadata.facts.get<bool>("wrap").value_or(true), size.width, size.height);
    auto place = set_of_.find(key);
    if (place == set_of_.end()) {
      place = set_of_.emplace(key, collection_.retarget_sets.size()).first;
      RetargetSet set{.name = candidate.job.job.empty() ? candidate.name : candidate.job.job,
                      .files = {},
                      .metadata = metadata,
                      .tiles = {},
                      .levels = {},
                      .mask_name = {},
                      .seconds = candidate.job.seconds};
      folder_of_[set.name] = candidate.path.parent_path();
      collection_.retarget_sets.push_back(std::move(set));
    }
    RetargetSet& set = collection_.retarget_sets[place->second];
    set.files.push_back(candidate.name);
    for (auto& tile : tiles) {
      const auto same = [&](const RetargetSet::Tile& other) {
        return other.record.motion == tile.record.motion;
      };
      if (std::none_of(set.tiles.begin(), set.tiles.end(), same)) set.tiles.push_back(std::move(tile));
    }
    std::sort(set.tiles.begin(), set.tiles.end(), [](const auto& a, const auto& b) {
      return std::tuple(a.record.motion.y, a.record.motion.x) <
             std::tuple(b.record.motion.y, b.record.motion.x);
    });
  }

  Collection& collection_;
  const Execution& execution_;
  std::map<std::string, std::optional<std::size_t>> known_;      // pixel hash to texture, if it is one
  std::map<std::string, std::pair<std::string, Image>> images_;  // pixel hash to name and samples
  std::map<std::string, std::size_t> mask_of_job_, set_of_;
  std::map<std::string, fs::path> folder_of_;
};

}  // namespace

Collection collect(const ReportOptions& options, const Execution& execution) {
  Collection collection;
  Collector collector(collection, execution);
  std::vector<Candidate> named;
  for (const fs::path& input : options.inputs) {
    std::error_code error;
    if (fs::is_directory(input, error)) {
      const auto found = candidates_in(input, options.inputs.size() > 1, execution, collection.notes);
      if (found.empty())
        collection.notes.push_back(fmt::format("{}: no textures in this folder", input.string()));
      if (options.volume) {
        if (!found.empty()) collector.add_volume(input.string(), found);
      } else {
        for (const Candidate& candidate : found) collector.add(candidate);
      }
    } else {
      named.push_back({input, input.generic_string(), {}});
      if (!options.volume) collector.add(named.back());
    }
  }
  if (options.volume && !named.empty()) {
    // As bn spectrum takes them.
    const auto given = named;
    std::sort(named.begin(), named.end(),
              [](const Candidate& a, const Candidate& b) { return natural_less(a.name, b.name); });
    if (!std::equal(given.begin(), given.end(), named.begin(),
                    [](const Candidate& a, const Candidate& b) { return a.name == b.name; })) {
      collection.notes.push_back(
          "The slices are taken in the order of their numbers, not in the order given.");
    }
    collector.add_volume(fmt::format("{} and {} more", named[0].name, named.size() - 1), named);
  }
  collector.find_masks();
  return collection;
}

}  // namespace bn::report
