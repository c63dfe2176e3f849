// Results on stdout: every byte checked, or an error.

#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace bn::tools {

class Output {
 public:
  /// With `quiet` nothing is told to people.
  explicit Output(bool quiet = false);

  /// Writes all of `text` now. A reader that has closed its end (`bn info x | head -1`) has what it
  /// wanted: the rest is dropped and the run goes on to its own exit code. Throws io otherwise.
  void write(std::string_view text);
  /// What a person reads and no program needs: nothing with --quiet; on a terminal the verdicts pass, weak
  /// and FAIL are coloured, unless the environment has NO_COLOR.
  void tell(std::string_view text);
  /// As indented JSON with lists of plain values on one line; or told, see lines_of().
  void write_result(const nlohmann::ordered_json& result, bool as_json);

 private:
  bool quiet_;
  bool coloured_;
  bool reader_is_gone_ = false;
};

/// What text for people is as wide as, but for names of files that are longer.
inline constexpr std::size_t kTextColumns = 80;
/// `text` in lines of at most kTextColumns, each behind `indent` spaces. Words are left whole.
std::string paragraph(std::string_view text, std::size_t indent);

/// Aligned lines "name value", nested names joined by dots: the vocabulary of the JSON.
std::string lines_of(const nlohmann::ordered_json& result);
/// The verdict words of `text` as a terminal shows them in colour.
std::string with_coloured_verdicts(std::string_view text);

}  // namespace bn::tools
