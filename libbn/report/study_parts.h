// The parts of a scene's section on the page of a study, as HTML.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/study_data.h"

namespace bn::report {

/// "Best in “edge”: reproject, −9.7 dB ...": what the figures say, in words.
std::string verdict_html(const std::vector<MethodRow>& rows, const std::string& region, std::size_t index);
/// The same for a table of scenes: "reproject, −9.7 dB in edge".
std::string short_verdict(const std::vector<MethodRow>& rows, const std::string& region, std::size_t index);

/// All methods by all figures, the best of each column marked, and a remark on rows that are the same.
std::string methods_table(const std::vector<MethodRow>& rows, const std::vector<std::string>& regions,
                          const StudyScene& scene);

/// What each pass of reprojected retarget costs.
std::string pass_table(const Study& study, const std::string& scene);

/// What the names of the study's methods mean.
std::string method_words(const Study& study);

/// The whole frame with white noise and with the method `shown`; errors and spectra of every method, each
/// beside its name; the first frames; block sizes. What a file lacks is left out, with a note.
std::string frames_html(const std::string& scene, const std::string& shown,
                        const std::filesystem::path& folder);
std::string sheets_html(const Study& study, const std::string& scene, const std::string& region,
                        const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace bn::report
