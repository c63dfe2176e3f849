#include "bake/paths.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/refuse.h"

namespace bn::baking {

std::string lower_case_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

SampleType natural_type(const std::string& path) {
  return lower_case_extension(path) == ".exr" ? SampleType::f32 : SampleType::u8;
}

std::string path_problem(const std::string& text) {
  constexpr std::size_t kMaxPathLength = 1024;
  if (text.empty()) return "is empty";
  if (text.size() > kMaxPathLength) return "is too long";
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; })) {
    return "has control characters";
  }
  const std::filesystem::path path(text);
  if (path.is_absolute()) return "is absolute";
  if (std::any_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; })) {
    return "leaves the output folder";
  }
  if (!path.has_filename() || path.filename() == ".") return "names no file";
  return "";
}

std::string numbered_path(const std::string& pattern, int number) {
  std::string result;
  int places = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      result += pattern[i];
      continue;
    }
    ++i;
    if (i < pattern.size() && pattern[i] == '%') {
      result += '%';
      continue;
    }
    const bool zeros = i < pattern.size() && pattern[i] == '0';
    if (zeros) ++i;
    int width = 0;
    while (i < pattern.size() && pattern[i] >= '0' && pattern[i] <= '9' && width < 10) {
      width = width * 10 + (pattern[i++] - '0');
    }
    if (i >= pattern.size() || pattern[i] != 'd')
      refuse(pattern, "has a % without a number's place", "%d or %03d");
    result += zeros ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width);
    ++places;
  }
  if (places != 1) {
    refuse(pattern, places == 0 ? "has no place for a number" : "has several places for a number",
           "one %d, or %03d for three digits");
  }
  return result;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code failed;
  return std::filesystem::equivalent(a, b, failed) && !failed;
}

}  // namespace bn::baking
