// bn/options.h - floor 0: options, each declared once.
//
// An Option names a value that a user may set: its key, type, range, unit, default and one sentence. It is
// bound to the variable that holds the value. From the list of a kind's options follow the keys of recipes,
// the flags of the command, the names in JSON and metadata, the tables of the manual, completion and the
// window's controls; none of them names an option a second time.
//
//   struct Settings { double sigma_px = 1.9; std::uint64_t seed = 1; } settings;
//   Options options;
//   options.real("sigma", settings.sigma_px, 0.3, 16.0, "Standard deviation of the Gaussian.").in("pixels");
//   options.seed("seed", settings.seed, "Another seed gives another mask.");
//
// An Options list reads and writes the variables that it was declared with, so they must outlive it. Not
// thread safe.

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bn/grid.h"
#include "bn/value.h"

namespace bn {

enum class OptionType {
  boolean,   ///< true or false
  integer,   ///< one whole number
  real,      ///< one number
  text,      ///< any text
  choice,    ///< one word of a list
  measured,  ///< one word of a list with a number: "gauss:1.5"; a text
  size,      ///< width and height
  shape,     ///< width, height and depth; width and height alone mean depth 1
  offset,    ///< x and y
  integers,  ///< a list of whole numbers
};

/// A word that goes with a number: "gauss:1.5". Without it, "gauss", the number is `usual`.
struct MeasuredWord {
  std::string word;
  double least = 0.0, most = 0.0, usual = 0.0;
  bool whole = false;
};

/// One option. Everything but get, set and applies is plain description.
struct Option {
  std::string key;   ///< in recipes and JSON: "initial_density"; the flag is "--initial-density"
  std::string help;  ///< one sentence
  OptionType type = OptionType::integer;
  std::int64_t least = 0, most = 0;          ///< of whole numbers, each of them
  double least_real = 0.0, most_real = 0.0;  ///< of a real number
  bool above_least = false;                  ///< the real number `least_real` itself is not allowed
  bool percent = false;                      ///< a real number that may be written as "0.5%" too
  std::size_t most_elements = 0;             ///< of a list
  std::vector<std::string> words = {};       ///< of a choice; of a measured word those without a number
  std::vector<MeasuredWord> measured_words = {};
  std::string unit = {};                     ///< "pixels"
  std::string unset_word = {};               ///< the word that stands for "not set", as "auto" for a step
  std::string unset_help = {};               ///< what holds where the option is not set: "half a radius"
  std::string needs = {};                    ///< when the option applies: "method = \"anneal\""
  std::vector<std::string> former = {};      ///< older keys that go on working
  std::vector<std::string> not_beside = {};  ///< keys that may not be given together with this one
  /// The edition of the recipe language that brought the key. One younger than the first is written into
  /// files only where it differs from its default, so that the bytes of older files stay as they are.
  int since = 1;
  bool required = false;
  bool recipe_only = false;  ///< no flag of the command, which has other ways to say it
  /// Of a text: it names another entry of the recipe, of one of these kinds (their tables: "mask") ...
  std::vector<std::string> names_kinds = {};
  /// ... or a file that is read, relative to the recipe.
  bool names_file = false;

  std::function<Value()> get = {};
  std::function<void(const Value&)> set = {};  ///< of the option's type and within its range
  std::function<bool()> applies = [] { return true; };

  // For declarations, to be chained.
  Option& in(std::string of_unit) { return unit = std::move(of_unit), *this; }
  Option& from_edition(int edition) { return since = edition, *this; }
  Option& formerly(std::string key_before) { return former.push_back(std::move(key_before)), *this; }
  Option& without(std::string other) { return not_beside.push_back(std::move(other)), *this; }
  Option& must_be_given() { return required = true, *this; }
  Option& only_in_recipes() { return recipe_only = true, *this; }
  /// `is_so` is asked when a value was given or is to be written; `condition` says it in words.
  Option& only_if(std::function<bool()> is_so, std::string condition) {
    applies = std::move(is_so);
    needs = std::move(condition);
    return *this;
  }
  Option& naming_entry(std::vector<std::string> kinds) { return names_kinds = std::move(kinds), *this; }
  Option& naming_file() { return names_file = true, *this; }
  Option& if_unset(std::string meaning) { return unset_help = std::move(meaning), *this; }
};

/// "--initial-density".
std::string flag_of(const Option& option);
/// The range as messages and tables show it: "0.3..16", "[width, height], each 1..16384", "\"l1\", \"l2\"".
std::string allowed_text(const Option& option);
/// A value as a recipe writes it: 1.9, "l1", [64, 64]; `unset_word` quoted, or "" where there is none.
std::string recipe_value(const Option& option, const Value& value);
/// Why `value` is not one of the option's, as in "is 20"; empty if it is. Its type must be the option's.
std::string out_of_range(const Option& option, const Value& value);
/// The value that `text`, as typed on a command line, stands for: "64x64", "1.9", "0.5%", "48,36", "0,1,2",
/// "l1". Errors: usage (no value of this type), invalid_input (outside the range); `where` names the option.
Value value_from_text(const Option& option, std::string_view text, std::string_view where);
/// The inverse of value_from_text(); "" if not set and no word stands for it.
std::string text_from_value(const Option& option, const Value& value);
/// The word of `words` that a misspelt `text` was probably meant to be; empty if none is near.
std::string nearest_word(std::string_view text, const std::vector<std::string>& words);

/// A list of options under construction. Each call adds one and returns it for more to be said.
class Options {
 public:
  Option& boolean(std::string key, bool& value, std::string help);
  Option& text(std::string key, std::string& value, std::string help);
  /// Whole numbers; an empty std::optional is "not set".
  template <class Integer>
  Option& integer(std::string key, Integer& value, std::int64_t least, std::int64_t most, std::string help) {
    return whole(
        std::move(key), least, most, std::move(help), [&value] { return to_value(value); },
        [&value](const Value& given) { from_value<std::int64_t>(given, value); });
  }
  /// A 64-bit number that chooses another result of the same quality: 0..2^63-1, what TOML can write.
  Option& seed(std::string key, std::uint64_t& value, std::string help) {
    return integer(std::move(key), value, 0, std::numeric_limits<std::int64_t>::max(), std::move(help));
  }
  template <class Real>
  Option& real(std::string key, Real& value, double least, double most, std::string help) {
    return number(
        std::move(key), least, most, std::move(help), [&value] { return to_value(value); },
        [&value](const Value& given) { from_value<double>(given, value); });
  }
  /// A real number kept elsewhere than in one variable.
  Option& number(std::string key, double least, double most, std::string help, std::function<Value()> get,
                 std::function<void(const Value&)> set);
  /// One word a value of an enumeration.
  template <class Enum>
  Option& choice(std::string key, Enum& value, std::vector<std::pair<std::string, Enum>> words,
                 std::string help) {
    std::vector<std::string> list;
    for (const auto& [word, meaning] : words) list.push_back(word);
    return word(
        std::move(key), std::move(list), std::move(help),
        [&value, words]() -> Value {
          for (const auto& [word, meaning] : words) {
            if (meaning == value) return word;
          }
          return {};
        },
        [&value, words](const Value& given) {
          for (const auto& [word, meaning] : words) {
            if (word == std::get<std::string>(given)) value = meaning;
          }
        });
  }
  /// A choice kept elsewhere than in one variable.
  Option& word(std::string key, std::vector<std::string> words, std::string help, std::function<Value()> get,
               std::function<void(const Value&)> set);
  /// A word with a number: words[i] stands for list[i] and sets `number`; a word whose range is empty (least
  /// and most are 0) has none.
  template <class Enum>
  Option& measured(std::string key, Enum& value, double& number,
                   std::vector<std::pair<MeasuredWord, Enum>> words, std::string help) {
    std::vector<MeasuredWord> list;
    for (const auto& [word, meaning] : words) list.push_back(word);
    return measured_word(
        std::move(key), std::move(list), std::move(help),
        [&value, &number, words]() -> std::pair<std::string, double> {
          for (const auto& [word, meaning] : words) {
            if (meaning == value) return {word.word, number};
          }
          return {};
        },
        [&value, &number, words](std::string_view given, double of_it) {
          for (const auto& [word, meaning] : words) {
            if (word.word == given) value = meaning;
          }
          number = of_it;
        });
  }
  Option& size(std::string key, Extent& value, int least, int most, std::string help);
  Option& shape(std::string key, Shape& value, int least, int most, std::string help);
  /// `unset_word` is what a recipe and a flag say for an empty value.
  Option& offset(std::string key, std::optional<Offset>& value, int least, int most, std::string unset_word,
                 std::string help);
  Option& offset(std::string key, Offset& value, int least, int most, std::string help);
  Option& integers(std::string key, std::vector<int>& value, int least, int most, std::size_t most_elements,
                   std::string help);

  std::vector<Option>& list() { return list_; }
  const std::vector<Option>& list() const { return list_; }
  /// The option called `key` now or formerly; null if there is none.
  Option* find(std::string_view key);

 private:
  template <class T>
  static Value to_value(const T& value) {
    if constexpr (requires { value.has_value(); }) {
      return value ? to_value(*value) : Value();
    } else if constexpr (std::is_floating_point_v<T>) {
      return static_cast<double>(value);
    } else {
      return static_cast<std::int64_t>(value);
    }
  }
  template <class Held, class T>
  static void from_value(const Value& given, T& value) {
    if constexpr (requires { value.has_value(); }) {
      const Held* held = std::get_if<Held>(&given);
      value = held ? T(static_cast<typename T::value_type>(*held)) : T();
    } else {
      value = static_cast<T>(std::get<Held>(given));
    }
  }
  Option& measured_word(std::string key, std::vector<MeasuredWord> words, std::string help,
                        std::function<std::pair<std::string, double>()> get,
                        std::function<void(std::string_view word, double number)> set);
  Option& whole(std::string key, std::int64_t least, std::int64_t most, std::string help,
                std::function<Value()> get, std::function<void(const Value&)> set);
  Option& add(Option option);

  std::vector<Option> list_;
};

}  // namespace bn
