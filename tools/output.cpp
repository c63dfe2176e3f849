#include "tools/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bn/error.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

/// File names may hold any bytes; JSON may not.
std::string dump(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string scalar_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_null()) return "none";
  return dump(value);
}

bool is_list_of_scalars(const Json& value) {
  if (!value.is_array()) return false;
  for (const auto& item : value) {
    if (item.is_structured()) return false;
  }
  return true;
}

/// Indented; a list of plain values, such as a size or a curve, stays on one line.
void print(const Json& value, const std::string& indent, std::string& text) {
  if (is_list_of_scalars(value)) {
    text += '[';
    for (std::size_t i = 0; i < value.size(); ++i) text += (i > 0 ? ", " : "") + dump(value[i]);
    text += ']';
    return;
  }
  if (!value.is_structured() || value.empty()) {
    text += dump(value);
    return;
  }
  const std::string inner = indent + "  ";
  text += value.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    text += (first ? "\n" : ",\n") + inner;
    first = false;
    if (value.is_object()) text += dump(Json(key)) + ": ";
    print(item, inner, text);
  }
  text += "\n" + indent + (value.is_object() ? "}" : "]");
}

/// As https://no-color.org asks: set and not empty means no.
bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDOUT_FILENO) == 1 && (!no_colour || !*no_colour) && terminal &&
         std::string_view(terminal) != "dumb";
}

using Lines = std::vector<std::pair<std::string, std::string>>;

void flatten(const std::string& name, const Json& value, Lines& lines) {
  if (value.is_object()) {
    for (const auto& [key, item] : value.items()) flatten(name.empty() ? key : name + "." + key, item, lines);
  } else if (is_list_of_scalars(value)) {
    std::string joined;
    for (const auto& item : value) joined += (joined.empty() ? "" : ",") + scalar_text(item);
    lines.emplace_back(name, joined);
  } else if (value.is_array()) {
    // A line an item, of which the first names them all.
    for (std::size_t i = 0; i < value.size(); ++i) {
      Lines members;
      flatten("", value[i], members);
      std::string joined;
      for (const auto& [member, text] : members) joined += (joined.empty() ? "" : "  ") + text;
      lines.emplace_back(i == 0 ? name : "", joined);
    }
  } else {
    lines.emplace_back(name, scalar_text(value));
  }
}

}  // namespace

void Output::write(std::string_view text) {
  while (!text.empty() && !reader_is_gone_) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EPIPE) {
      reader_is_gone_ = true;
    } else if (errno != EINTR) {
      throw Error({.code = ErrorCode::io,
                   .what = fmt::format("cannot write: {}", std::generic_category().message(errno)),
                   .where = "standard output",
                   .limit = "",
                   .remedy = "free space where it goes, or send it elsewhere"});
    }
  }
}

Output::Output(bool quiet) : quiet_(quiet), coloured_(wants_colour()) {}

void Output::tell(std::string_view text) {
  if (quiet_) return;
  write(coloured_ ? with_coloured_verdicts(text) : std::string(text));
}

void Output::write_result(const Json& result, bool as_json) {
  if (!as_json) return tell(lines_of(result));
  std::string text;
  print(result, "", text);
  write(text + "\n");
}

std::string paragraph(std::string_view text, std::size_t indent) {
  std::string result;
  while (!text.empty()) {
    std::size_t end = text.size();
    if (indent + end > kTextColumns) {
      end = text.rfind(' ', kTextColumns - indent);
      if (end == std::string_view::npos || end == 0) end = std::min(text.find(' ', 1), text.size());
    }
    result += std::string(indent, ' ') + std::string(text.substr(0, end)) + "\n";
    text.remove_prefix(end);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  return result;
}

std::string lines_of(const Json& result) {
  Lines lines;
  flatten("", result, lines);
  std::size_t width = 0;
  for (const auto& [name, value] : lines) width = std::max(width, name.size());
  std::string text;
  for (const auto& [name, value] : lines) text += fmt::format("{:{}}  {}\n", name, width, value);
  return text;
}

std::string with_coloured_verdicts(std::string_view text) {
  constexpr std::string_view kGreen = "\033[32m", kYellow = "\033[33m", kRed = "\033[1;31m", kEnd = "\033[0m";
  std::string coloured;
  while (!text.empty()) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    std::size_t end = 0;
    while (end < text.size() && is_letter(text[end])) ++end;
    const std::string_view word = text.substr(0, end);
    const std::string_view ink = word == "pass"   ? kGreen
                                 : word == "weak" ? kYellow
                                 : word == "FAIL" ? kRed
                                                  : "";
    coloured += ink.empty() ? std::string(word) : fmt::format("{}{}{}", ink, word, kEnd);
    text.remove_prefix(end);
    while (!text.empty() && !is_letter(text.front())) {
      coloured += text.front();
      text.remove_prefix(1);
    }
  }
  return coloured;
}

}  // namespace bn::tools
