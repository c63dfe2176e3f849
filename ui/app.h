// The inspector: its views, and what they share.
//
//   Surface (a window, or memory) --input--> App::frame() --ImGui draw lists--> Surface
//
// One thread draws; computations run in tasks of the views and never block it.

#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bn/error.h"
#include "ui/bake_view.h"
#include "ui/compare_view.h"
#include "ui/file_chooser.h"
#include "ui/help.h"
#include "ui/parameters.h"
#include "ui/run_view.h"
#include "ui/texture_view.h"

namespace bn::ui {

enum class Tab { run, compare, texture, bake };

class App {
 public:
  /// `session`: where settings are kept between starts; empty: nowhere. An ImGui context must be current.
  explicit App(std::filesystem::path session = {});

  /// Everything between ImGui::NewFrame() and ImGui::Render().
  void frame();
  /// Something moves by itself: draw again without waiting for input.
  bool busy() const;
  /// Writes the session file. Errors: io.
  void close();

  // For views.
  /// A texture goes to the Texture view, a recipe (.toml) to the Bake view; `folder` of slices too.
  void open(const std::filesystem::path& path);
  void show(Tab tab) { wanted_tab_ = tab; }
  /// What is dropped or chosen: as open(), but an image goes to the Run view while that is shown.
  void take(const std::filesystem::path& path);
  /// Lets the user choose a file or folder, and takes it.
  void ask_open();
  /// Lets the user choose; `done` gets the path, unless they think better of it.
  void ask(std::string title, FileChooser::Want want, const std::filesystem::path& start,
           std::function<void(const std::filesystem::path&)> done);
  /// Puts an error into the panel at the bottom. Call it from the window's thread.
  void report(const Error& error);
  /// The same for the exception in flight, whatever it is; inside a catch block. Cancelled ones are not told.
  void report_in_flight();
  /// A line at the bottom that says what was done.
  void say(std::string text) { status_ = std::move(text); }

  RunView run;
  CompareView compare;
  TextureView texture;
  BakeView bake;

  // For the surface and the script.
  bool dark = true;
  double scale = 1.0;  ///< of everything, chosen by the user, over the display's own
  bool quit = false;
  std::filesystem::path screenshot_path;  ///< set: the main loop writes the frame there, and clears it
  Tab tab() const { return tab_; }
  const std::deque<Error>& errors() const { return errors_; }

 private:
  void parameters(Parameters& p);
  void view_parameters(Parameters& p);  ///< those that can be undone
  Settings undoable();
  /// Goes to `settings`, and to the view in which something changes.
  void go_to(Settings settings);
  void draw_menu();
  void draw_tabs();
  void draw_errors(float height);
  void draw_status();
  void draw_recent();
  void ask_screenshot();
  float foot_height() const;
  void handle_shortcuts();
  void undo();
  void redo();

  std::filesystem::path session_;
  UndoHistory history_;
  Tab tab_ = Tab::run;
  std::optional<Tab> wanted_tab_ = Tab::run;  ///< until the tab bar shows it
  FileChooser chooser_;
  Help help_;
  std::vector<std::filesystem::path> recent_;  ///< what was opened, the last first
  std::deque<Error> errors_;
  std::string status_ = "Drop a texture, a folder of slices or a recipe anywhere.";
};

}  // namespace bn::ui
