// Volumes in files: put together slice by slice, cut out of an atlas, or as one file holds them.

#include "bn/volume.h"

#include <fmt/format.h>

#include <algorithm>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"
#include "texture/numbered_path.h"

namespace bn {
namespace {

namespace fs = std::filesystem;
using texture::fail_input;

/// A note that several files share is given once.
struct SharedNote {
  std::string first_file, text;
  std::size_t files = 1;
};

/// Takes over what a file says beside its samples.
void note_file(const fs::path& path, FileContent& content, bool first, Volume& volume,
               std::vector<SharedNote>& notes) {
  const auto add = [&](const std::string& text) {
    const auto known =
        std::find_if(notes.begin(), notes.end(), [&](const SharedNote& note) { return note.text == text; });
    if (known != notes.end()) {
      ++known->files;
    } else {
      notes.push_back({path.string(), text});
    }
  };
  if (content.metadata && content.metadata->pixel_hash != pixel_hash(content.image)) {
    volume.as_recorded = false;
    add("its samples are not those it was written with");
  }
  for (const std::string& note : content.notes) add(note);
  if (volume.metadata_fault.empty()) volume.metadata_fault = std::move(content.metadata_fault);
  if (first) {
    volume.metadata = std::move(content.metadata);
    volume.slices = content.slices;
    volume.channel_names = std::move(content.channel_names);
  }
}

Image cut_atlas(const fs::path& path, const Image& atlas, AtlasLayout layout) {
  const std::string where = path.string();
  if (atlas.depth > 1) fail_input(where, "an atlas of several slices", "one picture");
  const auto [width, height] = atlas.size;
  if (layout.columns < 1 || layout.rows < 0 || width % layout.columns != 0) {
    fail_input(where, fmt::format("{} columns in {} pixels", layout.columns, width),
               "a divisor of the width");
  }
  const int side = width / layout.columns;
  const int rows = layout.rows > 0 ? layout.rows : height / side;
  if (rows < 1 || height % rows != 0 || (layout.rows == 0 && height % side != 0)) {
    fail_input(where,
               layout.rows > 0 ? fmt::format("{} rows in {} pixels", layout.rows, height)
                               : fmt::format("square slices of {} pixels in a height of {}", side, height),
               "a divisor of the height", "give the columns and the rows");
  }
  texture::check_depth(std::int64_t{layout.columns} * rows, where);
  std::vector<Image> slices;
  for (int i = 0; i < layout.columns * rows; ++i)
    slices.push_back(atlas_tile(atlas, {side, height / rows}, i));
  return stack_slices(slices);
}

/// Puts the content of the next file behind the slices before it.
void append(const fs::path& path, Image slice, std::size_t count, const Execution& execution,
            Volume& volume) {
  if (slice.depth > 1) {
    fail_input(path.string(), fmt::format("{} slices, as one of {} files", slice.depth, count),
               "one slice a file", "give a file of several slices alone");
  }
  if (volume.image.samples.empty()) {
    check_memory(execution, slice.samples.size() * (count + 1), path.string());
    volume.image = std::move(slice);
    volume.image.samples.reserve(volume.image.samples.size() * count);
    return;
  }
  if (slice.size != volume.image.size || slice.channels != volume.image.channels ||
      slice.type != volume.image.type) {
    const Image first{.size = volume.image.size,  // for the message alone
                      .channels = volume.image.channels,
                      .type = volume.image.type,
                      .samples = {}};
    fail_input(path.string(), "a slice of " + texture::describe(slice),
               fmt::format("{}, as {}", texture::describe(first), volume.files.front().string()),
               "all slices must have one size, number of channels and type");
  }
  volume.image.samples.insert(volume.image.samples.end(), slice.samples.begin(), slice.samples.end());
  ++volume.image.depth;
}

/// Files that a reader of the pattern would take for slices beside those that are written.
void check_no_further_slices(const fs::path& pattern, int depth) {
  const texture::NumberedName name = texture::parse_numbered_name(pattern);
  const fs::path folder = pattern.parent_path().empty() ? fs::path(".") : pattern.parent_path();
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const auto number = texture::number_in(name, entry->path().filename().string());
    if (!number || *number < depth) continue;
    fail_input(entry->path().string(), fmt::format("it would be read as slice {} of {}", *number, depth),
               fmt::format("slices 0..{}", depth - 1), "remove it, or write into another folder");
  }
}

int atlas_rows(int depth, AtlasLayout layout, const std::string& where) {
  const int rows = layout.columns > 0 ? depth / layout.columns : 0;
  if (layout.columns < 1 || depth % layout.columns != 0 || (layout.rows != 0 && layout.rows != rows)) {
    fail_input(where, fmt::format("{} columns and {} rows for {} slices", layout.columns, layout.rows, depth),
               "columns that divide the number of slices");
  }
  return rows;
}

/// The folder of a file a slice, if it is not there but could be made: slices have one of their own.
fs::path folder_to_make(const fs::path& path) {
  const fs::path folder = path.parent_path();
  std::error_code ignored;
  if (folder.empty() || fs::exists(fs::symlink_status(folder, ignored))) return {};
  const fs::path above = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
  return fs::is_directory(above, ignored) ? folder : fs::path();
}

}  // namespace

Volume read_volume(std::span<const fs::path> inputs, AtlasLayout atlas, const Execution& execution) {
  SliceFiles found = slice_files(inputs);
  Volume volume;
  volume.files = std::move(found.files);
  volume.notes = std::move(found.notes);
  const std::size_t count = volume.files.size();
  if (atlas.columns != 0 && count > 1) {
    fail_input(inputs[0].string(), fmt::format("{} files, and columns for an atlas", count), "one file");
  }
  texture::check_depth(static_cast<std::int64_t>(count), inputs[0].string());
  std::vector<SharedNote> notes;
  for (std::size_t i = 0; i < count; ++i) {
    throw_if_stopped(execution);
    const fs::path& path = volume.files[i];
    FileContent content = texture::read_any(path, execution);
    note_file(path, content, i == 0, volume, notes);
    if (count > 1) {
      append(path, std::move(content.image), count, execution, volume);
    } else {
      if (atlas.columns != 0) check_memory(execution, 3 * content.image.samples.size(), path.string());
      volume.image = atlas.columns != 0 ? cut_atlas(path, content.image, atlas) : std::move(content.image);
    }
    if (execution.progress) execution.progress(static_cast<double>(i + 1) / static_cast<double>(count));
  }
  for (const auto& [file, text, files] : notes) {
    volume.notes.push_back(
        fmt::format("{}{}: {}", file, files > 1 ? fmt::format(" and {} more", files - 1) : "", text));
  }
  return volume;
}

Volume read_volume(const fs::path& input, AtlasLayout atlas, const Execution& execution) {
  return read_volume(std::span(&input, 1), atlas, execution);
}

void make_folder_of(const fs::path& path) {
  if (const fs::path folder = folder_to_make(path); !folder.empty()) make_folder(folder);
}

void check_volume_writable(const fs::path& path, Shape shape, SampleType type, int channels,
                           const VolumeOutput& output) {
  texture::check_shape(shape.width, shape.height, channels, path.string());
  texture::check_depth(shape.depth, path.string());
  if (has_number(path)) {
    if (output.atlas.columns != 0) {
      fail_input(path.string(), "a number in the name of an atlas, which is one file",
                 "a name without a number");
    }
    if (const fs::path folder = folder_to_make(path); !folder.empty()) {
      // As if for a slice beside the folder.
      const fs::path above = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
      return check_writable(above / numbered_path(path, 0).filename(), type, channels);
    }
    for (int z = 0; z < shape.depth; ++z) check_writable(numbered_path(path, z), type, channels);
    return check_no_further_slices(path, shape.depth);
  }
  if (output.atlas.columns != 0) {
    const int rows = atlas_rows(shape.depth, output.atlas, path.string());
    texture::check_shape(std::int64_t{shape.width} * output.atlas.columns, std::int64_t{shape.height} * rows,
                         channels, path.string());
    return check_writable(path, type, channels);
  }
  check_writable(path, type, channels, shape.depth);
}

std::vector<fs::path> write_volume(const fs::path& path, const Image& volume, const Metadata& metadata,
                                   const VolumeOutput& output) {
  texture::check_image(volume, path.string());
  check_volume_writable(path, volume.shape(), volume.type, volume.channels, output);
  if (has_number(path)) {
    std::vector<fs::path> files;
    make_folder_of(path);
    for (int z = 0; z < volume.depth; ++z) {
      files.push_back(numbered_path(path, z));
      write_image(files.back(), slice_of(volume, z), metadata);
    }
    return files;
  }
  if (output.atlas.columns != 0) {
    std::vector<Image> slices;
    for (int z = 0; z < volume.depth; ++z) slices.push_back(slice_of(volume, z));
    write_image(path, make_atlas(slices, output.atlas.columns), metadata);
  } else {
    write_image(path, volume, metadata, output.slices);
  }
  return {path};
}

}  // namespace bn
