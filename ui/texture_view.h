// The Texture view: a baked file, or a stack of slices; what it says of itself, and whether that is true.

#pragma once

#include <filesystem>

#include "ui/image_view.h"

namespace bn::ui {

class App;
class Parameters;

class TextureView {
 public:
  void open(App& app, const std::filesystem::path& path);
  void draw(App& app);
  void parameters(Parameters& p);
  bool busy() const { return false; }

 private:
  std::filesystem::path path_;
  ImageView view_;
  ViewLink link_;
};

}  // namespace bn::ui
