#include "bake/texture_files.h"

#include "bn/error.h"
#include "texture/numbered_path.h"

namespace bn::baking {

namespace fs = std::filesystem;

void check_texture_writable(const fs::path& path, int depth, SampleType type, int channels) {
  if (depth == 1) return check_writable(path, type, channels);
  check_volume_writable(path, {1, 1, depth}, type, channels);
}

void write_texture(const fs::path& path, const Picture& picture, const Metadata& metadata) {
  if (picture.image.depth == 1) return write_image(path, picture.image, metadata);
  write_volume(path, picture.image, metadata, {.slices = picture.slices});
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
