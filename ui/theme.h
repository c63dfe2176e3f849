// How everything looks: two palettes, one rhythm of distances, one font; all scaled together.

#pragma once

#include <imgui.h>

namespace bn::ui {

/// Colours by meaning. Views take them from here and nowhere else.
struct Palette {
  ImU32 background, panel, frame, line;  ///< from the back to the front
  ImU32 text, dim_text;
  ImU32 accent;           ///< what can be acted on, and what is selected
  ImU32 good, bad, warn;  ///< passed, failed, look here
  ImU32 series[6];        ///< curves; told apart also by those who see few colours (Okabe and Ito 2008)
};

const Palette& palette();
bool is_dark();

/// Sets colours, distances and fonts for `scale` (1: 96 dots an inch). Between frames only. Fonts must be
/// uploaded again afterwards where it returns true.
bool apply_theme(bool dark, float scale);

/// `ems` times the height of the font, in pixels: the unit of all layout.
inline float em(float ems = 1.0f) { return ems * ImGui::GetFontSize(); }

/// Figures in columns, code, hashes.
ImFont* mono_font();
ImFont* heading_font();

}  // namespace bn::ui
