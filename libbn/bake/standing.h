// Whether the results of an earlier bake still are what the recipe asks for.

#pragma once

#include <optional>

#include "bake/job.h"
#include "bake/manifest.h"

namespace bn {

/// The manifest of an earlier bake into `out_dir`; an empty one if there is none that can be read.
Manifest earlier_manifest(const std::filesystem::path& out_dir);

/// The earlier record of a job if all its files stand: listed in the manifest, the pixels of each
/// have the listed hash, its metadata are what the job would write now. Reads every file, computes
/// nothing. A file that cannot be read does not stand.
std::optional<JobRecord> standing_mask(const MaskEntry& entry, const std::vector<JobFile>& files,
                                       const Manifest& earlier, const Execution& execution);
std::optional<JobRecord> standing_retarget(const RetargetEntry& entry, const Source& source,
                                           const std::vector<JobFile>& files, const Manifest& earlier,
                                           const Execution& execution);
/// For a contact sheet all other jobs must stand as well.
std::optional<JobRecord> standing_contact_sheet(const JobFile& file, const Manifest& earlier,
                                                const Execution& execution);

}  // namespace bn
