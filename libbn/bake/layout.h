// Which files a recipe asks for: their places and the recipe that each of them carries.

#pragma once

#include <filesystem>
#include <vector>

#include "bake/job.h"
#include "bn/bake.h"

namespace bn {

/// The files of an entry in a bake into `out_dir`. Each carries a recipe for itself alone, so that
/// editing one entry leaves the files of the others as they are.
std::vector<JobFile> mask_files(const MaskEntry& entry, const std::filesystem::path& out_dir);
std::vector<JobFile> retarget_files(const Recipe& recipe, const RetargetEntry& entry,
                                    const std::filesystem::path& out_dir);
JobFile contact_sheet_file(const Recipe& recipe, const std::filesystem::path& out_dir);

/// The same for a single command, where paths may lead anywhere: the recipe reads as one that lies
/// beside the file.
std::vector<JobFile> free_mask_files(const MaskEntry& entry);
std::vector<JobFile> free_retarget_files(const RetargetEntry& entry);

/// As the user wrote it, or written out for a recipe made by a program.
std::string whole_text(const Recipe& recipe);

/// The mask an entry refers to, or null.
const MaskEntry* mask_of(const Recipe& recipe, const RetargetEntry& entry);
/// Its output that holds the entry's levels.
const MaskOutput& source_output(const MaskEntry& mask, const RetargetEntry& entry);
/// The image file that an entry's tiles are made for.
std::filesystem::path source_path(const Recipe& recipe, const RetargetEntry& entry,
                                  const std::filesystem::path& out_dir);

/// Whether both name one existing file, by whatever path or link.
inline bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code failed;
  return std::filesystem::equivalent(a, b, failed) && !failed;
}

}  // namespace bn
