// Typed access to a TOML table that turns every mistake into a message with position, allowed range
// and remedy, and goes on.

#pragma once

// toml++ with its assertions turned into exceptions: with NDEBUG it takes them for granted instead, and
// some texts break them (see toml_check.cpp). This is the only place that includes it.
#define TOML_HEADER_ONLY 1
#define TOML_ASSERT(expression) ::bn::require_sound_toml(static_cast<bool>(expression))
#pragma push_macro("NDEBUG")
#undef NDEBUG
namespace bn {
struct BrokenToml {};
constexpr void require_sound_toml(bool sound) {
  if (!sound) throw BrokenToml();
}
}  // namespace bn
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bake/mistakes.h"
#include "bn/grid.h"

namespace bn {

int line_of(const toml::node& node);

/// The one of `words` a misspelt `word` was probably meant to be; empty if none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

/// One table. Each getter names a key and returns its value, or `otherwise` if the key is absent or
/// wrong (then with a mistake noted). finish() notes every key that no getter asked for.
class TableReader {
 public:
  /// `what` names the table in messages: "mask 'a'".
  TableReader(const toml::table& table, std::string what, Mistakes& mistakes);

  void name_it(std::string what) { what_ = std::move(what); }
  /// For a table that stands in no file.
  void place_at(int line) { line_ = line; }
  int line() const { return line_; }
  /// Line of a key, or of the table if the key is absent.
  int line(std::string_view key) const;
  bool has(std::string_view key);

  std::string text(std::string_view key, std::string otherwise, std::string_view limit = "a string");
  std::int64_t integer(std::string_view key, std::int64_t otherwise, std::int64_t least, std::int64_t most);
  double number(std::string_view key, double otherwise, double least, double most);
  bool boolean(std::string_view key, bool otherwise);
  /// Index into `words`.
  int choice(std::string_view key, int otherwise, const std::vector<std::string>& words);
  /// Two integers, each least..most.
  std::optional<Offset> pair(std::string_view key, std::int64_t least, std::int64_t most,
                             std::string_view alternative = "");
  /// At most `most_of_them` integers, each least..most; empty if absent.
  std::vector<int> integers(std::string_view key, std::size_t most_of_them, int least, int most);
  const toml::array* array(std::string_view key, std::string_view limit);
  const toml::node* find(std::string_view key);

  /// Notes a mistake at `key`: "<what>: <key> <problem>".
  void mistake(std::string_view key, std::string_view problem, std::string limit, std::string remedy = "");
  void finish();

 private:
  const toml::table& table_;
  std::string what_;
  Mistakes& mistakes_;
  int line_;
  std::vector<std::string> known_;
};

}  // namespace bn
