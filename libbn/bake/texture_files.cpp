#include "bake/texture_files.h"

#include <algorithm>
#include <span>

#include "bn/error.h"
#include "texture/numbered_path.h"

namespace bn::baking {
namespace {

namespace fs = std::filesystem;

/// The name that every path to one file has in common.
fs::path canonical_path(const fs::path& path) {
  std::error_code failed;
  const fs::path found = fs::weakly_canonical(path, failed);
  return failed ? fs::absolute(path).lexically_normal() : found;
}

}  // namespace

void check_texture_writable(const fs::path& path, int depth, SampleType type, int channels) {
  if (depth == 1) return check_writable(path, type, channels);
  check_volume_writable(path, {1, 1, depth}, type, channels);
}

void write_texture(const fs::path& path, const Picture& picture, const Metadata& metadata) {
  if (picture.image.depth == 1) return write_image(path, picture.image, metadata);
  write_volume(path, picture.image, metadata, {.slices = picture.slices});
}

bool would_replace(const fs::path& output, const fs::path& input) {
  std::vector<fs::path> read = {input};
  try {
    read = slice_files(std::span(&input, 1)).files;
  } catch (const Error&) {
    // What cannot be read is named where it is read.
  }
  const fs::path folder = canonical_path(output.parent_path().empty() ? fs::path(".") : output.parent_path());
  return std::any_of(read.begin(), read.end(), [&](const fs::path& file) {
    const fs::path found = canonical_path(file);
    return found == canonical_path(output) ||
           (found.parent_path() == folder && pattern_of_slice(found, output));
  });
}

std::optional<fs::path> pattern_of_slice(const fs::path& file, const fs::path& path_in_recipe) {
  const fs::path pattern = file.parent_path() / path_in_recipe.filename();
  try {
    const texture::NumberedName name = texture::parse_numbered_name(pattern);
    if (name.has_number && texture::number_in(name, file.filename().string())) return pattern;
  } catch (const Error&) {
    // Two numbers in a name: no pattern.
  }
  return std::nullopt;
}

}  // namespace bn::baking
