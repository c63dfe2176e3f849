// How everything looks: two palettes, one rhythm of distances, one font; all scaled together.

#pragma once

#include <imgui.h>

#include <string_view>

#include "bn/palette.h"

namespace bn::ui {

/// Colours by meaning. Views take them from here and nowhere else.
struct Palette {
  ImU32 background, panel, frame, line;  ///< from the back to the front
  ImU32 text, dim_text;
  ImU32 accent;           ///< what can be acted on, and what is selected
  ImU32 good, bad, warn;  ///< passed, failed, look here
};

const Palette& palette();

/// A colour of bn/palette.h, which the contact sheet, the report and figures share, as ImGui has it.
constexpr ImU32 screen_colour(Rgb8 c) { return IM_COL32(c.red, c.green, c.blue, 255); }
/// The number-th colour of curves; they repeat.
ImU32 curve_colour(int number);
/// The colour of a cooling schedule; of several runs of one schedule the repeat-th is paler.
ImU32 schedule_colour(std::string_view schedule, int repeat = 0);
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
