#include "ui/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bn/error.h"
#include "tools/failure.h"
#include "ui/keys.h"
#include "ui/texture_file.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

constexpr std::pair<Tab, const char*> kTabs[] = {
    {Tab::run, "Run"}, {Tab::compare, "Compare"}, {Tab::texture, "Texture"}, {Tab::bake, "Bake"}};
constexpr std::size_t kMaxErrors = 50, kMostRecent = 8;
constexpr double kMinScale = 0.5, kMaxScale = 4.0;

}  // namespace

App::App(std::filesystem::path session) : session_(std::move(session)) {
  if (session_.empty()) return;
  Settings settings = read_session(session_);
  Parameters loading = Parameters::loading(settings);
  parameters(loading);
  try {
    close();
  } catch (...) {
    // Better known now than at the end.
    report_in_flight();
    session_.clear();
    say("What is set now will not be kept for the next session.");
  }
}

void App::parameters(Parameters& p) {
  p("dark", dark);
  p("scale", scale, kMinScale, kMaxScale);
  int tab = static_cast<int>(wanted_tab_.value_or(tab_));
  p("tab", tab, 0, static_cast<int>(std::size(kTabs)) - 1);
  if (p.loading()) show(static_cast<Tab>(tab));
  for (std::size_t i = 0; i < kMostRecent; ++i) {
    std::filesystem::path path = i < recent_.size() ? recent_[i] : std::filesystem::path();
    p(fmt::format("recent.{}", i).c_str(), path);
    if (p.loading() && !path.empty() && i == recent_.size()) recent_.push_back(path);
  }
  view_parameters(p);
}

void App::view_parameters(Parameters& p) {
  run.parameters(p);
  compare.parameters(p);
  texture.parameters(p);
  bake.parameters(p);
}

Settings App::undoable() {
  Settings settings;
  Parameters saving = Parameters::saving(settings);
  view_parameters(saving);
  return settings;
}

void App::go_to(Settings settings) {
  for (const auto& [name, value] : undoable()) {
    const auto wanted = settings.find(name);
    if (wanted == settings.end() || wanted->second == value) continue;
    if (name.starts_with("run.")) show(Tab::run);
    if (name.starts_with("compare.")) show(Tab::compare);
    if (name.starts_with("texture.")) show(Tab::texture);
    if (name.starts_with("bake.")) show(Tab::bake);
  }
  Parameters loading = Parameters::loading(settings);
  view_parameters(loading);
}

void App::undo() {
  if (history_.can_undo()) go_to(history_.undo());
}

void App::redo() {
  if (history_.can_redo()) go_to(history_.redo());
}

void App::close() {
  if (session_.empty()) return;
  Settings settings;
  Parameters saving = Parameters::saving(settings);
  parameters(saving);
  write_session(session_, settings);
}

bool App::busy() const {
  if (wanted_tab_ && *wanted_tab_ != tab_) return true;
  // What a view has begun goes on only while it is drawn.
  switch (tab_) {
    case Tab::run:
      return run.busy();
    case Tab::compare:
      return compare.busy();
    case Tab::texture:
      return texture.busy();
    case Tab::bake:
      return bake.busy();
  }
  return false;
}

void App::open(const std::filesystem::path& path) {
  // From here on folders may change, so the path is made whole.
  std::error_code error;
  std::filesystem::path whole = std::filesystem::absolute(path, error);
  if (error) whole = path;
  std::erase(recent_, whole);
  recent_.insert(recent_.begin(), whole);
  if (recent_.size() > kMostRecent) recent_.pop_back();
  if (whole.extension() == ".toml") {
    show(Tab::bake);
    bake.open(whole);
  } else {
    show(Tab::texture);
    texture.open(whole);
  }
}

void App::take(const std::filesystem::path& path) {
  if (tab_ == Tab::run && has_image_name(path)) return run.open(path);
  open(path);
}

void App::ask(std::string title, FileChooser::Want want, const std::filesystem::path& start,
              std::function<void(const std::filesystem::path&)> done) {
  chooser_.ask(std::move(title), want, start, std::move(done));
}

void App::ask_open() {
  ask("Open a texture, a folder of slices or a recipe", FileChooser::Want::open, {},
      [this](const std::filesystem::path& path) { take(path); });
}

void App::report(const Error& error) {
  if (error.code() == ErrorCode::cancelled) return;
  errors_.push_back(error);
  if (errors_.size() > kMaxErrors) errors_.pop_front();
}

void App::report_in_flight() { report(tools::error_in_flight("bn-inspector")); }

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
  chooser_.draw();
  help_.draw();
  ImGui::End();
  if (!ImGui::IsAnyItemActive() && !texture.playing()) history_.note(undoable());
}

void App::handle_shortcuts() {
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) return;
  for (int i = 0; i < static_cast<int>(std::size(kTabs)); ++i) {
    if (shortcut(fmt::format("ctrl+{}", i + 1))) show(kTabs[i].first);
  }
  if (shortcut("ctrl+o")) ask_open();
  if (shortcut("ctrl+z")) undo();
  if (shortcut("ctrl+y") || shortcut("ctrl+shift+z")) redo();
  if (shortcut("ctrl+d")) dark = !dark;
  if (shortcut("ctrl+plus") || shortcut("ctrl+shift+plus")) scale = std::min(kMaxScale, scale * 1.25);
  if (shortcut("ctrl+minus")) scale = std::max(kMinScale, scale / 1.25);
  if (shortcut("ctrl+0")) scale = 1.0;
  if (shortcut("f12")) ask_screenshot();
  if (shortcut("f1")) help_.open(Help::Page::keys);
  if (shortcut("ctrl+q")) quit = true;
}

void App::ask_screenshot() {
  ask("Save a picture of the window", FileChooser::Want::save, "bn-inspector.png",
      [this](const std::filesystem::path& path) { screenshot_path = path; });
}

void App::draw_recent() {
  if (!ImGui::BeginMenu("Open again", !recent_.empty()))
    return items::record("Open again", {}, !recent_.empty());
  for (const std::filesystem::path& path : std::vector(recent_)) {
    if (menu_item(path.string().c_str())) take(path);
  }
  ImGui::EndMenu();
}

void App::draw_menu() {
  if (!ImGui::BeginMenuBar()) return;
  if (begin_menu("File")) {
    if (menu_item("Open …", "Ctrl+O")) ask_open();
    draw_recent();
    if (menu_item("Save a picture of the window …", "F12")) ask_screenshot();
    ImGui::Separator();
    if (menu_item("Quit", "Ctrl+Q")) quit = true;
    ImGui::EndMenu();
  }
  if (begin_menu("Edit")) {
    if (menu_item("Undo", "Ctrl+Z", false, history_.can_undo())) undo();
    if (menu_item("Redo", "Ctrl+Y", false, history_.can_redo())) redo();
    ImGui::EndMenu();
  }
  if (begin_menu("View")) {
    for (int i = 0; i < static_cast<int>(std::size(kTabs)); ++i) {
      const auto& [tab, name] = kTabs[i];
      if (ImGui::MenuItem(name, fmt::format("Ctrl+{}", i + 1).c_str(), tab_ == tab)) show(tab);
      items::record(fmt::format("View: {}", name), tab_ == tab ? "on" : "off");
    }
    ImGui::Separator();
    if (menu_item("Dark", "Ctrl+D", dark)) dark = !dark;
    ImGui::Separator();
    if (menu_item("Larger", "Ctrl++")) scale = std::min(kMaxScale, scale * 1.25);
    if (menu_item("Smaller", "Ctrl+-")) scale = std::max(kMinScale, scale / 1.25);
    if (menu_item("Normal size", "Ctrl+0")) scale = 1.0;
    ImGui::EndMenu();
  }
  if (begin_menu("Help")) {
    if (menu_item("Keys", "F1")) help_.open(Help::Page::keys);
    if (menu_item("About and documentation")) help_.open(Help::Page::about);
    ImGui::EndMenu();
  }
  ImGui::EndMenuBar();
}

float App::foot_height() const {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float status = ImGui::GetTextLineHeight() + style.ItemSpacing.y;
  return errors_.empty() ? status : status + em(5.5f) + style.ItemSpacing.y;
}

void App::draw_tabs() {
  if (!ImGui::BeginTabBar("tabs")) return;
  for (const auto& [tab, name] : kTabs) {
    if (!begin_tab(name, wanted_tab_ == tab)) continue;
    tab_ = tab;
    if (wanted_tab_ == tab) wanted_tab_.reset();
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0, 0, 0, 0));
    ImGui::BeginChild(name, {0, -foot_height()});
    ImGui::PopStyleColor();
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

void App::draw_errors(float height) {
  begin_panel("errors", {0, height});
  if (button("Dismiss")) errors_.clear();
  if (!errors_.empty()) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().bad);
    ImGui::TextUnformatted(
        errors_.size() == 1 ? "An error" : fmt::format("{} errors, the last first", errors_.size()).c_str());
    ImGui::PopStyleColor();
  }
  for (auto error = errors_.rbegin(); error != errors_.rend(); ++error) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(error->what());
    ImGui::PopTextWrapPos();
    if (error == errors_.rbegin()) items::record("Error", error->what());
  }
  end_panel();
}

void App::draw_status() {
  if (!errors_.empty()) draw_errors(em(5.5f));
  note(status_);
  items::record("Status", status_);
}

}  // namespace bn::ui
