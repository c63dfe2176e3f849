#include "tools/slice_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <system_error>

#include "bn/error.h"
#include "bn/texture.h"

namespace bn::tools {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_texture_name(const fs::path& path) {
  static constexpr std::array<std::string_view, 16> kExtensions{
      ".png", ".exr", ".tif", ".tiff", ".bin", ".h",   ".ktx2", ".dds",
      ".bmp", ".hdr", ".pfm", ".pgm",  ".ppm", ".tga", ".jpg",  ".jpeg"};
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

/// A name as texts and the numbers between them; numbers beyond 18 digits count as text.
struct SplitName {
  std::vector<std::string> texts{""};
  std::vector<std::int64_t> numbers;
};
SplitName split(const std::string& name) {
  SplitName result;
  for (std::size_t i = 0; i < name.size();) {
    std::size_t end = i;
    while (end < name.size() && is_digit(name[end])) ++end;
    if (end == i || end - i > 18) {
      end = std::max(end, i + 1);
      result.texts.back() += name.substr(i, end - i);
    } else {
      result.numbers.push_back(std::stoll(name.substr(i, end - i)));
      result.texts.emplace_back();
    }
    i = end;
  }
  return result;
}

/// The numbers by which the names differ, if they differ in one place only.
std::vector<std::int64_t> slice_numbers(const std::vector<fs::path>& files) {
  std::vector<SplitName> names;
  for (const fs::path& file : files) names.push_back(split(file.filename().string()));
  std::optional<std::size_t> place;
  for (const SplitName& name : names) {
    if (name.texts != names[0].texts) return {};
    for (std::size_t i = 0; i < name.numbers.size(); ++i) {
      if (name.numbers[i] == names[0].numbers[i]) continue;
      if (place && *place != i) return {};
      place = i;
    }
  }
  if (!place) return {};
  std::vector<std::int64_t> numbers;
  for (const SplitName& name : names) numbers.push_back(name.numbers[*place]);
  return numbers;
}

std::string missing_between(const std::vector<std::int64_t>& numbers) {
  std::string missing;
  int listed = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    for (std::int64_t n = numbers[i - 1] + 1; n < numbers[i]; ++n) {
      if (++listed > 8) return missing + ", ...";
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", n);
    }
  }
  return missing;
}

}  // namespace

std::vector<fs::path> textures_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
  while (!error && entry != end) {
    std::error_code ignored;
    if (entry->path().filename().string().starts_with('.')) {
      if (entry->is_directory(ignored)) entry.disable_recursion_pending();
    } else if (entry->is_regular_file(ignored) && is_texture_name(entry->path())) {
      files.push_back(entry->path());
    }
    entry.increment(error);
  }
  if (error) {
    throw Error({.code = ErrorCode::io,
                 .what = error.message(),
                 .where = folder.string(),
                 .limit = "",
                 .remedy = "check the path and its permissions"});
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.generic_string(), b.generic_string());
  });
  return files;
}

SliceFiles in_slice_order(std::vector<fs::path> files) {
  SliceFiles result{.files = files, .notes = {}};
  std::sort(result.files.begin(), result.files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.generic_string(), b.generic_string());
  });
  if (result.files != files) {
    result.notes.push_back("the slices are taken in the order of their numbers, not in the order given");
  }
  if (const std::string missing = missing_between(slice_numbers(result.files)); !missing.empty()) {
    result.notes.push_back(fmt::format("slices are missing from the volume: {}", missing));
  }
  return result;
}

}  // namespace bn::tools
