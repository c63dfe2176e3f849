// Whether the results of an earlier bake hold: its manifest lists the files, and each is there with the same
// pixels, and with metadata and a recipe that mean what this bake would write.

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bake/manifest.h"
#include "bake/output_files.h"

namespace bn::baking {

/// The manifest that stands in a folder; an empty one if there is none that can be read.
Manifest earlier_manifest(const std::filesystem::path& out_dir);

/// The job of this kind and name; null if the manifest has none.
const JobRecord* find_job(const Manifest& manifest, std::string_view kind, std::string_view name);

/// The earlier record of a job whose files are all up to date, as skipped; nothing otherwise. `expected(i)`
/// gives the metadata of file i without recipe, figures and hash.
std::optional<JobRecord> up_to_date(std::string_view kind, std::string_view name,
                                    const std::vector<OutputFile>& files, const Manifest& earlier,
                                    const Execution& execution,
                                    const std::function<Metadata(std::size_t)>& expected);

}  // namespace bn::baking
