// Files that may be textures, in the order in which a report shows them.

#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bn/execution.h"

namespace bn::report {

/// What a manifest tells of a file.
struct JobNote {
  std::string job, kind;
  std::optional<double> seconds;
  int order = std::numeric_limits<int>::max();  ///< in the manifest; files that are in none come last
};

struct Candidate {
  std::filesystem::path path;
  std::string name;
  JobNote job;
};

/// The files in and below `folder` whose names end as textures' do, those of its manifest first. `prefixed`:
/// names begin with the folder, because there are others. What cannot be read is a note.
std::vector<Candidate> candidates_in(const std::filesystem::path& folder, bool prefixed,
                                     const Execution& execution, std::vector<std::string>& notes);

}  // namespace bn::report
