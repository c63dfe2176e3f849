// Does a file keep what it says? Nothing that is recorded is believed: pixels are hashed, the recipe is read,
// and the entry of the file's kind makes or proves it again.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bake/inputs.h"
#include "bake/manifest.h"
#include "bake/paths.h"
#include "bake/texture_files.h"
#include "bn/bake.h"
#include "bn/error.h"

namespace bn {

using namespace baking;

namespace {

namespace fs = std::filesystem;

/// The items of one file.
class FileVerifier : public Checks {
 public:
  FileVerifier(fs::path file, const Execution& execution, std::vector<VerifyItem>& items)
      : file_(std::move(file)), execution_(execution), items_(items) {}

  void verify() {
    Volume content;
    const bool readable = attempt("metadata", [&] {
      content = read_volume(file_, {}, execution_);
      return std::string();
    });
    if (!readable) return;
    if (!content.metadata) {
      const bool damaged = !content.metadata_fault.empty();
      if (damaged) {
        add("metadata", false, "broken: " + content.metadata_fault);
      } else {
        add("foreign", false, "no metadata of this toolkit");
      }
      return;
    }
    const Metadata& metadata = *content.metadata;
    add("metadata", true,
        fmt::format("{}, {} {}, tool {}", metadata.kind, metadata.algorithm, metadata.algorithm_version,
                    metadata.tool_version));
    const std::string hash = pixel_hash(content.image);
    add("hash", content.as_recorded,
        content.as_recorded ? hash
        : content.files.size() > 1
            ? fmt::format("{}", fmt::join(content.notes, "; "))
            : fmt::format("pixels have {}, recorded is {}", hash, metadata.pixel_hash));
    if (metadata.kind == "packed") {
      add("recipe", true, "the command that packed it; its sources are not read");
      return;
    }
    std::shared_ptr<const Entry> entry;
    const bool parses = attempt("recipe", [&] {
      const Recipe recipe = parse_recipe(metadata.recipe, "recipe", file_.parent_path());
      if (metadata.kind == "contact-sheet") return std::string("parses");
      entry = subject(recipe, metadata.kind);
      return std::string();
    });
    if (parses && entry) entry->verify(content.image, metadata, file_.parent_path(), *this, execution_);
  }

  bool attempt(std::string_view name, const std::function<std::string()>& check) override {
    try {
      const std::string detail = check();
      if (!detail.empty()) add(name, true, detail);
      return true;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
      add(name, false, error.what());
      return false;
    }
  }

 private:
  void add(std::string_view check, bool pass, std::string detail) {
    items_.push_back({.file = file_, .check = std::string(check), .pass = pass, .detail = std::move(detail)});
  }

  /// The entry whose one output the file is: the last one, as those it builds on come before it.
  static std::shared_ptr<const Entry> subject(const Recipe& recipe, const std::string& file_kind) {
    const std::shared_ptr<const Entry> entry = recipe.entries.back();
    const std::vector<std::string> made = entry->file_kinds();
    if (std::find(made.begin(), made.end(), file_kind) == made.end()) {
      fail_check(fmt::format("kind '{}' is not one that [[{}]] makes", file_kind, entry->kind().table));
    }
    if (entry->output_count() != 1 || recipe.entries.size() != 1 + input_entries(recipe, *entry).size())
      fail_check("names not just this file");
    return entry;
  }

  fs::path file_;
  const Execution& execution_;
  std::vector<VerifyItem>& items_;
};

bool is_ours_by_name(const fs::path& path) {
  if (path.filename().string().starts_with('.')) return false;
  static const std::vector<std::string> kExtensions = {".png",  ".exr", ".tif", ".tiff",
                                                       ".ktx2", ".dds", ".h",   ".bin"};
  return std::find(kExtensions.begin(), kExtensions.end(), lower_case_extension(path.string())) !=
         kExtensions.end();
}

void verify_manifest(const fs::path& path, std::vector<VerifyItem>& items, const Execution& execution) {
  Manifest manifest;
  try {
    manifest = read_manifest(path);
  } catch (const Error& error) {
    items.push_back({.file = path, .check = "manifest", .pass = false, .detail = error.what()});
    return;
  }
  if (!manifest.complete) {
    items.push_back({.file = path,
                     .check = "manifest",
                     .pass = false,
                     .detail = "the bake was stopped before its end; run it again to complete it"});
  }
  for (const JobRecord& job : manifest.jobs) {
    for (const FileRecord& file : job.files) {
      VerifyItem item{
          .file = path.parent_path() / file.path, .check = "manifest", .pass = false, .detail = ""};
      try {
        const Volume content = read_volume(item.file, {}, execution);
        const std::string hash = pixel_hash(content.image);
        const bool same_tiles = content.metadata && content.metadata->tiles == file.tiles;
        item.pass = hash == file.pixel_hash && same_tiles;
        item.detail = hash != file.pixel_hash
                          ? fmt::format("pixels have {}, listed is {}", hash, file.pixel_hash)
                      : same_tiles ? "as listed"
                                   : "energies or bounds differ from those listed";
      } catch (const Error& error) {
        if (error.code() == ErrorCode::over_limit) throw;
        item.detail = error.what();
      }
      items.push_back(std::move(item));
    }
  }
}

/// What is to be verified as one: the file, or the volume that it is a slice of.
fs::path whole_of(const fs::path& file, const Execution& execution) {
  try {
    const auto metadata = read_image(file, execution).metadata;
    if (!metadata) return file;
    const Recipe recipe = parse_recipe(metadata->recipe, "recipe", file.parent_path());
    const Entry& entry = *recipe.entries.back();
    if (entry.output_count() == 1) return pattern_of_slice(file, entry.path_of(0)).value_or(file);
  } catch (const Error& error) {
    // What is wrong with it is found again, and reported, when it is verified.
    if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::over_limit) throw;
  }
  return file;
}

}  // namespace

std::vector<VerifyItem> verify_path(const fs::path& path, const Execution& execution) {
  std::error_code failed;
  std::vector<VerifyItem> items;
  if (!fs::exists(path, failed)) {
    if (has_number(path)) {
      FileVerifier(path, execution, items).verify();
      return items;
    }
    throw Error(
        {.code = ErrorCode::io, .what = "does not exist", .where = path.string(), .limit = "", .remedy = ""});
  }
  if (!fs::is_directory(path)) {
    if (is_ours_by_name(path)) {
      FileVerifier(whole_of(path, execution), execution, items).verify();
    } else {
      items.push_back({.file = path,
                       .check = "foreign",
                       .pass = false,
                       .detail = "not one of the formats that this toolkit writes"});
    }
    return items;
  }
  std::vector<fs::path> files, manifests;
  for (auto entry = fs::recursive_directory_iterator(path, failed);
       !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
    if (!entry->is_regular_file(failed)) continue;
    if (entry->path().filename() == kManifestName) manifests.push_back(entry->path());
    if (is_ours_by_name(entry->path())) files.push_back(entry->path());
  }
  if (failed) {
    throw Error({.code = ErrorCode::io,
                 .what = "cannot be listed: " + failed.message(),
                 .where = path.string(),
                 .limit = "",
                 .remedy = ""});
  }
  std::sort(files.begin(), files.end());
  std::sort(manifests.begin(), manifests.end());
  if (files.empty() && manifests.empty()) {
    items.push_back({.file = path, .check = "foreign", .pass = false, .detail = "no texture in this folder"});
  }
  Execution each = execution;
  std::set<fs::path> done;  // volumes with a file a slice
  for (std::size_t i = 0; i < files.size(); ++i) {
    throw_if_stopped(execution);
    each.progress = {};
    const fs::path whole = whole_of(files[i], each);
    if (whole == files[i] || done.insert(whole).second) FileVerifier(whole, each, items).verify();
    if (execution.progress)
      execution.progress(static_cast<double>(i + 1) / static_cast<double>(files.size()));
  }
  for (const fs::path& manifest : manifests) verify_manifest(manifest, items, execution);
  return items;
}

}  // namespace bn
