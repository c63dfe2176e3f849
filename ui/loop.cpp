#include "ui/loop.h"

#include <utility>

#include "ui/items.h"
#include "ui/theme.h"

namespace bn::ui {

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
    surface.end_frame(app);
    if (app.screenshot_path.empty()) continue;
    try {
      Metadata metadata;
      metadata.algorithm = "screenshot";
      metadata.algorithm_version = 1;
      metadata.kind = "screenshot";
      write_image(std::exchange(app.screenshot_path, {}), surface.pixels(), metadata);
    } catch (const Error& error) {
      if (script != nullptr) throw;
      app.report(error);
    }
  }
}

}  // namespace bn::ui
