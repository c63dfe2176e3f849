// The contact sheet: one picture that shows every retarget set of a bake, with its figures.

#pragma once

#include <vector>

#include "bn/bake.h"

namespace bn::baking {

/// Raised whenever the same textures would give another picture.
inline constexpr int kContactSheetVersion = 2;
inline constexpr const char* kContactSheetKind = "contact-sheet";  ///< of the job and of the file
inline constexpr const char* kContactSheetJob = "contact_sheet";   ///< the job's name

Metadata contact_sheet_metadata();

/// Draws what stands in the output folder: it reads the files of `jobs` back from the disk, so the
/// same files give the same sheet, whether they were made just now or by an earlier bake.
Image draw_contact_sheet(const Recipe& recipe, const std::filesystem::path& out_dir,
                         const std::vector<JobRecord>& jobs, const Execution& execution);

}  // namespace bn::baking
