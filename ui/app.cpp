#include "ui/app.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <utility>

#include "ui/keys.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

constexpr std::pair<Tab, const char*> kTabs[] = {
    {Tab::run, "Run"}, {Tab::compare, "Compare"}, {Tab::texture, "Texture"}, {Tab::bake, "Bake"}};
constexpr std::size_t kMaxErrors = 50;

}  // namespace

App::App(std::filesystem::path session) : session_(std::move(session)) {
  if (!session_.empty()) restore(read_session(session_));
}

void App::parameters(Parameters& p) {
  p("dark", dark);
  p("scale", scale, 0.5, 4.0);
  int tab = static_cast<int>(wanted_tab_.value_or(tab_));
  p("tab", tab, 0, static_cast<int>(std::size(kTabs)) - 1);
  if (p.loading()) show(static_cast<Tab>(tab));
  run.parameters(p);
  compare.parameters(p);
  texture.parameters(p);
  bake.parameters(p);
}

Settings App::settings() {
  Settings settings;
  Parameters saving = Parameters::saving(settings);
  parameters(saving);
  return settings;
}

void App::restore(Settings settings) {
  Parameters loading = Parameters::loading(settings);
  parameters(loading);
}

void App::undo() {
  if (history_.can_undo()) restore(history_.undo());
}

void App::redo() {
  if (history_.can_redo()) restore(history_.redo());
}

void App::close() {
  if (session_.empty()) return;
  try {
    write_session(session_, settings());
  } catch (const Error& error) {
    report(error);
  }
}

bool App::busy() const { return run.busy() || compare.busy() || texture.busy() || bake.busy(); }

void App::open(const std::filesystem::path& path) {
  if (path.extension() == ".toml") {
    show(Tab::bake);
    return;
  }
  show(Tab::texture);
  texture.open(*this, path);
}

void App::report(const Error& error) {
  if (error.code() == ErrorCode::cancelled) return;
  errors_.emplace_back(error.what());
  if (errors_.size() > kMaxErrors) errors_.pop_front();
}

void App::report_in_flight() {
  try {
    throw;
  } catch (const Error& error) {
    report(error);
  } catch (const std::bad_alloc&) {
    report(Error({.code = ErrorCode::over_limit,
                  .what = "out of memory",
                  .where = "",
                  .limit = "",
                  .remedy = "ask for less"}));
  } catch (const std::exception& defect) {
    report(Error({.code = ErrorCode::io, .what = defect.what(), .where = "", .limit = "", .remedy = ""}));
  }
}

void App::frame() {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport.WorkPos);
  ImGui::SetNextWindowSize(viewport.WorkSize);
  ImGui::Begin("bn inspector", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_MenuBar);
  handle_shortcuts();
  draw_menu();
  draw_tabs();
  draw_status();
  ImGui::End();
  if (!ImGui::IsAnyItemActive()) history_.note(settings());
}

void App::handle_shortcuts() {
  for (int i = 0; i < 4; ++i) {
    if (shortcut(fmt::format("ctrl+{}", i + 1))) show(kTabs[i].first);
  }
  if (shortcut("ctrl+z")) undo();
  if (shortcut("ctrl+y") || shortcut("ctrl+shift+z")) redo();
  if (shortcut("ctrl+q")) quit = true;
  if (shortcut("ctrl+d")) dark = !dark;
  if (shortcut("ctrl+plus")) scale = std::min(4.0, scale * 1.25);
  if (shortcut("ctrl+minus")) scale = std::max(0.5, scale / 1.25);
  if (shortcut("ctrl+0")) scale = 1.0;
}

void App::draw_menu() {
  if (!ImGui::BeginMenuBar()) return;
  if (begin_menu("File")) {
    if (menu_item("Quit", "Ctrl+Q")) quit = true;
    ImGui::EndMenu();
  }
  if (begin_menu("Edit")) {
    if (menu_item("Undo", "Ctrl+Z", false, history_.can_undo())) undo();
    if (menu_item("Redo", "Ctrl+Y", false, history_.can_redo())) redo();
    ImGui::EndMenu();
  }
  if (begin_menu("View")) {
    if (menu_item("Dark", "Ctrl+D", dark)) dark = !dark;
    if (menu_item("Larger", "Ctrl++")) scale = std::min(4.0, scale * 1.25);
    if (menu_item("Smaller", "Ctrl+-")) scale = std::max(0.5, scale / 1.25);
    if (menu_item("Normal size", "Ctrl+0")) scale = 1.0;
    ImGui::EndMenu();
  }
  ImGui::EndMenuBar();
}

void App::draw_tabs() {
  const float foot = ImGui::GetFrameHeightWithSpacing() * (errors_.empty() ? 1.0f : 3.0f);
  if (!ImGui::BeginTabBar("tabs")) return;
  for (const auto& [tab, name] : kTabs) {
    if (!begin_tab(name, wanted_tab_ == tab)) continue;
    tab_ = tab;
    if (wanted_tab_ == tab) wanted_tab_.reset();
    ImGui::BeginChild(name, {0, -foot});
    switch (tab) {
      case Tab::run:
        run.draw(*this);
        break;
      case Tab::compare:
        compare.draw(*this);
        break;
      case Tab::texture:
        texture.draw(*this);
        break;
      case Tab::bake:
        bake.draw(*this);
        break;
    }
    ImGui::EndChild();
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

void App::draw_status() {
  if (!errors_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().bad);
    ImGui::TextWrapped("%s", errors_.back().c_str());
    ImGui::PopStyleColor();
    items::record("Error", errors_.back());
    ImGui::SameLine();
    if (button("Dismiss")) errors_.clear();
  }
  note(status_);
}

}  // namespace bn::ui
