#include "bake/recipe_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bn {
namespace {

/// Texts of strangers go into messages: shortened, and without control characters.
std::string quoted(std::string_view text) {
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

std::string range_text(std::int64_t least, std::int64_t most) { return fmt::format("{}..{}", least, most); }

}  // namespace

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  if (word.size() > 40) return "";
  std::string nearest;
  int least = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& candidate : words) {
    const int distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

TableReader::TableReader(const toml::table& table, std::string what, Mistakes& mistakes)
    : table_(table), what_(std::move(what)), mistakes_(mistakes), line_(line_of(table)) {}

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
  mistakes_.add(line(key), fmt::format("{}: {} {}", what_, key, problem), std::move(limit),
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

double TableReader::number(std::string_view key, double otherwise, double least, double most) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  const std::string limit = fmt::format("{}..{}", least, most);
  if (!node->is_number()) {
    mistake(key, fmt::format("is {}", type_name(*node)), "a number " + limit);
    return otherwise;
  }
  const double value = *node->value<double>();
  // Written so that NaN fails.
  if (value >= least && value <= most) return value;
  mistake(key, fmt::format("is {}", value), limit);
  return otherwise;
}

bool TableReader::boolean(std::string_view key, bool otherwise) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  if (const auto* value = node->as_boolean()) return value->get();
  mistake(key, fmt::format("is {}", type_name(*node)), "true or false");
  return otherwise;
}

int TableReader::choice(std::string_view key, int otherwise, const std::vector<std::string>& words) {
  const toml::node* node = find(key);
  if (!node) return otherwise;
  const std::string limit = fmt::format("\"{}\"", fmt::join(words, "\", \""));
  const auto* value = node->as_string();
  if (!value) {
    mistake(key, fmt::format("is {}", type_name(*node)), limit);
    return otherwise;
  }
  const auto found = std::find(words.begin(), words.end(), value->get());
  if (found != words.end()) return static_cast<int>(found - words.begin());
  const std::string nearest = nearest_word(value->get(), words);
  mistake(key, fmt::format("is {}", quoted(value->get())), limit,
          nearest.empty() ? "" : fmt::format("did you mean \"{}\"?", nearest));
  return otherwise;
}

std::optional<Offset> TableReader::pair(std::string_view key, std::int64_t least, std::int64_t most,
                                        std::string_view alternative) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const std::string limit = fmt::format("{}[x, y], each {}", alternative, range_text(least, most));
  const toml::array* both = node->as_array();
  if (!both || both->size() != 2 || !both->get(0)->is_integer() || !both->get(1)->is_integer()) {
    const bool text = node->is_string();
    mistake(key, text ? "is " + quoted(node->as_string()->get()) : "is no pair of integers", limit);
    return std::nullopt;
  }
  const std::int64_t x = both->get(0)->as_integer()->get(), y = both->get(1)->as_integer()->get();
  if (x < least || x > most || y < least || y > most) {
    mistake(key, fmt::format("is [{}, {}]", x, y), limit);
    return std::nullopt;
  }
  return Offset{static_cast<int>(x), static_cast<int>(y)};
}

std::vector<int> TableReader::integers(std::string_view key, std::size_t most_of_them, int least, int most) {
  const std::string limit =
      fmt::format("[n, ...], 1..{} integers, each {}", most_of_them, range_text(least, most));
  const toml::array* list = array(key, limit);
  if (!list) return {};
  std::vector<int> values;
  for (const toml::node& node : *list) {
    const auto* value = node.as_integer();
    if (!value || value->get() < least || value->get() > most) break;
    values.push_back(static_cast<int>(value->get()));
  }
  if (!list->empty() && values.size() == list->size() && values.size() <= most_of_them) return values;
  mistake(key, "is no such list", limit);
  return {};
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
    mistakes_.add(static_cast<int>(key.source().begin.line),
                  fmt::format("{}: unknown key {}", what_, quoted(name)),
                  fmt::format("{}", fmt::join(words, ", ")),
                  nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest));
  }
}

}  // namespace bn
