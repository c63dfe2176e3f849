// Typed access to a TOML table that turns every mistake into a message with position, allowed range
// and remedy, and goes on.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bn/options.h"
#include "core/diagnostics.h"
#include "core/toml_document.h"

namespace bn::document {

int line_of(const toml::node& node);

/// One table. Each getter names a key and returns its value, or `otherwise` if the key is absent or
/// wrong (then with a mistake noted). finish() notes every key that no getter asked for.
class TableReader {
 public:
  /// `what` names the table in messages: "mask 'a'".
  TableReader(const toml::table& table, std::string what, Diagnostics& diagnostics);

  void name_it(std::string what) { what_ = std::move(what); }
  /// For a table that stands in no file.
  void place_at(int line) { line_ = line; }
  int line() const { return line_; }
  /// Line of a key, or of the table if the key is absent.
  int line(std::string_view key) const;
  bool has(std::string_view key);

  std::string text(std::string_view key, std::string otherwise, std::string_view limit = "a string");
  std::int64_t integer(std::string_view key, std::int64_t otherwise, std::int64_t least, std::int64_t most);
  /// Reads an option, under its key or a former one, and sets it. Returns the key that was found; empty if
  /// the table has none of them. A wrong value is noted and leaves the option as it was.
  std::string read(const Option& option);
  const toml::array* array(std::string_view key, std::string_view limit);
  const toml::node* find(std::string_view key);

  /// Notes a mistake at `key`: "<what>: <key> <problem>".
  void mistake(std::string_view key, std::string_view problem, std::string limit, std::string remedy = "");
  void finish();

 private:
  const toml::table& table_;
  std::string what_;
  Diagnostics& diagnostics_;
  int line_;
  std::vector<std::string> known_;
};

}  // namespace bn::document
