// File names with a place for a number: "slice_%03d.png". Only the last part of a path may have one.

#include <fmt/format.h>

#include <optional>

#include "bn/volume.h"
#include "texture/error.h"
#include "texture/numbered_path.h"

namespace bn {
namespace texture {

NumberedName parse_numbered_name(const std::filesystem::path& path) {
  const std::string text = path.filename().string();
  NumberedName name;
  std::string* part = &name.before;
  bool strange = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      *part += text[i];
      continue;
    }
    const auto at = [&](std::size_t k) { return i + k < text.size() ? text[i + k] : '\0'; };
    if (at(1) == '%') {
      *part += '%';
      ++i;
      continue;
    }
    const bool padded = at(1) == '0' && at(2) >= '1' && at(2) <= '9' && at(3) == 'd';
    if (!padded && at(1) != 'd') {
      strange = true;
      continue;
    }
    if (name.has_number)
      fail_input(path.string(), "two numbers in its name", "one: %d, or %0Nd with N = 1..9");
    name.has_number = true;
    name.digits = padded ? at(2) - '0' : 1;
    part = &name.after;
    i += padded ? 3 : 1;
  }
  if (!name.has_number) {
    name.before = text;  // an ordinary name, whatever it holds
  } else if (strange) {
    fail_input(path.string(), "a '%' in its name that asks for no number, beside one that does",
               "%d, or %0Nd with N = 1..9", "write %% for a '%' of the name itself");
  }
  return name;
}

std::string number_text(const NumberedName& name, std::int64_t number) {
  return fmt::format("{:0{}}", number, name.digits);
}

std::optional<std::int64_t> number_in(const NumberedName& name, std::string_view file) {
  if (file.size() <= name.before.size() + name.after.size() || !file.starts_with(name.before) ||
      !file.ends_with(name.after)) {
    return std::nullopt;
  }
  const std::string_view digits =
      file.substr(name.before.size(), file.size() - name.before.size() - name.after.size());
  if (digits.size() > 9) return std::nullopt;
  std::int64_t number = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return std::nullopt;
    number = 10 * number + (c - '0');
  }
  // "%03d" makes 7 to "007" and to nothing else.
  if (number_text(name, number) != digits) return std::nullopt;
  return number;
}

}  // namespace texture

bool has_number(const std::filesystem::path& path) { return texture::parse_numbered_name(path).has_number; }

std::filesystem::path numbered_path(const std::filesystem::path& pattern, int number) {
  const texture::NumberedName name = texture::parse_numbered_name(pattern);
  if (!name.has_number) {
    texture::fail_input(pattern.string(), "no place for a number in its name", "%d, or %0Nd with N = 1..9",
                        "name it like slice_%03d.png");
  }
  if (number < 0) texture::fail_input(pattern.string(), fmt::format("number {}", number), "0 and above");
  return pattern.parent_path() / (name.before + texture::number_text(name, number) + name.after);
}

}  // namespace bn
