// Items side by side as long as they fit, then on the next line: what keeps rows whole in narrow windows.

#pragma once

#include <imgui.h>

#include <span>

namespace bn::ui {

/// Puts the next item, `width` wide, beside the last one if there is room for it.
inline void flow(float width, float gap = ImGui::GetStyle().ItemSpacing.x) {
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  if (ImGui::GetItemRectMax().x + gap + width <= right) ImGui::SameLine(0, gap);
}

inline float button_width(const char* label) {
  return ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x;
}

inline float choice_width(const char* label, std::span<const char* const> words) {
  const float text = ImGui::CalcTextSize(label, nullptr, true).x;
  float width = text > 0 ? text + ImGui::GetStyle().ItemSpacing.x : 0.0f;
  for (const char* word : words) width += button_width(word) + 1.0f;
  return width;
}

}  // namespace bn::ui
