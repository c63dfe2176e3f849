// Which files a recipe asks for: their places and the recipe that each of them carries.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bn/bake.h"

namespace bn::baking {

/// A file to be made.
struct OutputFile {
  std::filesystem::path path;  ///< where it is written
  std::string name;            ///< what the record calls it
  std::string recipe;          ///< the text stored in it
};

/// The files of an entry in a bake into `out_dir`. Each carries a recipe for itself alone and for what it is
/// made from, so that editing one entry leaves the files of the others as they are.
std::vector<OutputFile> output_files(const Recipe& recipe, const Entry& entry,
                                     const std::filesystem::path& out_dir);

/// The same for a single command, where paths may lead anywhere: the recipe reads as one that lies beside the
/// file.
std::vector<OutputFile> free_output_files(const Entry& entry);

OutputFile contact_sheet_file(const Recipe& recipe, const std::filesystem::path& out_dir);

/// As the user wrote it, or written out for a recipe made by a program.
std::string whole_text(const Recipe& recipe);

}  // namespace bn::baking
