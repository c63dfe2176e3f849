// Which files are the slices of a volume, and in what order.
//
// Published stacks are numbered without leading zeros (..._0.png to ..._63.png), and a shell lists them 0, 1,
// 10, 11; taken so, a texture that is blue in time is read as one that is not. So files are put into numeric
// order, and where their names differ in nothing but one number, gaps and repetitions are found.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "bn/volume.h"
#include "texture/codec.h"
#include "texture/error.h"
#include "texture/numbered_path.h"

namespace bn {
namespace {

namespace fs = std::filesystem;
using texture::fail_input;

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

bool is_image_name(const fs::path& path) {
  if (is_hidden(path) || path.stem() == "contact_sheet") return false;
  return has_image_name(path);
}

bool path_less(const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); }

/// Regular files right in `folder` whose name `take` accepts, in order.
template <class Take>
std::vector<fs::path> files_in(const fs::path& folder, Take take) {
  std::vector<fs::path> files;
  std::error_code error;
  const fs::path opened = folder.empty() ? fs::path(".") : folder;
  for (fs::directory_iterator entry(opened, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const fs::path path = folder / entry->path().filename();
    if (take(path) && entry->is_regular_file(ignored)) files.push_back(path);
  }
  if (error) {
    texture::fail_io(folder.string(), "cannot be read: " + error.message(),
                     "check the folder and its permissions");
  }
  std::sort(files.begin(), files.end(), path_less);
  return files;
}

/// A name cut into its numbers and what stands between them. Numbers are without leading zeros.
struct NameParts {
  std::vector<std::string> text, numbers;
};

NameParts parts_of(const std::string& name) {
  NameParts parts;
  parts.text.emplace_back();
  for (std::size_t i = 0; i < name.size();) {
    if (name[i] < '0' || name[i] > '9') {
      parts.text.back() += name[i++];
      continue;
    }
    std::size_t end = i;
    while (end < name.size() && name[end] >= '0' && name[end] <= '9') ++end;
    while (i + 1 < end && name[i] == '0') ++i;
    parts.numbers.push_back(name.substr(i, end - i));
    parts.text.emplace_back();
    i = end;
  }
  return parts;
}

/// The numbers of files whose names differ in one number only; nothing for other names.
std::optional<std::vector<std::int64_t>> numbers_of(const std::vector<fs::path>& files) {
  if (files.size() < 2) return std::nullopt;
  std::vector<NameParts> names;
  for (const fs::path& file : files) names.push_back(parts_of(file.string()));
  std::optional<std::size_t> place;
  for (const NameParts& name : names) {
    if (name.text != names[0].text) return std::nullopt;
    for (std::size_t i = 0; i < name.numbers.size(); ++i) {
      if (name.numbers[i] == names[0].numbers[i]) continue;
      if (place && *place != i) return std::nullopt;
      place = i;
    }
  }
  // The same number in all: they differ in leading zeros only, say in the last of them.
  if (!place && names[0].numbers.empty()) return std::nullopt;
  const std::size_t at = place.value_or(names[0].numbers.size() - 1);
  std::vector<std::int64_t> numbers;
  for (const NameParts& name : names) {
    if (name.numbers[at].size() > 15) return std::nullopt;
    numbers.push_back(std::stoll(name.numbers[at]));
  }
  return numbers;
}

/// What is wrong with numbers in increasing order; empty if they follow one another.
std::string gap_text(const std::vector<std::int64_t>& numbers) {
  std::int64_t missing = 0;
  std::string first;
  int shown = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const std::int64_t gap = numbers[i] - numbers[i - 1] - 1;
    missing += std::max<std::int64_t>(gap, 0);
    for (std::int64_t k = 1; k <= gap && shown < 5; ++k, ++shown) {
      first += fmt::format("{}{}", first.empty() ? "" : ", ", numbers[i - 1] + k);
    }
  }
  if (missing == 0) return "";
  const std::string more = missing > shown ? fmt::format(" and {} more", missing - shown) : "";
  return fmt::format("{} {}{} missing between {} and {}", missing == 1 ? "number" : "numbers", first,
                     more + (missing == 1 ? " is" : " are"), numbers.front(), numbers.back());
}

void check_repeats(const std::vector<fs::path>& files, const std::vector<std::int64_t>& numbers) {
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (numbers[i] != numbers[i - 1]) continue;
    fail_input(files[i].string(), fmt::format("number {} comes twice", numbers[i]), "once",
               fmt::format("keep it or {}", files[i - 1].string()));
  }
}

/// The name that every path to one file has in common.
fs::path canonical_path(const fs::path& path) {
  std::error_code failed;
  const fs::path found = fs::weakly_canonical(path, failed);
  return failed ? fs::absolute(path).lexically_normal() : found;
}

std::vector<fs::path> files_of_pattern(const fs::path& pattern) {
  const texture::NumberedName name = texture::parse_numbered_name(pattern);
  return files_in(pattern.parent_path(), [&](const fs::path& path) {
    return texture::number_in(name, path.filename().string()).has_value();
  });
}

}  // namespace

std::vector<fs::path> image_files(const fs::path& folder) { return files_in(folder, is_image_name); }

std::vector<fs::path> image_files_below(const fs::path& folder) {
  std::vector<fs::path> files = image_files(folder);  // with the error for a folder that cannot be read
  std::error_code error;
  const fs::path opened = folder.empty() ? fs::path(".") : folder;
  constexpr auto kPassOver = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(opened, kPassOver, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (is_hidden(entry->path())) {
      if (entry->is_directory(ignored)) entry.disable_recursion_pending();
      continue;
    }
    if (entry.depth() > 0 && is_image_name(entry->path()) && entry->is_regular_file(ignored))
      files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end(), path_less);
  return files;
}

bool would_replace(const fs::path& output, const fs::path& input) {
  std::vector<fs::path> read = {input};
  try {
    read = slice_files(std::span(&input, 1)).files;
  } catch (const Error&) {
    // What cannot be read is named where it is read.
  }
  texture::NumberedName pattern;
  try {
    pattern = texture::parse_numbered_name(output);
  } catch (const Error&) {
    // Two numbers in a name: no pattern.
  }
  const fs::path folder = canonical_path(output.parent_path().empty() ? fs::path(".") : output.parent_path());
  return std::any_of(read.begin(), read.end(), [&](const fs::path& file) {
    const fs::path found = canonical_path(file);
    return found == canonical_path(output) || (found.parent_path() == folder && pattern.has_number &&
                                               texture::number_in(pattern, found.filename().string()));
  });
}

SliceFiles slice_files(std::span<const fs::path> inputs) {
  if (inputs.empty()) fail_input("slices", "no files", "one or more files, a folder or a pattern");
  SliceFiles slices;
  bool chosen = true;  // each file was named
  for (const fs::path& input : inputs) {
    std::error_code error;
    std::vector<fs::path> found = {input};
    if (fs::is_directory(input, error)) {
      found = image_files(input);
      chosen = false;
      if (found.empty()) {
        fail_input(input.string(), "there is no image in this folder", "", "name a folder of slices");
      }
    } else if (!fs::exists(input, error) && has_number(input)) {
      found = files_of_pattern(input);
      chosen = false;
      if (found.empty()) {
        fail_input(
            input.string(), "there is no file of this name and a number", "",
            fmt::format("it begins with {}, for example", numbered_path(input, 0).filename().string()));
      }
    }
    slices.files.insert(slices.files.end(), found.begin(), found.end());
  }
  if (!std::is_sorted(slices.files.begin(), slices.files.end(), path_less)) {
    std::stable_sort(slices.files.begin(), slices.files.end(), path_less);
    slices.notes.push_back("the slices were put into numeric order: " + slices.files.front().string() +
                           " to " + slices.files.back().string());
  }
  if (const auto numbers = numbers_of(slices.files)) {
    check_repeats(slices.files, *numbers);
    const std::string gap = gap_text(*numbers);
    if (!gap.empty() && !chosen) {
      fail_input(inputs[0].string(), gap, "slices without gaps",
                 "add what is missing, or list the files one by one");
    }
    if (!gap.empty()) slices.notes.push_back(gap);
  }
  return slices;
}

}  // namespace bn
