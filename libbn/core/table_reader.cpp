#include "core/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace bn::document {
namespace {

/// Texts of strangers go into messages: shortened, and without control characters.
std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string clean = "'";
  for (const char c : text.substr(0, kLongest))
    clean += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return clean + (text.size() > kLongest ? "...'" : "'");
}

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a float";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

std::string range_text(std::int64_t least, std::int64_t most) { return fmt::format("{}..{}", least, most); }

}  // namespace

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

TableReader::TableReader(const toml::table& table, std::string what, Diagnostics& diagnostics)
    : table_(table), what_(std::move(what)), diagnostics_(diagnostics), line_(line_of(table)) {}

int TableReader::line(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return node && line_of(*node) > 0 ? line_of(*node) : line_;
}

const toml::node* TableReader::find(std::string_view key) {
  known_.emplace_back(key);
  return table_.get(key);
}

bool TableReader::has(std::string_view key) { return find(key) != nullptr; }

void TableReader::mistake(std::string_view key, std::string_view problem, std::string limit,
                          std::string remedy) {
  diagnostics_.add(line(key), fmt::format("{}: {} {}", what_, key, problem), std::move(limit),
                   std::move(remedy));
}

std::string TableReader::text(std::string_view key, std::string otherwise, std::string_view limit) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  if (const auto* value = node->as_string()) return value->get();
  mistake(key, fmt::format("is {}", type_name(*node)), std::string(limit));
  return otherwise;
}

std::int64_t TableReader::integer(std::string_view key, std::int64_t otherwise, std::int64_t least,
                                  std::int64_t most) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  const auto* value = node->as_integer();
  if (!value) {
    mistake(key, fmt::format("is {}", type_name(*node)), "an integer " + range_text(least, most));
  } else if (value->get() < least || value->get() > most) {
    mistake(key, fmt::format("is {}", value->get()), range_text(least, most));
  } else {
    return value->get();
  }
  return otherwise;
}

namespace {

using List = std::vector<std::int64_t>;

std::optional<List> whole_numbers(const toml::node& node) {
  const toml::array* array = node.as_array();
  // Longer than any option's list: not worth copying.
  if (!array || array->size() > 1024) return std::nullopt;
  List list;
  for (const toml::node& element : *array) {
    const auto* value = element.as_integer();
    if (!value) return std::nullopt;
    list.push_back(value->get());
  }
  return list;
}

/// 0.005 for "0.5%".
std::optional<double> share_of(std::string_view text) {
  double value = 0.0;
  // from_chars knows no locale, so a file means the same everywhere.
  const char* const end = text.data() + text.size();
  const auto [rest, failed] = std::from_chars(text.data(), end, value);
  if (failed != std::errc() || rest + 1 != end || *rest != '%') return std::nullopt;
  return value / 100.0;
}

/// The node as a value of the option's type, whatever its range.
std::optional<Value> value_of(const Option& option, const toml::node& node) {
  const auto* text = node.as_string();
  if (text && !option.unset_word.empty() && text->get() == option.unset_word) return Value();
  switch (option.type) {
    case OptionType::boolean:
      if (const auto* value = node.as_boolean()) return Value(value->get());
      return std::nullopt;
    case OptionType::integer:
      if (const auto* value = node.as_integer()) return Value(value->get());
      return std::nullopt;
    case OptionType::real: {
      if (node.is_number()) return Value(*node.value<double>());
      const auto share = text && option.percent ? share_of(text->get()) : std::nullopt;
      return share ? std::optional<Value>(*share) : std::nullopt;
    }
    case OptionType::text:
    case OptionType::measured:
    case OptionType::choice:
      return text ? std::optional<Value>(text->get()) : std::nullopt;
    default:
      const auto list = whole_numbers(node);
      if (!list) return std::nullopt;
      const bool fits = option.type == OptionType::shape      ? list->size() == 2 || list->size() == 3
                        : option.type == OptionType::integers ? true
                                                              : list->size() == 2;
      return fits ? std::optional<Value>(*list) : std::nullopt;
  }
}

std::string_view kind_of_number(const Option& option) {
  switch (option.type) {
    case OptionType::integer:
      return "an integer ";
    case OptionType::real:
      return "a number ";
    default:
      return "";
  }
}

}  // namespace

std::string TableReader::read(const Option& option) {
  std::string key = option.key;
  const toml::node* node = find(key);
  for (std::size_t i = 0; !node && i < option.former.size(); ++i) {
    key = option.former[i];
    node = table_.get(key);
    if (node) known_.emplace_back(key);
  }
  if (!node) return "";
  const std::optional<Value> value = value_of(option, *node);
  if (!value) {
    const auto* text = node->as_string();
    // A text where a word or a percentage may stand is shown; a list that does not fit is too long to show.
    const bool may_be_text = !option.unset_word.empty() || option.percent;
    const std::string what = text && may_be_text ? "is " + in_quotes(text->get())
                             : node->is_array()  ? "is no such list"
                                                 : fmt::format("is {}", type_name(*node));
    mistake(key, what, fmt::format("{}{}", kind_of_number(option), allowed_text(option)));
    return key;
  }
  const std::string problem = out_of_range(option, *value);
  if (problem.empty()) {
    option.set(*value);
    return key;
  }
  std::string remedy;
  if (const auto* word = std::get_if<std::string>(&*value); word && option.type == OptionType::choice) {
    const std::string nearest = nearest_word(*word, option.words);
    if (!nearest.empty()) remedy = fmt::format("did you mean \"{}\"?", nearest);
    mistake(key, "is " + in_quotes(*word), allowed_text(option), remedy);
    return key;
  }
  mistake(key, problem, allowed_text(option));
  return key;
}

const toml::array* TableReader::array(std::string_view key, std::string_view limit) {
  const toml::node* node = find(key);
  if (!node) return nullptr;
  if (const toml::array* value = node->as_array()) return value;
  mistake(key, fmt::format("is {}", type_name(*node)), std::string(limit));
  return nullptr;
}

void TableReader::finish() {
  for (const auto& [key, node] : table_) {
    const std::string_view name = key.str();
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    std::vector<std::string> words = known_;
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    const std::string nearest = nearest_word(name, words);
    diagnostics_.add(static_cast<int>(key.source().begin.line),
                     fmt::format("{}: unknown key {}", what_, in_quotes(name)),
                     fmt::format("{}", fmt::join(words, ", ")),
                     nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest));
  }
}

}  // namespace bn::document
