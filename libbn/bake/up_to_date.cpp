#include "bake/up_to_date.h"

#include "bn/error.h"
#include "bn/volume.h"

namespace bn::baking {
namespace {

/// Whether two recipes mean the same. Texts may differ: an older version wrote fewer keys.
bool same_entries(const std::string& a, const std::string& b) {
  if (a == b) return true;
  try {
    return recipe_text(parse_recipe(a, "a", "")) == recipe_text(parse_recipe(b, "b", ""));
  } catch (const Error&) {
    return false;
  }
}

bool is_up_to_date(const OutputFile& file, const FileRecord& recorded, Metadata expected,
                   const Execution& execution) {
  if (recorded.path != file.name) return false;
  try {
    const Volume content = read_volume(file.path, {}, execution);
    if (!content.metadata || !content.as_recorded) return false;
    // Another version of the tool, with the same version of the algorithm, makes the same picture.
    expected.tool_version = content.metadata->tool_version;
    expected.recipe = content.metadata->recipe;
    expected.pixel_hash = content.metadata->pixel_hash;  // of one slice, where each has a file
    expected.tiles = recorded.tiles;
    return *content.metadata == expected && same_entries(content.metadata->recipe, file.recipe) &&
           pixel_hash(content.image) == recorded.pixel_hash;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

Manifest earlier_manifest(const std::filesystem::path& out_dir) {
  try {
    return read_manifest(out_dir / kManifestName);
  } catch (const Error&) {
    return {};
  }
}

const JobRecord* find_job(const Manifest& manifest, std::string_view kind, std::string_view name) {
  for (const JobRecord& job : manifest.jobs) {
    if (job.kind == kind && job.name == name) return &job;
  }
  return nullptr;
}

std::optional<JobRecord> up_to_date(std::string_view kind, std::string_view name,
                                    const std::vector<OutputFile>& files, const Manifest& earlier,
                                    const Execution& execution,
                                    const std::function<Metadata(std::size_t)>& expected) {
  const JobRecord* job = find_job(earlier, kind, name);
  if (!job || job->files.size() != files.size()) return std::nullopt;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!is_up_to_date(files[i], job->files[i], expected(i), execution)) return std::nullopt;
  }
  JobRecord record = *job;
  record.skipped = true;
  return record;
}

}  // namespace bn::baking
