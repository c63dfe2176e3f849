#include "ui/loop.h"

#include <utility>

#include "ui/items.h"
#include "ui/theme.h"

namespace bn::ui {
namespace {

void write_screenshot(const std::filesystem::path& path, Surface& surface) {
  Metadata metadata;
  metadata.algorithm = "screenshot";
  metadata.algorithm_version = 1;
  metadata.kind = "screenshot";
  write_image(path, surface.pixels(), metadata);
}

}  // namespace

ImGuiSession::ImGuiSession() {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
}

ImGuiSession::~ImGuiSession() { ImGui::DestroyContext(); }

void run_loop(App& app, Surface& surface, Script* script) {
  while (!app.quit) {
    if (script != nullptr && !script->before_frame(app)) break;
    const float scale = static_cast<float>(app.scale) * surface.display_scale();
    if (apply_theme(app.dark, scale)) surface.upload_fonts();
    if (!surface.begin_frame(app)) break;
    ImGui::NewFrame();
    app.frame();
    ImGui::Render();
    items::next_frame();
    if (script != nullptr && script->is_random()) app.quit = false;
    surface.draw();
    if (script != nullptr) {
      if (const auto path = script->take_screenshot(); !path.empty()) write_screenshot(path, surface);
    }
    if (!app.screenshot_path.empty()) {
      try {
        write_screenshot(std::exchange(app.screenshot_path, {}), surface);
      } catch (...) {
        app.report_in_flight();
      }
    }
    surface.present();
  }
}

}  // namespace bn::ui
