// Values of options as they are typed and as recipes have them, and the words in which they are refused.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "bn/error.h"
#include "bn/options.h"
#include "core/measured_word.h"

namespace bn {
namespace {

using List = std::vector<std::int64_t>;

/// The shortest decimal that reads back as the same double, as a TOML float.
std::string decimal(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string range_text(const Option& option) {
  // The largest signed number of 64 bits says "any".
  const bool open = option.most == std::numeric_limits<std::int64_t>::max();
  if (open && option.least == 0) return "0..2^63-1";
  if (open) return fmt::format("{} or above", option.least);
  if (option.most == std::int64_t{1} << 62) return fmt::format("{}..2^62", option.least);
  return fmt::format("{}..{}", option.least, option.most);
}

std::string real_range_text(const Option& option) {
  const std::string most = std::isinf(option.most_real) ? "" : fmt::format("{}", option.most_real);
  if (option.above_least) {
    return most.empty() ? fmt::format("above {}", option.least_real)
                        : fmt::format("above {}, at most {}", option.least_real, most);
  }
  return most.empty() ? fmt::format("{} or above", option.least_real)
                      : fmt::format("{}..{}", option.least_real, most);
}

bool has_right_length(const Option& option, std::size_t count) {
  switch (option.type) {
    case OptionType::size:
    case OptionType::offset:
      return count == 2;
    case OptionType::shape:
      return count == 2 || count == 3;
    default:
      return count >= 1 && count <= option.most_elements;
  }
}

/// The number that `text` is from its first to its last character; locale plays no part. A whole number too
/// large is the largest there is, so that the range check names it.
template <class T>
std::optional<T> whole_text_as(std::string_view text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || rest != end) return std::nullopt;
  if (error == std::errc::result_out_of_range && std::is_integral_v<T>) {
    return text.front() == '-' ? std::numeric_limits<T>::lowest() : std::numeric_limits<T>::max();
  }
  return error == std::errc{} ? std::optional<T>(value) : std::nullopt;
}

/// Proposals and sides are typed as 1e9 too.
std::optional<std::int64_t> whole_number(std::string_view text) {
  if (const auto value = whole_text_as<std::int64_t>(text)) return value;
  const auto real = whole_text_as<double>(text);
  if (!real || *real != std::floor(*real) || std::abs(*real) > 0x1p62) return std::nullopt;
  return static_cast<std::int64_t>(*real);
}

std::optional<List> list_of(std::string_view text, char separator) {
  List values;
  for (;;) {
    const std::size_t at = text.find(separator);
    const auto value = whole_number(text.substr(0, at));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (at == std::string_view::npos) return values;
    text.remove_prefix(at + 1);
  }
}

/// 0.005 for "0.5%"; nothing where the sign is missing, as 0.5 alone could be meant either way.
std::optional<double> share_of(std::string_view text) {
  const bool has_sign = text.ends_with('%');
  const auto value = whole_text_as<double>(has_sign ? text.substr(0, text.size() - 1) : text);
  if (!value || (!has_sign && *value != 0.0)) return std::nullopt;
  return *value / 100.0;
}

std::string_view sample_of(const Option& option) {
  switch (option.type) {
    case OptionType::size:
      return "write it like 256x256";
    case OptionType::shape:
      return "write it like 128x128x64";
    case OptionType::offset:
      return "write it like 48,36";
    case OptionType::integers:
      return "write it like 0,1,2";
    case OptionType::real:
      return option.percent ? "write it like 0.5%" : "";
    default:
      return "";
  }
}

std::optional<Value> parsed(const Option& option, std::string_view text) {
  const auto as_value = [](const auto& value) -> std::optional<Value> {
    if (!value) return std::nullopt;
    return Value(*value);
  };
  switch (option.type) {
    case OptionType::boolean:
      if (text == "true" || text == "false") return Value(text == "true");
      return std::nullopt;
    case OptionType::integer:
      return as_value(whole_number(text));
    case OptionType::real:
      return as_value(option.percent ? share_of(text) : whole_text_as<double>(text));
    case OptionType::text:
    case OptionType::choice:
    case OptionType::measured:
      return Value(std::string(text));
    case OptionType::size:
    case OptionType::shape: {
      const auto sides = list_of(text, 'x');
      if (sides && sides->size() == 1) return Value(List{sides->front(), sides->front()});
      return sides && has_right_length(option, sides->size()) ? as_value(sides) : std::nullopt;
    }
    case OptionType::offset: {
      const auto both = list_of(text, ',');
      return both && both->size() == 2 ? as_value(both) : std::nullopt;
    }
    case OptionType::integers:
      return as_value(list_of(text, ','));
  }
  return std::nullopt;
}

std::string measured_text(const std::vector<MeasuredWord>& words) {
  std::string text;
  for (const MeasuredWord& word : words) {
    text += (text.empty() ? "" : ", ") + word.word;
    if (has_number(word))
      text += fmt::format(":{}..{}{}", word.least, word.most, word.whole ? " (whole)" : "");
  }
  return text;
}

}  // namespace

std::optional<std::pair<std::string, double>> measured_parts(const std::vector<MeasuredWord>& words,
                                                             std::string_view text) {
  const std::size_t colon = text.find(':');
  for (const MeasuredWord& word : words) {
    if (text.substr(0, colon) != word.word) continue;
    if (colon == std::string_view::npos) return std::pair(word.word, word.usual);
    const auto number = whole_text_as<double>(text.substr(colon + 1));
    const bool fits = has_number(word) && number && *number >= word.least && *number <= word.most &&
                      (!word.whole || *number == std::floor(*number));
    if (!fits) return std::nullopt;
    return std::pair(word.word, *number);
  }
  return std::nullopt;
}

std::string flag_of(const Option& option) {
  std::string flag = "--" + option.key;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string allowed_text(const Option& option) {
  const std::string unset = option.unset_word.empty() ? "" : toml_string(option.unset_word) + ", or ";
  switch (option.type) {
    case OptionType::boolean:
      return "true or false";
    case OptionType::integer:
      return range_text(option);
    case OptionType::real:
      return real_range_text(option) + (option.percent ? ", or \"0%\"..\"100%\"" : "");
    case OptionType::text:
      return "a string";
    case OptionType::choice:
      return fmt::format("\"{}\"", fmt::join(option.words, "\", \""));
    case OptionType::measured:
      return measured_text(option.measured_words);
    case OptionType::size:
      return fmt::format("[width, height], each {}", range_text(option));
    case OptionType::shape:
      return fmt::format("[width, height] or [width, height, depth], each {}", range_text(option));
    case OptionType::offset:
      return fmt::format("{}[x, y], each {}", unset, range_text(option));
    case OptionType::integers:
      return fmt::format("[n, ...], 1..{} integers, each {}", option.most_elements, range_text(option));
  }
  return "";
}

std::string recipe_value(const Option& option, const Value& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&value)) return decimal(*real);
  if (const auto* text = std::get_if<std::string>(&value)) return toml_string(*text);
  if (const auto* list = std::get_if<List>(&value)) return fmt::format("[{}]", fmt::join(*list, ", "));
  return option.unset_word.empty() ? "" : toml_string(option.unset_word);
}

std::string out_of_range(const Option& option, const Value& value) {
  const auto outside = [&](std::int64_t whole) { return whole < option.least || whole > option.most; };
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    return outside(*whole) ? fmt::format("is {}", *whole) : "";
  }
  if (const auto* real = std::get_if<double>(&value)) {
    // Written so that NaN fails.
    const bool inside = (option.above_least ? *real > option.least_real : *real >= option.least_real) &&
                        *real <= option.most_real && std::isfinite(*real);
    return inside ? "" : fmt::format("is {}", *real);
  }
  if (const auto* list = std::get_if<List>(&value)) {
    if (!has_right_length(option, list->size())) return fmt::format("has {} elements", list->size());
    if (std::none_of(list->begin(), list->end(), outside)) return "";
    return fmt::format("is [{}]", fmt::join(*list, ", "));
  }
  const auto* word = std::get_if<std::string>(&value);
  if (option.type == OptionType::measured && word)
    return measured_parts(option.measured_words, *word) ? "" : fmt::format("is '{}'", word->substr(0, 60));
  if (option.type != OptionType::choice) return "";
  if (!word || std::find(option.words.begin(), option.words.end(), *word) != option.words.end()) return "";
  return fmt::format("is '{}'", word->substr(0, 60));
}

Value value_from_text(const Option& option, std::string_view text, std::string_view where) {
  const auto fail = [&](std::string what, std::string remedy) {
    throw Error({.code = ErrorCode::usage,
                 .what = std::move(what),
                 .where = std::string(where),
                 .limit = option.type == OptionType::choice ? fmt::format("{}", fmt::join(option.words, ", "))
                                                            : allowed_text(option),
                 .remedy = std::move(remedy)});
  };
  if (!option.unset_word.empty() && text == option.unset_word) return {};
  const auto value = parsed(option, text);
  if (!value) {
    // A share without its sign could be meant either way.
    if (option.percent && whole_text_as<double>(text))
      fail(fmt::format("'{}' has no % sign", text), fmt::format("write {}%", text));
    const bool empty = text.empty();
    fail(empty ? "is empty" : fmt::format("'{}' cannot be read", text), std::string(sample_of(option)));
  }
  if (option.type == OptionType::choice && !out_of_range(option, *value).empty()) {
    const std::string nearest = nearest_word(text, option.words);
    fail(fmt::format("'{}' is not a choice", text),
         nearest.empty() ? "" : fmt::format("did you mean {}?", nearest));
  }
  if (option.type == OptionType::measured && !out_of_range(option, *value).empty()) {
    std::vector<std::string> words;
    for (const MeasuredWord& word : option.measured_words) words.push_back(word.word);
    const std::string typed(text.substr(0, text.find(':')));
    const bool known = std::find(words.begin(), words.end(), typed) != words.end();
    const std::string nearest = known ? "" : nearest_word(typed, words);
    fail(fmt::format("'{}' {}", text, known ? "is out of range" : "is not a choice"),
         nearest.empty() ? "" : fmt::format("did you mean {}?", nearest));
  }
  if (!out_of_range(option, *value).empty()) fail(fmt::format("'{}' is out of range", text), "");
  return *value;
}

std::string text_from_value(const Option& option, const Value& value) {
  if (const auto* list = std::get_if<List>(&value)) {
    const bool sides = option.type == OptionType::size || option.type == OptionType::shape;
    return fmt::format("{}", fmt::join(*list, sides ? "x" : ","));
  }
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* real = std::get_if<double>(&value)) {
    return option.percent ? fmt::format("{}%", *real * 100.0) : fmt::format("{}", *real);
  }
  if (std::holds_alternative<std::monostate>(value)) return option.unset_word;
  return recipe_value(option, value);
}

}  // namespace bn
