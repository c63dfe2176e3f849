// toml++ 3.3 (Debian 12) runs into undefined behaviour on some texts, found by the recipe fuzzer:
//   [.a]       it takes for granted that a table header begins with a key,
//   a = [ }    that a bracket closes what was opened,
//   key ä      and that a letter such as ä, outside strings and comments, never comes up.
// Recipes and scenes need none of them, nor strings of several lines. This scan of lines, strings, comments
// and brackets refuses them, with the line. It need be right only up to the first mistake, because the parser
// is not called after one.

#include "core/toml_check.h"

#include "core/utf8.h"

namespace bn::document {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::string_view kBlank = " \t\r";

/// Whether a line that begins with '[' goes on with a key.
bool is_header_with_key(std::string_view line) {
  line.remove_prefix(line.starts_with("[[") ? 2 : 1);
  const std::size_t at = line.find_first_not_of(kBlank);
  if (at == line.npos) return false;
  const char c = line[at];
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '"' || c == '\'';
}

/// What is wrong with a line, or nothing. `open` holds the brackets that are open before and after it.
std::string_view problem_of(std::string_view line, std::string& open) {
  const std::size_t first = line.find_first_not_of(kBlank);
  if (first != line.npos && line[first] == '[' && !is_header_with_key(line.substr(first))) {
    return "a table header without a key";
  }
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') {
        ++i;
      } else if (c == quote) {
        quote = 0;
      }
    } else if (c == '#') {
      break;
    } else if (c == '"' || c == '\'') {
      if (line.substr(i, 3) == std::string_view(c == '"' ? "\"\"\"" : "'''"))
        return "a string of several lines";
      quote = c;
    } else if (c == '[' || c == '{') {
      open += c;
    } else if (c == ']' || c == '}') {
      if (open.empty() || open.back() != (c == ']' ? '[' : '{')) return "a bracket that closes none";
      open.pop_back();
    } else if (static_cast<unsigned char>(c) >= 0x7f) {
      return "a character beyond ASCII outside a string";
    }
  }
  return quote != 0 ? "a string without its end" : "";
}

}  // namespace

void check_toml(std::string_view text, Diagnostics& diagnostics) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::string open;
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view here = text.substr(0, text.find('\n'));
    text.remove_prefix(here.size() < text.size() ? here.size() + 1 : here.size());
    if (!is_utf8(here)) {
      diagnostics.add(line, "text that is not UTF-8", "UTF-8, in names of files too",
                      "save the text as UTF-8, and rename files whose names are not");
      continue;
    }
    const std::string_view problem = problem_of(here, open);
    if (!problem.empty())
      diagnostics.add(line, std::string(problem), "TOML 1.0, without strings of several lines");
  }
}

}  // namespace bn::document
