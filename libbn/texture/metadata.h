// The metadata inside a file's description.

#pragma once

#include <string_view>

#include "bn/texture.h"

namespace bn::texture {

/// Version of the JSON schema in docs/files.md; any change of it gets a new number.
inline constexpr int kMetadataVersion = 1;

/// More than this is not written. (libpng gives up on a text above 8 MB.)
inline constexpr std::size_t kMaxMetadataBytes = std::size_t{4} << 20;

/// Sets content.metadata if `description` is ours, content.metadata_fault if it is ours but broken,
/// and neither if it is someone else's.
void read_description(std::string_view description, FileContent& content);

}  // namespace bn::texture
