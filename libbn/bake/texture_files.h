// The files of one output: a picture, or a volume in one file or a file a slice.

#pragma once

#include <filesystem>
#include <optional>

#include "bn/kind.h"
#include "bn/volume.h"

namespace bn::baking {

/// Throws what write_texture() would throw, without writing.
void check_texture_writable(const std::filesystem::path& path, int depth, SampleType type, int channels);
/// A picture goes to its path as it is; the slices of a volume as write_volume() says.
void write_texture(const std::filesystem::path& path, const Picture& picture, const Metadata& metadata);

/// The pattern of the volume that a file is a slice of: the path that its recipe names, if that asks for a
/// number and the name of the file is such a name.
std::optional<std::filesystem::path> pattern_of_slice(const std::filesystem::path& file,
                                                      const std::filesystem::path& path_in_recipe);

}  // namespace bn::baking
