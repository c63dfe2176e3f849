// One bake at a time in a folder.

#pragma once

#include <filesystem>

namespace bn::baking {

/// Holds an advisory lock on the folder itself: no lock file, so nothing stale stays behind when a
/// process is killed. Throws io if another process (or another bake of this one) holds it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_;
};

}  // namespace bn::baking
