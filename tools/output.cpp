#include "tools/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bn/error.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

/// File names may hold any bytes; JSON may not.
std::string dump(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string scalar_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_null()) return "none";
  return dump(value, -1);
}

bool is_list_of_scalars(const Json& value) {
  if (!value.is_array()) return false;
  for (const auto& item : value) {
    if (item.is_structured()) return false;
  }
  return true;
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
    for (std::size_t i = 0; i < value.size(); ++i) flatten(fmt::format("{}[{}]", name, i), value[i], lines);
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

void Output::write_result(const Json& result, bool as_json) {
  if (as_json) return write(dump(result, 2) + "\n");
  Lines lines;
  flatten("", result, lines);
  std::size_t width = 0;
  for (const auto& [name, value] : lines) width = std::max(width, name.size());
  std::string text;
  for (const auto& [name, value] : lines) text += fmt::format("{:{}}  {}\n", name, width, value);
  write(text);
}

}  // namespace bn::tools
