// gnuplot, the one that draws.

#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>

namespace bn::report {

struct GnuplotResult {
  std::string output;   ///< its stdout
  std::string failure;  ///< empty if it ended well; else why not, beginning with "gnuplot"
};

/// Runs `script` in `folder` ("" for the current one), for a minute at most. Settings of the user's are not
/// read. Throws cancelled if `stop` was requested.
GnuplotResult run_gnuplot(std::string_view script, const std::filesystem::path& folder, std::stop_token stop);

}  // namespace bn::report
