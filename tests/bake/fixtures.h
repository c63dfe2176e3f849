// Shared by the tests of the bake: a folder that cleans up after itself, bytes of files, a small recipe.

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "bn/bake.h"

namespace bn {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "bn-bake-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  operator const fs::path&() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// The index-th mask, or retarget set, of a recipe that has it.
inline const MaskEntry& mask_of(const Recipe& recipe, std::size_t index) {
  for (const auto& entry : recipe.entries) {
    if (const auto* mask = dynamic_cast<const MaskEntry*>(entry.get()); mask && index-- == 0) return *mask;
  }
  throw std::out_of_range("no such mask");
}
inline const RetargetEntry& set_of(const Recipe& recipe, std::size_t index) {
  for (const auto& entry : recipe.entries) {
    if (const auto* set = dynamic_cast<const RetargetEntry*>(entry.get()); set && index-- == 0) return *set;
  }
  throw std::out_of_range("no such set");
}

/// A mask that is made outside of any recipe.
inline MaskEntry a_mask(const std::string& name, VoidAndClusterOptions options, const fs::path& file) {
  MaskEntry entry;
  entry.name = name;
  entry.void_and_cluster = options;
  entry.outputs = {{.path = file.string()}};
  return entry;
}
/// A retarget set of an image file.
inline RetargetEntry a_set(const std::string& name, const fs::path& image) {
  RetargetEntry entry;
  entry.name = name;
  entry.image = image.string();
  return entry;
}

inline std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Every file below a folder with its bytes; the manifest without its times.
inline std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string bytes = bytes_of(entry.path());
    if (entry.path().filename() == "manifest.json") bytes.erase(bytes.find("\"times\""));
    contents[fs::relative(entry.path(), folder).string()] = std::move(bytes);
  }
  return contents;
}

/// Two masks in every format and two sets; well under a second.
inline constexpr const char* kSmallRecipe = R"(version = 1

[[mask]]
name = "small"
size = [16, 16]
outputs = ["masks/small.png", { path = "masks/small.exr" }, { path = "masks/small16.png", type = "16bit" },
           "masks/small.h", "masks/small.bin", { path = "masks/small.tif", type = "float" }]

[[mask]]
name = "odd"
size = [12, 9]
seed = 7
outputs = ["odd.png"]

[[retarget]]
name = "set"
mask = "small"
radius = 3
motion = 1
outputs = [{ path = "set/tile.png", kind = "tile" }, "set/atlas.png",
           { path = "set/gather.png", form = "gather" },
           { path = "set/right.bin", kind = "tile", motion = [1, 0], form = "gather" }]

[[retarget]]
name = "euclidean"
mask = "odd"
step = [4, 3]
radius = 2
reach = "euclidean"
metric = "l2"
outputs = ["euclidean.png"]
)";

inline Recipe small_recipe() { return parse_recipe(kSmallRecipe, "small.toml", ""); }

/// The failed items, one to a line.
inline std::string failures(const std::vector<VerifyItem>& items) {
  std::string text;
  for (const VerifyItem& item : items) {
    if (!item.pass) text += item.file.string() + ": " + item.check + ": " + item.detail + "\n";
  }
  return text;
}

}  // namespace bn
