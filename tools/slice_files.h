// Which files a folder or a list of slices means, and in which order.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bn::tools {

/// The textures in and below `folder`, in natural order of their names. Hidden files (.name) are none.
/// Errors: io.
std::vector<std::filesystem::path> textures_below(const std::filesystem::path& folder);

struct SliceFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;  ///< that the order was changed, and which numbers are missing
};

/// `files` in the order of their numbers, so that slice_2 comes before slice_10, however the shell has listed
/// them.
SliceFiles in_slice_order(std::vector<std::filesystem::path> files);

}  // namespace bn::tools
