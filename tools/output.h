// Results on stdout: every byte checked, or an error.

#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace bn::tools {

class Output {
 public:
  /// Writes all of `text` now. A reader that has closed its end (`bn info x | head -1`) has what it
  /// wanted: the rest is dropped and the run goes on to its own exit code. Throws io otherwise.
  void write(std::string_view text);
  /// As indented JSON, or as aligned lines "name value" with nested names joined by dots; one vocabulary.
  void write_result(const nlohmann::ordered_json& result, bool as_json);

 private:
  bool reader_is_gone_ = false;
};

}  // namespace bn::tools
