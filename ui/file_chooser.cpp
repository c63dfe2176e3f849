#include "ui/file_chooser.h"

#include <algorithm>
#include <utility>

#include "bn/texture.h"
#include "ui/texture_file.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxEntries = 5000;

/// `folder` with its "..", without a slash at the end.
fs::path tidy(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(folder, error), error);
  return error ? folder : whole;
}

}  // namespace

void FileChooser::ask(std::string title, Want want, const fs::path& start,
                      std::function<void(const fs::path&)> done) {
  title_ = std::move(title);
  want_ = want;
  done_ = std::move(done);
  opening_ = true;
  std::error_code error;
  const bool folder = start.empty() || fs::is_directory(start, error);
  enter(start.empty() ? fs::current_path(error) : folder ? start : start.parent_path());
  if (!folder) text_ = (folder_ / start.filename()).string();
}

void FileChooser::enter(const fs::path& folder) {
  folder_ = tidy(folder.empty() ? "." : folder);
  text_ = folder_.string();
  list();
}

void FileChooser::list() {
  entries_.clear();
  trouble_.clear();
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const bool folder = entry->is_directory(ignored);
    const std::string name = entry->path().filename().string();
    if (name.starts_with(".") || (want_ == Want::folder && !folder)) continue;
    if (!folder && !has_image_name(entry->path()) && entry->path().extension() != ".toml") continue;
    entries_.push_back({name, folder});
    if (entries_.size() == kMaxEntries) break;
  }
  if (error) trouble_ = folder_.string() + ": " + error.message();
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.folder != b.folder ? a.folder : natural_less(a.name, b.name);
  });
}

void FileChooser::finish(const fs::path& path) {
  ImGui::CloseCurrentPopup();
  if (done_) std::exchange(done_, nullptr)(path);
}

void FileChooser::draw() {
  if (std::exchange(opening_, false)) ImGui::OpenPopup("chooser");
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowSize({std::min(em(46), screen.x * 0.94f), std::min(em(34), screen.y * 0.92f)});
  ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal("chooser", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize))
    return;
  heading(title_.c_str());
  set_label_width(4);
  if (button("Up")) enter(folder_.parent_path());
  ImGui::SameLine();
  field("Path", text_, "Type or choose below; a double click opens");
  if (!trouble_.empty()) value("", trouble_, palette().bad);

  begin_panel("entries", {0, -ImGui::GetFrameHeightWithSpacing() - ImGui::GetStyle().ItemSpacing.y});
  std::string entered, chosen;
  for (const Entry& entry : entries_) {
    const std::string label = entry.folder ? entry.name + "/" : entry.name;
    const bool clicked = selectable(label.c_str(), text_ == (folder_ / entry.name).string());
    if (clicked) text_ = (folder_ / entry.name).string();
    if (clicked && entry.folder) entered = entry.name;
    if (!entry.folder && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) chosen = entry.name;
  }
  if (entries_.empty()) note("Nothing here that this window can open.");
  end_panel();

  const char* yes = want_ == Want::save ? "Save" : want_ == Want::folder ? "Take this folder" : "Open";
  if (main_button(yes, !text_.empty(), want_ == Want::open ? "A folder opens as a stack of slices" : "")) {
    finish(text_);
  } else if (!chosen.empty()) {
    finish(folder_ / chosen);
  }
  ImGui::SameLine();
  if (button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
    ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  set_label_width(8);
  if (!entered.empty()) enter(folder_ / entered);
}

}  // namespace bn::ui
