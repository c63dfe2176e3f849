#include "ui/items.h"

#include <imgui_internal.h>

#include <algorithm>

namespace bn::ui::items {
namespace {

std::vector<Item> recording, shown;
std::string wanted;  // by scroll_to()

std::string_view readable(std::string_view label) { return label.substr(0, label.find("##")); }

}  // namespace

void next_frame() {
  shown.swap(recording);
  recording.clear();
}

void record(std::string_view label, std::string_view text, bool enabled) {
  record(label, text, ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  recording.back().enabled = enabled;
}

void record(std::string_view label, std::string_view text, ImVec2 min, ImVec2 max) {
  const ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 clip_min = list.GetClipRectMin(), clip_max = list.GetClipRectMax();
  Item item{.name = std::string(readable(label)), .text = std::string(text), .min = min, .max = max};
  item.min = {std::max(min.x, clip_min.x), std::max(min.y, clip_min.y)};
  item.max = {std::min(max.x, clip_max.x), std::min(max.y, clip_max.y)};
  item.visible = item.min.x < item.max.x && item.min.y < item.max.y;
  item.whole = item.visible && item.max.y - item.min.y >= 0.9f * (max.y - min.y);
  if (!wanted.empty() && wanted == item.name) {
    // The windows around its own scroll too.
    if (!item.whole) ImGui::ScrollToBringRectIntoView(ImGui::GetCurrentWindow(), {min, max});
    wanted.clear();
  }
  recording.push_back(std::move(item));
}

const Item* find(std::string_view name) {
  const Item* found = nullptr;
  for (const Item& item : shown) {
    if (item.name == name && (found == nullptr || item.visible || !found->visible)) found = &item;
  }
  return found;
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const Item& item : shown) {
    if (!item.name.empty()) result.push_back(item.name);
  }
  return result;
}

void scroll_to(std::string_view name) { wanted = name; }

}  // namespace bn::ui::items
