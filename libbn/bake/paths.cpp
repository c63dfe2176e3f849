#include "bake/paths.h"

#include <algorithm>

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

}  // namespace bn::baking
