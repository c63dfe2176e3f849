// Keys by name, "ctrl+shift+z": one notation for shortcuts, menus and scripts.

#pragma once

#include <imgui.h>

#include <optional>
#include <string_view>

namespace bn::ui {

struct Chord {
  int key = 0;  ///< GLFW's number, with and without a window
  bool ctrl = false, shift = false, alt = false;
};

/// Letters, digits, f1..f12, and enter, escape, tab, space, backspace, delete, left, right, up, down, home,
/// end, pageup, pagedown, with ctrl+, shift+, alt+ before them. None: not a key.
std::optional<Chord> parse_chord(std::string_view text);

/// Whether the chord was pressed in this frame. Chords without ctrl or alt wait while text is typed.
bool shortcut(std::string_view chord);

/// Tells ImGui which of GLFW's numbers are its keys; what GLFW's backend does for a window.
void map_keys(ImGuiIO& io);

}  // namespace bn::ui
