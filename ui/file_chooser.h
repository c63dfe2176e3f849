// A dialog in which a file or a folder is chosen. The desktop's own would need one more library a desktop.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace bn::ui {

class FileChooser {
 public:
  enum class Want {
    open,  ///< a texture, a recipe, or a folder of slices
    save,  ///< a name that may be new
    folder,
  };
  /// `start`: a folder, or a file in it whose name is offered.
  void ask(std::string title, Want want, const std::filesystem::path& start,
           std::function<void(const std::filesystem::path&)> done);
  void draw();

 private:
  void enter(const std::filesystem::path& folder);
  void list();
  void finish(const std::filesystem::path& path);

  struct Entry {
    std::string name;
    bool folder;
  };
  std::string title_;
  Want want_ = Want::open;
  std::function<void(const std::filesystem::path&)> done_;
  std::filesystem::path folder_;
  std::string text_;  ///< the path that is typed
  std::string trouble_;
  std::vector<Entry> entries_;
  bool opening_ = false;
};

}  // namespace bn::ui
