#include "tools/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "bn/error.h"
#include "bn/options.h"
#include "bn/texture.h"

namespace bn::tools {
namespace {

[[noreturn]] void fail(std::string_view text, std::string_view where, std::string_view what,
                       std::string_view allowed, std::string_view remedy = "") {
  throw Error({.code = ErrorCode::usage,
               .what = fmt::format("'{}' {}", text, what),
               .where = std::string(where),
               .limit = std::string(allowed),
               .remedy = std::string(remedy)});
}

/// The number that `text` is from its first to its last character; locale plays no part.
template <class T>
std::optional<T> whole_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

/// As whole_number(), but a number too large for T is its largest, so that the range check names it.
template <class T>
std::optional<T> saturated_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    return text.front() == '-' ? std::numeric_limits<T>::lowest() : std::numeric_limits<T>::max();
  }
  return error == std::errc{} ? std::optional<T>(value) : std::nullopt;
}

/// Splits "256x128" at the one separator.
std::optional<std::pair<std::string_view, std::string_view>> halves(std::string_view text, char separator) {
  const auto at = text.find(separator);
  if (at == std::string_view::npos) return std::nullopt;
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

Offset offset_from(std::string_view text, std::string_view where, std::string_view allowed) {
  const auto parts = halves(text, ',');
  const auto x = parts ? whole_number<int>(parts->first) : std::nullopt;
  const auto y = parts ? whole_number<int>(parts->second) : std::nullopt;
  if (!x || !y) fail(text, where, "is no step", allowed, "write it like 48,36");
  return {*x, *y};
}

ValueKind<std::filesystem::path> path(std::string placeholder, Completion completion) {
  return {.placeholder = std::move(placeholder),
          .allowed = "",
          .parse =
              [](std::string_view text, std::string_view where) {
                check_path_word(text, where);
                return std::filesystem::path(text);
              },
          .show = [](const std::filesystem::path& value) { return value.string(); },
          .completion = completion};
}

}  // namespace

ValueKind<int> integer_in(int low, int high) {
  const std::string allowed = fmt::format("{}..{}", low, high);
  return {.placeholder = "N",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                const auto value = saturated_number<int>(text);
                if (!value) fail(text, where, "is no whole number", allowed);
                if (*value < low || *value > high) fail(text, where, "is out of range", allowed);
                return *value;
              },
          .show = [](const int& value) { return fmt::format("{}", value); }};
}

ValueKind<std::vector<int>> integer_list(int low, int high, std::size_t most_of_them) {
  const std::string allowed = fmt::format("1..{} whole numbers, each {}..{}", most_of_them, low, high);
  return {.placeholder = "N,N...",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                std::vector<int> values;
                for (std::string_view rest = text;;) {
                  const std::size_t comma = rest.find(',');
                  const auto value = saturated_number<int>(rest.substr(0, comma));
                  if (!value) fail(text, where, "is no list of numbers", allowed, "write it like 0,1,2");
                  if (*value < low || *value > high) fail(text, where, "has a number out of range", allowed);
                  values.push_back(*value);
                  if (values.size() > most_of_them) fail(text, where, "is too long", allowed);
                  if (comma == std::string_view::npos) return values;
                  rest = rest.substr(comma + 1);
                }
              },
          .show = [](const std::vector<int>& values) { return fmt::format("{}", fmt::join(values, ",")); }};
}

ValueKind<std::vector<std::string>> word_list(std::vector<std::string> words) {
  words.insert(words.begin(), "all");
  ValueKind<std::vector<std::string>> kind;
  kind.placeholder = "NAMES";
  kind.allowed = fmt::format("{}; several with commas", fmt::join(words, ", "));
  kind.completion = Completion::choice;
  kind.choices = words;
  kind.parse = [words](std::string_view text, std::string_view where) {
    std::vector<std::string> chosen;
    if (text == words.front()) return chosen;
    while (true) {
      const auto comma = std::min(text.find(','), text.size());
      const std::string word(text.substr(0, comma));
      if (std::find(words.begin() + 1, words.end(), word) == words.end()) fail_choice(word, where, words);
      if (std::find(chosen.begin(), chosen.end(), word) == chosen.end()) chosen.push_back(word);
      if (comma == text.size()) return chosen;
      text.remove_prefix(comma + 1);
    }
  };
  kind.show = [](const std::vector<std::string>& chosen) {
    return chosen.empty() ? "all" : fmt::format("{}", fmt::join(chosen, ","));
  };
  return kind;
}

namespace {

/// 1000000 as 1e6.
std::string short_count(std::int64_t value) {
  int zeros = 0;
  for (std::int64_t rest = value; rest != 0 && rest % 10 == 0; rest /= 10) ++zeros;
  if (zeros < 3) return std::to_string(value);
  for (int i = 0; i < zeros; ++i) value /= 10;
  return fmt::format("{}e{}", value, zeros);
}

}  // namespace

ValueKind<std::vector<std::int64_t>> count_list(std::int64_t low, std::int64_t high) {
  const std::string allowed =
      fmt::format("whole numbers that rise, each {}..{}", short_count(low), short_count(high));
  ValueKind<std::vector<std::int64_t>> kind;
  kind.placeholder = "N,N...";
  kind.allowed = allowed;
  kind.parse = [=](std::string_view text, std::string_view where) {
    std::vector<std::int64_t> values;
    for (std::string_view rest = text;;) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      const double value =
          real_in(static_cast<double>(low), static_cast<double>(high)).parse(rest.substr(0, comma), where);
      if (value != std::floor(value) || (!values.empty() && value <= static_cast<double>(values.back())))
        fail(text, where, "is no such list", allowed, "write it like 1e6,1e7");
      values.push_back(static_cast<std::int64_t>(value));
      if (comma == rest.size()) return values;
      rest.remove_prefix(comma + 1);
    }
  };
  kind.show = [](const std::vector<std::int64_t>& values) {
    std::string text;
    for (const std::int64_t value : values) text += (text.empty() ? "" : ",") + short_count(value);
    return text;
  };
  return kind;
}

ValueKind<std::uint64_t> seed_value() {
  constexpr auto kLargest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const std::string allowed = fmt::format("0..{}", kLargest);
  return {.placeholder = "N",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                const auto value = saturated_number<std::uint64_t>(text);
                if (!value) fail(text, where, "is no seed", allowed);
                if (*value > kLargest) fail(text, where, "is out of range", allowed);
                return *value;
              },
          .show = [](const std::uint64_t& value) { return fmt::format("{}", value); }};
}

ValueKind<double> real_in(double low, double high, std::string unit) {
  const std::string allowed = fmt::format("{}..{}{}", low, high, unit.empty() ? "" : " " + unit);
  return {.placeholder = "NUMBER",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                const auto value = whole_number<double>(text);
                if (!value) fail(text, where, "is no number", allowed);
                if (!(*value >= low && *value <= high)) fail(text, where, "is out of range", allowed);
                return *value;
              },
          .show = [](const double& value) { return fmt::format("{}", value); }};
}

ValueKind<double> percentage_in(double low_percent, double high_percent) {
  const std::string allowed = fmt::format("{}%..{}%", low_percent, high_percent);
  return {.placeholder = "PERCENT",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                const bool has_sign = text.ends_with('%');
                const auto value = whole_number<double>(has_sign ? text.substr(0, text.size() - 1) : text);
                if (!value) fail(text, where, "is no percentage", allowed, "write it like 0.5%");
                if (!has_sign && *value != 0) {
                  fail(text, where, "has no % sign", allowed, fmt::format("write {}%", text));
                }
                if (!(*value >= low_percent && *value <= high_percent)) {
                  fail(text, where, "is out of range", allowed);
                }
                return *value / 100;
              },
          .show = [](const double& value) { return fmt::format("{}%", value * 100); }};
}

ValueKind<Extent> extent_in(int low, int high) {
  const std::string allowed = fmt::format("each {}..{}", low, high);
  return {.placeholder = "WIDTHxHEIGHT",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                const auto sides = halves(text, 'x');
                const auto width = sides ? saturated_number<int>(sides->first) : std::nullopt;
                const auto height = sides ? saturated_number<int>(sides->second) : std::nullopt;
                if (!width || !height) fail(text, where, "is no size", allowed, "write it like 256x256");
                if (*width < low || *width > high || *height < low || *height > high) {
                  fail(text, where, "is out of range", allowed);
                }
                return Extent{*width, *height};
              },
          .show = [](const Extent& value) { return fmt::format("{}x{}", value.width, value.height); }};
}

ValueKind<std::optional<Offset>> offset() {
  return {.placeholder = "X,Y",
          .allowed = "two whole numbers",
          .parse = [](std::string_view text, std::string_view where) -> std::optional<Offset> {
            return offset_from(text, where, "two whole numbers");
          },
          .show = {}};
}

ValueKind<std::optional<Offset>> offset_or_auto() {
  return {.placeholder = "X,Y|auto",
          .allowed = "two whole numbers, or auto",
          .parse = [](std::string_view text, std::string_view where) -> std::optional<Offset> {
            if (text == "auto") return std::nullopt;
            return offset_from(text, where, "two whole numbers, or auto");
          },
          .show =
              [](const std::optional<Offset>& value) {
                return value ? fmt::format("{},{}", value->x, value->y) : "auto";
              },
          .completion = Completion::choice,
          .choices = {"auto"}};
}

ValueKind<std::uint64_t> memory_size() {
  constexpr std::string_view kUnits = "KMGT";
  const std::string allowed = "a whole number and one of K, M, G, T; at least 1M";
  return {.placeholder = "SIZE",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                const auto unit = text.empty() ? std::string_view::npos : kUnits.find(text.back());
                const auto count = whole_number<std::uint64_t>(text.substr(0, text.size() - !text.empty()));
                if (unit == std::string_view::npos || !count) {
                  fail(text, where, "is no memory size", allowed, "write it like 8G");
                }
                const unsigned shift = 10 * (static_cast<unsigned>(unit) + 1);
                const bool fits = *count <= (std::numeric_limits<std::uint64_t>::max() >> shift);
                if (!fits || (*count << shift) < (std::uint64_t{1} << 20)) {
                  fail(text, where, "is out of range", allowed);
                }
                return *count << shift;
              },
          .show =
              [=](const std::uint64_t& bytes) {
                unsigned unit = 0;
                while (unit < 3 && (bytes >> (10 * (unit + 2))) << (10 * (unit + 2)) == bytes) ++unit;
                return fmt::format("{}{}", bytes >> (10 * (unit + 1)), kUnits[unit]);
              }};
}

void check_path_word(std::string_view text, std::string_view where) {
  if (text.empty()) fail(text, where, "names no file or folder", "a path that is not empty");
  if (text == "-") {
    fail(text, where, "means standard input or output, and bn reads and writes files only", "a path",
         "name a file, one called - by ./-");
  }
}

ValueKind<std::string> any_text(std::string placeholder, std::vector<std::string> suggestions) {
  ValueKind<std::string> kind;
  kind.placeholder = std::move(placeholder);
  if (!suggestions.empty()) kind.completion = Completion::file;
  kind.choices = std::move(suggestions);
  kind.parse = [](std::string_view text, std::string_view) { return std::string(text); };
  kind.show = [](const std::string& text) { return text; };
  return kind;
}

ValueKind<std::filesystem::path> file_path() { return path("FILE", Completion::file); }
ValueKind<std::filesystem::path> text_path() {
  ValueKind<std::filesystem::path> kind = file_path();
  kind.parse = [parse = kind.parse](std::string_view text, std::string_view where) {
    std::filesystem::path path = parse(text, where);
    try {
      check_extension(path);
    } catch (const Error&) {
      return path;
    }
    fail(text, where, "names a texture, and text is written there", "another extension");
  };
  return kind;
}
ValueKind<std::filesystem::path> texture_path() {
  ValueKind<std::filesystem::path> kind = file_path();
  kind.parse = [parse = kind.parse](std::string_view text, std::string_view where) {
    std::filesystem::path path = parse(text, where);
    try {
      check_extension(path);
    } catch (const Error& error) {
      fail(text, where, fmt::format("names no format: {}", error.info().what), error.info().limit);
    }
    return path;
  };
  return kind;
}
ValueKind<std::filesystem::path> folder_path() { return path("DIR", Completion::folder); }

void fail_choice(std::string_view text, std::string_view where, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(text, words);
  fail(text, where, "is not a choice", fmt::format("{}", fmt::join(words, ", ")),
       nearest.empty() ? "" : fmt::format("did you mean {}?", nearest));
}

}  // namespace bn::tools
