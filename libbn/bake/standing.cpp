#include "bake/standing.h"

#include "bake/contact_sheet.h"
#include "bn/error.h"

namespace bn {
namespace {

const JobRecord* find_job(const Manifest& manifest, JobKind kind, const std::string& name) {
  for (const JobRecord& job : manifest.jobs) {
    if (job.kind == kind && job.name == name) return &job;
  }
  return nullptr;
}

bool file_stands(const JobFile& file, const FileRecord& recorded, Metadata expected,
                 const Execution& execution) {
  if (recorded.path != file.name) return false;
  try {
    const FileContent content = read_image(file.path, execution);
    if (!content.metadata) return false;
    // Another version of the tool, with the same version of the algorithm, makes the same picture.
    expected.tool_version = content.metadata->tool_version;
    expected.pixel_hash = recorded.pixel_hash;
    expected.tiles = recorded.tiles;
    return *content.metadata == expected && pixel_hash(content.image) == recorded.pixel_hash;
  } catch (const Error&) {
    return false;
  }
}

/// `expected(i)` gives the metadata of file i.
template <class Expected>
std::optional<JobRecord> standing_job(JobKind kind, const std::string& name,
                                      const std::vector<JobFile>& files, const Manifest& earlier,
                                      const Execution& execution, Expected expected) {
  const JobRecord* job = find_job(earlier, kind, name);
  if (!job || job->files.size() != files.size()) return std::nullopt;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!file_stands(files[i], job->files[i], expected(i), execution)) return std::nullopt;
  }
  JobRecord standing = *job;
  standing.skipped = true;
  return standing;
}

}  // namespace

Manifest earlier_manifest(const std::filesystem::path& out_dir) {
  try {
    return read_manifest(out_dir / kManifestName);
  } catch (const Error&) {
    return {};
  }
}

std::optional<JobRecord> standing_mask(const MaskEntry& entry, const std::vector<JobFile>& files,
                                       const Manifest& earlier, const Execution& execution) {
  return standing_job(JobKind::mask, entry.name, files, earlier, execution,
                      [&](std::size_t i) { return mask_metadata(entry, files[i]); });
}

std::optional<JobRecord> standing_retarget(const RetargetEntry& entry, const Source& source,
                                           const std::vector<JobFile>& files, const Manifest& earlier,
                                           const Execution& execution) {
  return standing_job(JobKind::retarget, entry.name, files, earlier, execution, [&](std::size_t i) {
    return retarget_metadata(entry, entry.outputs[i], source, files[i]);
  });
}

std::optional<JobRecord> standing_contact_sheet(const JobFile& file, const Manifest& earlier,
                                                const Execution& execution) {
  return standing_job(JobKind::contact_sheet, kContactSheetJob, {file}, earlier, execution,
                      [&](std::size_t) { return contact_sheet_metadata(file); });
}

}  // namespace bn
