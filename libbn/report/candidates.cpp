// Finding files: folders are searched to their ground, links to folders are not followed, and a
// manifest.json, where there is one, gives the order and tells whose job made what.

#include "report/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "bn/error.h"
#include "bn/report.h"
#include "bn/texture.h"
#include "bn/volume.h"

namespace bn::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uintmax_t kMaxManifestBytes = 16u << 20;

/// By relative path. A manifest that cannot be read is a note: the files stand without it.
std::map<std::string, JobNote> read_manifest(const fs::path& path, std::vector<std::string>& notes) {
  std::map<std::string, JobNote> result;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return result;
  try {
    if (fs::file_size(path) > kMaxManifestBytes) throw std::runtime_error("too large");
    std::ifstream file(path, std::ios::binary);
    const Json manifest = Json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    for (const Json& job : manifest.at("jobs")) {
      const std::string name = job.at("name").get<std::string>();
      JobNote note{name, job.at("kind").get<std::string>(), std::nullopt, 0};
      if (const Json times = manifest.value("times", Json::object()).value("jobs", Json::object());
          times.contains(name)) {
        note.seconds = times.at(name).get<double>();
      }
      for (const Json& entry : job.at("files")) {
        note.order = static_cast<int>(result.size());
        result[entry.at("path").get<std::string>()] = note;
      }
    }
  } catch (const std::exception& problem) {
    notes.push_back(fmt::format("{}: not a manifest that can be read, so times are missing ({})",
                                path.string(), problem.what()));
  }
  return result;
}

bool is_pattern(const std::string& path) {
  try {
    return has_number(path);
  } catch (const Error&) {
    return false;
  }
}

/// What the manifest tells of files: by their path, or by the path of their slices, slice_%03d.png.
class JobNotes {
 public:
  explicit JobNotes(std::map<std::string, JobNote> by_path) : by_path_(std::move(by_path)) {
    for (const auto& [path, note] : by_path_) {
      // No page holds more textures than that.
      if (is_pattern(path) && std::ssize(patterns_) < kMaxReportTextures) patterns_.push_back(path);
    }
  }

  JobNote of(const std::string& name) const {
    if (const auto exact = by_path_.find(name); exact != by_path_.end()) return exact->second;
    for (const std::string& pattern : patterns_) {
      if (is_slice(pattern, name)) return by_path_.at(pattern);
    }
    return {};
  }

 private:
  /// Whether one of the numbers in `name` makes it of the pattern.
  static bool is_slice(const std::string& pattern, const std::string& name) {
    constexpr std::string_view kDigits = "0123456789";
    for (auto at = name.find_first_of(kDigits); at != std::string::npos;
         at = name.find_first_of(kDigits, at)) {
      const auto end = std::min(name.find_first_not_of(kDigits, at), name.size());
      if (end - at <= 9 &&
          numbered_path(pattern, std::stoi(name.substr(at, end - at))).generic_string() == name)
        return true;
      at = end;
    }
    return false;
  }

  std::map<std::string, JobNote> by_path_;
  std::vector<std::string> patterns_;
};

}  // namespace

std::vector<Candidate> candidates_in(const fs::path& folder, bool prefixed, const Execution& execution,
                                     std::vector<std::string>& notes) {
  std::vector<Candidate> found;
  const JobNotes jobs(read_manifest(folder / "manifest.json", notes));
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
  while (!error && entry != end) {
    throw_if_stopped(execution);
    std::error_code ignored;
    if (entry->path().filename().string().starts_with('.')) {
      // Hidden: what systems and editors leave beside files (._slice.png, .slice.png.swp).
      if (entry->is_directory(ignored)) entry.disable_recursion_pending();
    } else if (entry->is_regular_file(ignored) && has_image_name(entry->path())) {
      if (found.size() == static_cast<std::size_t>(kMaxReportFiles)) {
        throw Error({.code = ErrorCode::over_limit,
                     .what = "too many files for one report",
                     .where = folder.string(),
                     .limit = fmt::format("{} files", kMaxReportFiles),
                     .remedy = "name the files or folders that matter"});
      }
      const std::string name = entry->path().lexically_relative(folder).generic_string();
      found.push_back({entry->path(), prefixed ? entry->path().generic_string() : name, jobs.of(name)});
    }
    entry.increment(error);
  }
  if (error) notes.push_back(fmt::format("{}: {}", folder.string(), error.message()));
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.job.order != b.job.order ? a.job.order < b.job.order : natural_less(a.name, b.name);
  });
  return found;
}

}  // namespace bn::report
