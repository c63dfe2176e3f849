#include "bn/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "bn/error.h"

namespace bn {
namespace {

using List = std::vector<std::int64_t>;

/// The shortest decimal that reads back as the same double, as a TOML float.
std::string decimal(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string quoted(std::string_view text) {
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

bool has_number(const MeasuredWord& word) { return word.least != 0.0 || word.most != 0.0; }

/// The word and the number of "gauss:1.5"; nothing if it is none of them, or out of range.
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

std::string measured_text(const std::vector<MeasuredWord>& words) {
  std::string text;
  for (const MeasuredWord& word : words) {
    text += (text.empty() ? "" : ", ") + word.word;
    if (has_number(word))
      text += fmt::format(":{}..{}{}", word.least, word.most, word.whole ? " (whole)" : "");
  }
  return text;
}

/// Edits (insert, delete, replace, swap of neighbours) from a to b: Damerau 1964, restricted form.
int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_word(std::string_view text, const std::vector<std::string>& words) {
  if (text.size() > 40) return "";
  // The beginning of one word only is that word, and so is what goes on after a whole one: --output is --out.
  std::string nearest;
  constexpr std::size_t kFewestLetters = 3;
  int related = 0;
  for (const std::string& word : words) {
    const std::size_t shared = std::min(text.size(), word.size());
    const std::size_t letters = shared - std::min(shared, word.find_first_not_of('-'));
    if (letters < kFewestLetters || text.substr(0, shared) != word.substr(0, shared)) continue;
    ++related;
    nearest = word;
  }
  if (related == 1) return nearest;
  nearest.clear();
  // A third of the letters may be wrong; beyond that a suggestion is a guess.
  int least = std::max(1, static_cast<int>(text.size()) / 3) + 1;
  for (const std::string& word : words) {
    const int distance = edit_distance(text, word);
    if (distance >= least) continue;
    least = distance;
    nearest = word;
  }
  return nearest;
}

std::string flag_of(const Option& option) {
  std::string flag = "--" + option.key;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string allowed_text(const Option& option) {
  const std::string unset = option.unset_word.empty() ? "" : quoted(option.unset_word) + ", or ";
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
  if (const auto* text = std::get_if<std::string>(&value)) return quoted(*text);
  if (const auto* list = std::get_if<List>(&value)) return fmt::format("[{}]", fmt::join(*list, ", "));
  return option.unset_word.empty() ? "" : quoted(option.unset_word);
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

// --- declarations ----------------------------------------------------------------------------------

Option& Options::add(Option option) {
  list_.push_back(std::move(option));
  return list_.back();
}

Option* Options::find(std::string_view key) {
  for (Option& option : list_) {
    const bool formerly = std::find(option.former.begin(), option.former.end(), key) != option.former.end();
    if (option.key == key || formerly) return &option;
  }
  return nullptr;
}

Option& Options::boolean(std::string key, bool& value, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::boolean,
              .get = [&value]() -> Value { return value; },
              .set = [&value](const Value& given) { value = std::get<bool>(given); }});
}

Option& Options::text(std::string key, std::string& value, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::text,
              .get = [&value]() -> Value { return value.empty() ? Value() : Value(value); },
              .set = [&value](const Value& given) { value = std::get<std::string>(given); }});
}

Option& Options::measured_word(std::string key, std::vector<MeasuredWord> words, std::string help,
                               std::function<std::pair<std::string, double>()> get,
                               std::function<void(std::string_view word, double number)> set) {
  Option option{.key = std::move(key), .help = std::move(help), .type = OptionType::measured};
  option.get = [get = std::move(get), words]() -> Value {
    const auto [word, number] = get();
    for (const MeasuredWord& known : words) {
      if (known.word == word) return has_number(known) ? fmt::format("{}:{}", word, number) : word;
    }
    return {};
  };
  option.set = [set = std::move(set), words](const Value& given) {
    const auto parts = measured_parts(words, std::get<std::string>(given));
    if (parts) set(parts->first, parts->second);
  };
  option.measured_words = std::move(words);
  return add(std::move(option));
}

Option& Options::whole(std::string key, std::int64_t least, std::int64_t most, std::string help,
                       std::function<Value()> get, std::function<void(const Value&)> set) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::integer,
              .least = least,
              .most = most,
              .get = std::move(get),
              .set = std::move(set)});
}

Option& Options::number(std::string key, double least, double most, std::string help,
                        std::function<Value()> get, std::function<void(const Value&)> set) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::real,
              .least_real = least,
              .most_real = most,
              .get = std::move(get),
              .set = std::move(set)});
}

Option& Options::word(std::string key, std::vector<std::string> words, std::string help,
                      std::function<Value()> get, std::function<void(const Value&)> set) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::choice,
              .words = std::move(words),
              .get = std::move(get),
              .set = std::move(set)});
}

Option& Options::size(std::string key, Extent& value, int least, int most, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::size,
              .least = least,
              .most = most,
              .get = [&value]() -> Value {
                return List{value.width, value.height};
              },
              .set =
                  [&value](const Value& given) {
                    const List& list = std::get<List>(given);
                    value = {static_cast<int>(list[0]), static_cast<int>(list[1])};
                  }});
}

Option& Options::shape(std::string key, Shape& value, int least, int most, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::shape,
              .least = least,
              .most = most,
              .get = [&value]() -> Value {
                return value.depth == 1 ? List{value.width, value.height}
                                        : List{value.width, value.height, value.depth};
              },
              .set =
                  [&value](const Value& given) {
                    const List& list = std::get<List>(given);
                    value = {static_cast<int>(list[0]), static_cast<int>(list[1]),
                             list.size() > 2 ? static_cast<int>(list[2]) : 1};
                  }});
}

Option& Options::offset(std::string key, std::optional<Offset>& value, int least, int most,
                        std::string unset_word, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::offset,
              .least = least,
              .most = most,
              .unset_word = std::move(unset_word),
              .get = [&value]() -> Value {
                return value ? Value(List{value->x, value->y}) : Value();
              },
              .set =
                  [&value](const Value& given) {
                    const List* list = std::get_if<List>(&given);
                    value.reset();
                    if (list) value = {static_cast<int>((*list)[0]), static_cast<int>((*list)[1])};
                  }});
}

Option& Options::offset(std::string key, Offset& value, int least, int most, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::offset,
              .least = least,
              .most = most,
              .get = [&value]() -> Value {
                return List{value.x, value.y};
              },
              .set =
                  [&value](const Value& given) {
                    const List& list = std::get<List>(given);
                    value = {static_cast<int>(list[0]), static_cast<int>(list[1])};
                  }});
}

Option& Options::integers(std::string key, std::vector<int>& value, int least, int most,
                          std::size_t most_elements, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::integers,
              .least = least,
              .most = most,
              .most_elements = most_elements,
              .get = [&value]() -> Value {
                return value.empty() ? Value() : Value(List(value.begin(), value.end()));
              },
              .set =
                  [&value](const Value& given) {
                    const List* list = std::get_if<List>(&given);
                    value.clear();
                    if (list) value.assign(list->begin(), list->end());
                  }});
}

}  // namespace bn
