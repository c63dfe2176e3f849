// What is on the screen, by name: every widget of ui/widgets.h records where it is and what it says, so that
// a script can click "Start" and expect "Energy" to be 3638.

#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bn::ui {

struct Item {
  std::string name;  ///< the label as the user reads it, without "##..."
  std::string text;  ///< the value it shows; empty for a plain button
  ImVec2 min, max;   ///< the part that can be seen; empty where it is scrolled or clipped away
  bool visible = false;
  bool whole = false;  ///< nothing of its height is scrolled away
  bool enabled = true;
};

/// The items of the frame before; like ImGui's context there is one, for the window's thread only.
namespace items {

/// Call between frames: what was recorded becomes what find() sees.
void next_frame();

/// Records the item that was submitted last (ImGui::GetItemRectMin and so on).
void record(std::string_view label, std::string_view text = {}, bool enabled = true);
/// Records a rectangle that is no ImGui item.
void record(std::string_view label, std::string_view text, ImVec2 min, ImVec2 max);

/// The item with this name; of several, the last drawn, so that a popup goes before what it covers; a visible
/// one before a hidden one. Null: none.
const Item* find(std::string_view name);
/// All names, for a message that says what there is.
std::vector<std::string> names();

/// The next frame scrolls this item into view.
void scroll_to(std::string_view name);

}  // namespace items
}  // namespace bn::ui
