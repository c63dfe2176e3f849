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
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "bn/retarget.h"

namespace bn::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kMostChannels = 4;
constexpr std::uintmax_t kMaxManifestBytes = 16u << 20;

/// What a manifest tells of a file.
struct JobNote {
  std::string job, kind;
  std::optional<double> seconds;
  int order = std::numeric_limits<int>::max();  ///< in the manifest; files that are in none come last
};

struct Candidate {
  fs::path path;
  std::string name;
  JobNote job;
};

bool is_texture_name(const fs::path& path) {
  static const std::set<std::string> kExtensions{".png", ".exr", ".tif", ".tiff", ".bin", ".h",   ".bmp",
                                                 ".hdr", ".pfm", ".pgm", ".ppm",  ".tga", ".jpg", ".jpeg"};
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return kExtensions.contains(extension);
}

/// By relative path. A manifest that cannot be read is a note: the files stand without it.
std::map<std::string, JobNote> read_manifest(const fs::path& path, std::vector<std::string>& notes) {
  std::map<std::string, JobNote> result;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return result;
  try {
    if (fs::file_size(path) > kMaxManifestBytes) throw std::runtime_error("too large");
    std::ifstream file(path, std::ios::binary);
    const Json manifest = Json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    for (const Json& job : manifest.at("jobs")) {
      const std::string name = job.at("name").get<std::string>();
      JobNote note{name, job.at("kind").get<std::string>(), std::nullopt, 0};
      if (const Json times = manifest.value("times", Json::object()).value("jobs", Json::object());
          times.contains(name)) {
        note.seconds = times.at(name).get<double>();
      }
      for (const Json& entry : job.at("files")) {
        note.order = static_cast<int>(result.size());
        result[entry.at("path").get<std::string>()] = note;
      }
    }
  } catch (const std::exception& problem) {
    notes.push_back(fmt::format("{}: not a manifest that can be read, so times are missing ({})",
                                path.string(), problem.what()));
  }
  return result;
}

/// `prefixed`: names begin with the folder, because there are others.
std::vector<Candidate> candidates_in(const fs::path& folder, bool prefixed, const Execution& execution,
                                     std::vector<std::string>& notes) {
  std::vector<Candidate> found;
  const auto jobs = read_manifest(folder / "manifest.json", notes);
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
  while (!error && entry != end) {
    throw_if_stopped(execution);
    std::error_code ignored;
    if (entry->is_regular_file(ignored) && is_texture_name(entry->path())) {
      if (found.size() == static_cast<std::size_t>(kMaxReportFiles)) {
        throw Error({.code = ErrorCode::over_limit,
                     .what = "too many files for one report",
                     .where = folder.string(),
                     .limit = fmt::format("{} files", kMaxReportFiles),
                     .remedy = "name the files or folders that matter"});
      }
      const std::string name = entry->path().lexically_relative(folder).generic_string();
      const auto job = jobs.find(name);
      found.push_back({entry->path(), prefixed ? entry->path().generic_string() : name,
                       job == jobs.end() ? JobNote{} : job->second});
    }
    entry.increment(error);
  }
  if (error) notes.push_back(fmt::format("{}: {}", folder.string(), error.message()));
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.job.order != b.job.order ? a.job.order < b.job.order : natural_less(a.name, b.name);
  });
  return found;
}

template <class Sample>
void append_channel(const Image& image, int channel, std::vector<double>& values) {
  const auto pixels = static_cast<std::size_t>(image.size.area());
  for (std::size_t i = 0; i < pixels; ++i) {
    Sample sample;
    const std::size_t at = i * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(channel);
    std::memcpy(&sample, image.samples.data() + at * sizeof(Sample), sizeof(Sample));
    values.push_back(static_cast<double>(sample));
  }
}

void append_slice(const Image& image, int channel, Texture& texture) {
  texture.type = image.type;
  switch (image.type) {
    case SampleType::u8:
      texture.high = 256.0;
      return append_channel<std::uint8_t>(image, channel, texture.values);
    case SampleType::u16:
      texture.high = 65536.0;
      return append_channel<std::uint16_t>(image, channel, texture.values);
    case SampleType::f32:
      return append_channel<float>(image, channel, texture.values);
  }
}

/// Values that are no fractions of one are spread over those that occur.
void set_range(Texture& texture) {
  if (texture.type != SampleType::f32) return;
  const auto [low, high] = std::minmax_element(texture.values.begin(), texture.values.end());
  if (*low >= 0.0 && *high <= 1.0) return;
  texture.low = *low;
  texture.high = *high;
}

/// Throws invalid_input on NaN or infinity, as the analysis would, before anything else is done with them.
void check_finite(const Texture& texture) {
  for (const double value : texture.values) {
    if (!std::isfinite(value)) {
      throw Error({.code = ErrorCode::invalid_input,
                   .what = "it holds NaN or infinity",
                   .where = texture.name,
                   .limit = "",
                   .remedy = ""});
    }
  }
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
    Texture volume{.name = name, .shape = {}, .values = {}, .metadata = {}, .also = {}, .seconds = {}};
    try {
      for (const Candidate& slice : slices) {
        throw_if_stopped(execution_);
        const FileContent content = read_image(slice.path, execution_);
        ++collection_.readable;
        const Shape shape{content.image.size.width, content.image.size.height, volume.shape.depth};
        if (volume.values.empty()) {
          volume.shape = {shape.width, shape.height, 1};
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
        append_slice(content.image, 0, volume);
      }
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
      return note(name, error.info().what);
    }
    if (volume.shape.depth < 2) return note(name, "a volume needs at least two slices");
    try {
      check_finite(volume);
    } catch (const Error& error) {
      return note(name, error.info().what);
    }
    set_range(volume);
    keep(std::move(volume));
  }

  /// Gives every set the levels of its mask.
  void find_masks() {
    for (RetargetSet& set : collection_.retarget_sets) {
      const std::string hash = set.metadata.source_hash.value_or("");
      const auto in_set = images_.find(hash);
      std::optional<Image> image;
      if (in_set != images_.end()) {
        image = in_set->second.second;
        set.mask_name = in_set->second.first;
      } else if (set.metadata.source) {
        const fs::path relative(*set.metadata.source);
        const bool below =
            relative.is_relative() && std::find(relative.begin(), relative.end(), "..") == relative.end();
        try {
          if (below) {
            FileContent content = read_image(folder_of_.at(set.name) / relative, execution_);
            if (pixel_hash(content.image) == hash) image = std::move(content.image);
            set.mask_name = *set.metadata.source;
          }
        } catch (const Error& error) {
          if (error.code() == ErrorCode::cancelled) throw;
        }
      }
      const int channel = set.metadata.source_channel.value_or(0);
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
    std::vector<Texture> channels;
    for (int c = 0; c < std::min(content.image.channels, kMostChannels); ++c) {
      Texture texture{.name = candidate.name,
                      .shape = {content.image.size.width, content.image.size.height},
                      .values = {},
                      .metadata = content.metadata,
                      .also = {},
                      .seconds = candidate.job.seconds};
      append_slice(content.image, c, texture);
      check_finite(texture);
      set_range(texture);
      // Opaque alpha, or grey that is stored as colour.
      const bool constant = std::all_of(texture.values.begin(), texture.values.end(),
                                        [&](double value) { return value == texture.values[0]; });
      const bool repeated = std::any_of(channels.begin(), channels.end(),
                                        [&](const Texture& other) { return other.values == texture.values; });
      if (c > 0 && (constant || repeated)) continue;
      if (content.image.channels > 1) texture.name += fmt::format(", channel {}", c);
      channels.push_back(std::move(texture));
    }
    if (channels.size() == 1) channels[0].name = candidate.name;
    known_[hash] = collection_.textures.size();
    for (Texture& texture : channels) keep(std::move(texture));
  }

  void add_moves(const Candidate& candidate, const FileContent& content) {
    const Metadata& metadata = *content.metadata;
    std::vector<RetargetSet::Tile> tiles;
    const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(metadata.tiles.size()))));
    if (metadata.tiles.empty() || !metadata.step || !metadata.radius || *metadata.radius < 1 ||
        *metadata.radius > 32 ||
        (metadata.kind == "retarget-atlas" && side * side != static_cast<int>(metadata.tiles.size())) ||
        (metadata.kind == "retarget-tile" && metadata.tiles.size() != 1) ||
        content.image.size.width % side != 0 || content.image.size.height % side != 0) {
      return note(candidate.name, "its metadata do not fit its picture");
    }
    const Extent size{content.image.size.width / side, content.image.size.height / side};
    for (std::size_t i = 0; i < metadata.tiles.size(); ++i) {
      Grid<Offset> move =
          decode_moves(side == 1 ? content.image : atlas_tile(content.image, size, static_cast<int>(i)));
      if (metadata.form == "gather") move = invert_moves(move);
      tiles.push_back({metadata.tiles[i], std::move(move)});
    }
    const std::string key =
        fmt::format("{} {} {},{} {} {} {} {} {}x{}", metadata.source_hash.value_or(""),
                    metadata.source_channel.value_or(0), metadata.step->x, metadata.step->y, *metadata.radius,
                    metadata.reach.value_or(""), metadata.metric.value_or(""), metadata.wrap.value_or(true),
                    size.width, size.height);
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

bool natural_less(std::string_view a, std::string_view b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto number = [&](std::string_view text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t begin = at;
        while (at < text.size() && digit(text[at])) ++at;
        return text.substr(begin, at - begin);
      };
      const std::string_view left = number(a, i), right = number(b, j);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i, ++j;
    }
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // equal but for leading zeros
}

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
    collector.add_volume(fmt::format("{} and {} more", named[0].name, named.size() - 1), named);
  }
  collector.find_masks();
  return collection;
}

}  // namespace bn::report
