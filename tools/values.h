// The kinds of value an option takes: how its text is read, what it may be, how it is shown.
//
// Every parser reads the whole text or fails; a message names the option, the text and the allowed range.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bn/grid.h"

namespace bn::tools {

/// What the shell should offer while the value is being typed.
enum class Completion { none, choice, file, folder };

template <class T>
struct ValueKind {
  std::string placeholder;  ///< as in the usage line: "WIDTHxHEIGHT"
  std::string allowed;      ///< as in messages and help: "each 1..16384"
  /// Throws usage, naming `where`, unless all of `text` is an allowed value.
  std::function<T(std::string_view text, std::string_view where)> parse;
  std::function<std::string(const T&)> show;  ///< parse(show(x)) == x; empty: nothing to show
  Completion completion = Completion::none;
  std::vector<std::string> choices = {};
};

ValueKind<int> integer_in(int low, int high);
/// 0..2^63-1: what recipes, in TOML, can write.
ValueKind<std::uint64_t> seed_value();
/// "0,1,2": at most `most_of_them` whole numbers, each low..high.
ValueKind<std::vector<int>> integer_list(int low, int high, std::size_t most_of_them);
/// Decimal points, never commas, whatever the locale.
ValueKind<double> real_in(double low, double high, std::string unit = "");
/// "0.5%" is 0.005. The sign is required: 0.5 alone could be meant either way.
ValueKind<double> percentage_in(double low_percent, double high_percent);
/// "256x128", each side in low..high.
ValueKind<Extent> extent_in(int low, int high);
/// "48,36", or "auto" for an empty optional.
ValueKind<std::optional<Offset>> offset_or_auto();
/// "48,36".
ValueKind<std::optional<Offset>> offset();
/// "8G": bytes with one of the binary units K, M, G, T.
ValueKind<std::uint64_t> memory_size();
/// Any text; `suggestions` are for the shell.
ValueKind<std::string> any_text(std::string placeholder, std::vector<std::string> suggestions = {});
/// Throws usage: no name, or "-" for a standard stream.
void check_path_word(std::string_view text, std::string_view where);
ValueKind<std::filesystem::path> file_path();
/// Text to be written: refuses names of textures, which a slip of the keys would replace.
ValueKind<std::filesystem::path> text_path();
/// A texture to be written: its extension must name a format.
ValueKind<std::filesystem::path> texture_path();
ValueKind<std::filesystem::path> folder_path();

/// Throws usage: `text` is none of `words`; names the nearest if one is near.
[[noreturn]] void fail_choice(std::string_view text, std::string_view where,
                              const std::vector<std::string>& words);

/// "all" for an empty list, or some of `words` apart by commas.
ValueKind<std::vector<std::string>> word_list(std::vector<std::string> words);
/// "1e6,1e7": whole numbers low..high, each once, in rising order.
ValueKind<std::vector<std::int64_t>> count_list(std::int64_t low, std::int64_t high);

/// One word of a list.
template <class T>
ValueKind<T> choice_of(std::vector<std::pair<std::string, T>> table) {
  ValueKind<T> kind;
  for (const auto& [word, value] : table) {
    if (!kind.placeholder.empty()) kind.placeholder += "|";
    kind.placeholder += word;
    kind.choices.push_back(word);
  }
  kind.completion = Completion::choice;
  kind.parse = [table, words = kind.choices](std::string_view text, std::string_view where) {
    for (const auto& [word, value] : table) {
      if (word == text) return value;
    }
    fail_choice(text, where, words);
  };
  kind.show = [table](const T& wanted) {
    for (const auto& [word, value] : table) {
      if (value == wanted) return word;
    }
    return std::string();
  };
  return kind;
}

}  // namespace bn::tools
