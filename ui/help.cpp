#include "ui/help.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "bn/version.h"
#include "ui/keys.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

using Keys = std::pair<const char*, const char*>;

constexpr Keys kEverywhere[] = {{"Ctrl+1 … Ctrl+4", "Run, Compare, Texture, Bake"},
                                {"Ctrl+O", "open a texture, a folder, a recipe"},
                                {"Ctrl+Z, Ctrl+Y", "undo, redo a change of settings"},
                                {"Ctrl+D", "dark or light"},
                                {"Ctrl++, Ctrl+-, Ctrl+0", "larger, smaller, normal size"},
                                {"F12", "save a picture of the window"},
                                {"F1", "these keys"},
                                {"Ctrl+Q", "quit"},
                                {"Ctrl+click", "on a slider: type its value"},
                                {"Tab, Shift+Tab", "to the next widget, the one before"}};
constexpr Keys kRun[] = {{"Space", "start, pause, go on"},
                         {"S", "one sweep"},
                         {"Ctrl+S", "save the texture of the run"},
                         {"X", "Compare, Flip: change over"}};
constexpr Keys kPictures[] = {{"Wheel, drag", "zoom, move"},
                              {"F, double click", "fit"},
                              {"1", "one texel to a pixel"},
                              {"Space", "Texture: play the slices"},
                              {"Ctrl+click", "on a channel: add it, take it away"}};
constexpr Keys kPlots[] = {{"Wheel", "zoom; with Shift along x only, with Ctrl along y"},
                           {"Drag", "move"},
                           {"Drag, right button", "zoom to a box"},
                           {"Double click", "fit"},
                           {"Click in the legend", "hide or show a curve"}};

void draw_group(const char* title, std::span<const Keys> keys) {
  heading(title);
  for (const auto& [key, what] : keys) value(key, what);
}

void draw_keys() {
  set_label_width(11);
  const bool wide = ImGui::GetContentRegionAvail().x > em(52);
  if (ImGui::BeginTable("keys", wide ? 2 : 1, ImGuiTableFlags_SizingStretchSame)) {
    ImGui::TableNextColumn();
    draw_group("Everywhere", kEverywhere);
    draw_group("Run and Compare", kRun);
    ImGui::TableNextColumn();
    draw_group("Pictures", kPictures);
    draw_group("Plots", kPlots);
    ImGui::EndTable();
  }
  set_label_width(8);
}

void draw_about() {
  heading("bn inspector");
  const std::string version =
      fmt::format("Version {} of libbn: blue noise for renderers, with proof.", kVersion);
  ImGui::TextWrapped("%s", version.c_str());
  items::record("About", version);
  ImGui::Spacing();
  const char* place = "docs/inspector.md in libbn's source folder; README.md there names all pages.";
  value("Documentation", place);
  value("Command line", "bn-inspector --help, bn help");
  value("Licence", "Apache-2.0; the textures CC0");
}

}  // namespace

void Help::draw() {
  if (wanted_ != Page::none) {
    shown_ = std::exchange(wanted_, Page::none);
    ImGui::OpenPopup("help");
  }
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float width = std::min(em(shown_ == Page::keys ? 66.0f : 36.0f), viewport.Size.x * 0.94f);
  ImGui::SetNextWindowPos(viewport.GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, viewport.Size.y * 0.94f});
  if (!ImGui::BeginPopupModal("help", nullptr,
                              ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize))
    return;
  shown_ == Page::keys ? draw_keys() : draw_about();
  const bool beside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) &&
                      !ImGui::IsWindowAppearing();
  ImGui::Spacing();
  if (button("Close") || shortcut("escape") || (shortcut("f1") && !ImGui::IsWindowAppearing()) || beside)
    ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace bn::ui
