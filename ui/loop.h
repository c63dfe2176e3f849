// From input to picture, frame after frame.

#pragma once

#include "ui/app.h"
#include "ui/script.h"
#include "ui/surface.h"

namespace bn::ui {

/// An ImGui context for the time of its life, without files of its own.
class ImGuiSession {
 public:
  ImGuiSession();
  ~ImGuiSession();
  ImGuiSession(const ImGuiSession&) = delete;
  ImGuiSession& operator=(const ImGuiSession&) = delete;
};

/// Draws frames until nothing is being computed: at least one.
void run_until_idle(App& app, Surface& surface);
/// Draws frames until the user leaves or the script ends. Errors: those of the script.
void run_loop(App& app, Surface& surface, Script* script);

}  // namespace bn::ui
