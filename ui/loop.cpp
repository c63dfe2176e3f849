#include "ui/loop.h"

#include <chrono>
#include <thread>
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

/// False: the user wants to leave.
bool draw_frame(App& app, Surface& surface) {
  const float scale = static_cast<float>(app.scale) * surface.display_scale();
  if (apply_theme(app.dark, scale)) surface.upload_fonts();
  if (!surface.begin_frame(app)) return false;
  ImGui::NewFrame();
  app.frame();
  ImGui::Render();
  items::next_frame();
  surface.draw();
  return true;
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

void run_until_idle(App& app, Surface& surface) {
  // What one frame has found out, the next one acts on.
  constexpr int kQuietFrames = 4;
  for (int quiet = 0; quiet < kQuietFrames; quiet = app.busy() ? 0 : quiet + 1) {
    if (!draw_frame(app, surface)) return;
    surface.present();
    if (app.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void run_loop(App& app, Surface& surface, Script* script) {
  while (!app.quit) {
    if (script != nullptr && !script->before_frame(app)) break;
    if (!draw_frame(app, surface)) break;
    if (script != nullptr) {
      if (script->is_random()) app.quit = false;
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
