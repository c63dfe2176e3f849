// A folder for the files of a test program.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace bn::test {

/// Of this process alone; removed at its end.
struct Scratch {
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "bn-render-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path;
};

/// An empty folder in it.
inline std::filesystem::path fresh_folder(const std::string& name) {
  static const Scratch scratch;
  const auto folder = scratch.path / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace bn::test
