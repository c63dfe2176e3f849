#include "ui/texture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bn/bake.h"
#include "bn/error.h"
#include "bn/volume.h"
#include "ui/run_pictures.h"

namespace bn::ui {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSlices = 4096;

Error failure(ErrorCode code, const fs::path& where, std::string what, std::string limit,
              std::string remedy) {
  return Error({.code = code,
                .what = std::move(what),
                .where = where.string(),
                .limit = std::move(limit),
                .remedy = std::move(remedy)});
}

std::string shape_text(const Image& image) {
  return fmt::format("{} x {}, {} channels, {}", image.size.width, image.size.height, image.channels,
                     name_of(image.type));
}

/// Power in decibels as grey, DC in the middle.
std::shared_ptr<const Picture> spectrum_picture(PowerSpectrum power) {
  const Grid<std::uint8_t> grey = log_picture(power);
  Picture picture{.size = grey.size(), .channels = 1, .values = {}, .low = 0.0f, .high = 255.0f};
  picture.values.assign(grey.begin(), grey.end());
  picture.describe = [power = std::move(power)](int x, int y) {
    const auto [width, height, depth] = power.shape;
    const int kx = x - width / 2, ky = y - height / 2;
    return fmt::format("f = ({:.3f}, {:.3f}), power {:.3g}", kx / static_cast<double>(width),
                       ky / static_cast<double>(height), power.at(kx, ky));
  };
  return std::make_shared<const Picture>(std::move(picture));
}

std::optional<AnnealOptions> annealing_of(const Metadata& metadata) {
  if (metadata.algorithm != "retarget-anneal") return {};
  try {
    const Recipe recipe = parse_recipe(metadata.recipe, "recipe", {});
    const auto set = std::dynamic_pointer_cast<const RetargetEntry>(recipe.entries.back());
    if (set && set->anneals) return set->anneal.options;
  } catch (const Error&) {
    // What is wrong with it, the verdict says.
  }
  return {};
}

bool same_shape(const Image& a, const Image& b) {
  return a.size == b.size && a.channels == b.channels && a.type == b.type;
}

}  // namespace

TextureFile read_texture(const fs::path& path, const Execution& execution) {
  TextureFile texture{
      .path = path, .files = {path}, .images = {}, .metadata = {}, .metadata_fault = {}, .annealing = {}};
  std::error_code error;
  if (fs::is_directory(path, error)) {
    texture.files = image_files(path);
    if (texture.files.empty()) {
      throw failure(ErrorCode::invalid_input, path, "there is no image in this folder", "",
                    "open a folder whose images are the slices of one texture");
    }
    if (texture.files.size() > kMaxSlices) {
      throw failure(ErrorCode::over_limit, path, fmt::format("{} slices", texture.files.size()),
                    fmt::format("{}", kMaxSlices), "");
    }
  }
  std::uint64_t bytes = 0;
  Execution quiet = execution;  // a file's own progress would go back to 0 for each
  quiet.progress = {};
  for (const auto& file : texture.files) {
    throw_if_stopped(execution);
    Volume content = read_volume(file, {}, quiet);
    bytes += content.image.samples.size();
    if (bytes > kMaxTextureBytes) {
      throw failure(ErrorCode::over_limit, path, "too many samples for one view", "2 GiB", "");
    }
    if (texture.images.empty()) {
      texture.hash_fits = content.as_recorded;
      texture.metadata = std::move(content.metadata);
      texture.metadata_fault = std::move(content.metadata_fault);
      if (texture.metadata) texture.annealing = annealing_of(*texture.metadata);
    } else if (!same_shape(texture.images[0], content.image)) {
      throw failure(ErrorCode::invalid_input, file, "a slice of " + shape_text(content.image),
                    shape_text(texture.images[0]) + ", as the first", "open the file by itself");
    }
    if (content.image.depth > 1 && texture.files.size() > 1) {
      throw failure(ErrorCode::invalid_input, file, fmt::format("{} slices", content.image.depth),
                    "one slice a file", "open the file by itself");
    }
    for (int z = 0; z < content.image.depth; ++z) texture.images.push_back(slice_of(content.image, z));
    if (execution.progress) {
      execution.progress(std::min(
          1.0, static_cast<double>(texture.images.size()) / static_cast<double>(texture.files.size())));
    }
  }
  return texture;
}

AtlasCut guess_cut(const TextureFile& texture) {
  if (texture.images.size() != 1) return {};
  const auto [width, height] = texture.images[0].size;
  if (texture.metadata) {
    if (texture.metadata->kind != "retarget-atlas") return {};
    const int side =
        static_cast<int>(std::lround(std::sqrt(static_cast<double>(texture.metadata->tiles.size()))));
    const AtlasCut cut{std::max(side, 1), std::max(side, 1)};
    return fits(texture, cut) ? cut : AtlasCut{};
  }
  if (height > width && height % width == 0) return {1, height / width};
  if (width > height && width % height == 0) return {width / height, 1};
  return {};
}

bool fits(const TextureFile& texture, const AtlasCut& cut) {
  const Extent size = texture.images[0].size;
  const bool whole =
      cut.columns >= 1 && cut.rows >= 1 && size.width % cut.columns == 0 && size.height % cut.rows == 0;
  return whole && (texture.images.size() == 1 || cut.count() == 1);
}

int slice_count(const TextureFile& texture, const AtlasCut& cut) {
  return texture.images.size() > 1 ? static_cast<int>(texture.images.size()) : cut.count();
}

Extent slice_size(const TextureFile& texture, const AtlasCut& cut) {
  return {texture.images[0].size.width / cut.columns, texture.images[0].size.height / cut.rows};
}

Image slice(const TextureFile& texture, const AtlasCut& cut, int index) {
  if (cut.count() > 1) return atlas_tile(texture.images[0], slice_size(texture, cut), index);
  return texture.images[static_cast<std::size_t>(index)];
}

bool is_retarget(const TextureFile& texture) {
  return texture.metadata && texture.metadata->kind.starts_with("retarget-");
}

int motion_range(const TextureFile& texture) {
  if (!texture.metadata || texture.metadata->kind != "retarget-atlas") return 0;
  const AtlasCut cut = guess_cut(texture);
  const bool whole = cut.columns == cut.rows && cut.columns % 2 == 1 &&
                     cut.count() == static_cast<int>(texture.metadata->tiles.size());
  return whole ? cut.columns / 2 : 0;
}

bool holds_moves(const TextureFile& texture) {
  return is_retarget(texture) && texture.metadata->facts.get<int>("radius") &&
         texture.images[0].type == SampleType::u8 && texture.images[0].channels >= 2;
}

RetargetOptions move_options(const TextureFile& texture, int index) {
  const Metadata& m = *texture.metadata;
  RetargetOptions options{.radius = m.facts.get<int>("radius").value_or(1)};
  if (static_cast<std::size_t>(index) < m.tiles.size())
    options.motion = m.tiles[static_cast<std::size_t>(index)].motion;
  if (m.facts.get<std::string>("reach") == "euclidean") options.reach = Reach::euclidean;
  return options;
}

Picture picture_of(const TextureFile& texture, const Section& section) {
  if (section.moves && !section.xz && holds_moves(texture)) {
    return offset_picture(decode_moves(slice(texture, section.cut, section.index)),
                          move_options(texture, section.index));
  }
  const Extent size = slice_size(texture, section.cut);
  const int depth = slice_count(texture, section.cut);
  const int all = std::min(texture.images[0].channels, 4);
  // One channel is grey; of several all values are kept, and those that are chosen coloured.
  const bool one = std::has_single_bit(section.channels);
  const int first = one ? std::min(first_channel(section), all - 1) : 0;
  const int count = one ? 1 : all;
  Picture picture{.size = section.xz ? Extent{size.width, depth} : size, .channels = count, .values = {}};
  if (!one) picture.visible = section.channels;
  const SampleType type = texture.images[0].type;
  picture.hex_digits = type == SampleType::u8 ? 2 : type == SampleType::u16 ? 4 : 0;
  picture.values.resize(static_cast<std::size_t>(picture.size.area()) * static_cast<std::size_t>(count));
  for (int z = 0; z < (section.xz ? depth : 1); ++z) {
    const Image image = slice(texture, section.cut, section.xz ? z : section.index);
    for (int c = 0; c < count; ++c) {
      const ChannelSamples samples = samples_of_channel(image, first + c);
      // The greatest sample of integers is one below the range's end.
      const bool integers = image.type == SampleType::u8 || image.type == SampleType::u16;
      const float high = static_cast<float>(integers ? samples.high - 1.0 : samples.high);
      const bool begins = z == 0 && c == 0;
      picture.low =
          begins ? static_cast<float>(samples.low) : std::min(picture.low, static_cast<float>(samples.low));
      picture.high = begins ? high : std::max(picture.high, high);
      const std::size_t row = static_cast<std::size_t>(size.width);
      const std::size_t from = section.xz ? static_cast<std::size_t>(section.index) * row : 0;
      const std::size_t to = section.xz ? static_cast<std::size_t>(z) * row : 0;
      const std::size_t pixels = section.xz ? row : static_cast<std::size_t>(size.area());
      for (std::size_t i = 0; i < pixels; ++i) {
        picture.values[(to + i) * static_cast<std::size_t>(count) + static_cast<std::size_t>(c)] =
            static_cast<float>(samples.value[from + i]);
      }
    }
  }
  return picture;
}

TextureAnalysis analyse_texture(const TextureFile& texture, const AtlasCut& cut, int channel, int index,
                                const Execution& execution) {
  const int depth = index < 0 ? slice_count(texture, cut) : 1;
  const Extent size = slice_size(texture, cut);
  ChannelSamples stack;
  for (int z = 0; z < depth; ++z) {
    throw_if_stopped(execution);
    append_samples(stack,
                   samples_of_channel(slice(texture, cut, index < 0 ? z : index), std::max(channel, 0)));
  }
  const Shape shape{size.width, size.height, depth};
  Analysis analysis = analyse(stack.value, shape, stack.low, stack.high, execution);
  stack = {};  // a large one is no longer needed
  TextureAnalysis result{
      .plane_picture = {}, .in_time_picture = {}, .radial = {}, .time = {}, .figures = analysis.figures};
  throw_if_stopped(execution);
  if (depth > 1) {
    result.in_time_picture = spectrum_picture(project(analysis.power, Projection::xz));
    result.time = radial_power(project(analysis.power, Projection::z));
    analysis.power = project(analysis.power, Projection::xy);
  }
  result.radial = radial_power(analysis.power);
  result.plane_picture = spectrum_picture(std::move(analysis.power));
  return result;
}

}  // namespace bn::ui
