// The Run view: choose an image and a schedule, anneal, watch, save.

#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "bn/error.h"
#include "ui/run_figures.h"
#include "ui/run_pictures.h"

namespace bn::ui {

class App;
class Parameters;

class RunView {
 public:
  void draw(App& app);
  /// Every value that the user can change here; see ui/parameters.h.
  void parameters(Parameters& p);
  /// Whether something is going on, so that the window must be drawn again without input.
  bool busy() const;
  /// An image for the next run.
  void open(const std::filesystem::path& image);

 private:
  struct Saved {
    std::filesystem::path file;
    std::string detail;
  };

  void update(App& app);
  void load_source(App& app);
  void make_plan(App& app);
  void begin_run(App& app);
  void begin_when_ready(App& app);
  /// Whether the run has a best placement that a recipe can make again: after its first round.
  bool can_save() const;
  void save(App& app, const std::filesystem::path& file);
  void ask_save(App& app);
  void handle_shortcuts(App& app);
  void draw_settings(App& app);
  void draw_formula();
  void draw_controls(App& app);
  void draw_standing();
  void draw_plots(ImVec2 size);

  RunSettings settings_;
  int layout_ = 0;  ///< 0 all, 1 plots, 2 pictures
  std::string save_path_ = "tile.png";

  Task<Source> loading_;
  SourceChoice loaded_choice_;
  bool load_failed_ = false;
  std::shared_ptr<const Source> source_;  ///< of the settings as they are; null while it loads
  Task<Plan> planning_;                   ///< off the window's thread: a start temperature may take a trial
  std::string planned_;                   ///< the settings that the plan is of
  std::optional<Plan> plan_;
  std::optional<ErrorInfo> refusal_;  ///< why there is none

  bool start_wanted_ = false, start_paused_ = false;
  int runs_ = 0;
  std::shared_ptr<RunEntry> entry_;
  Phase told_ = Phase::preparing;  ///< what the status line has been told of
  Task<Saved> saving_;

  RunPictures pictures_;
  Plot energy_plot_, temperature_plot_, acceptance_plot_, surface_plot_, spectrum_plot_;
  PlotLink plot_link_, spectrum_link_;
};

}  // namespace bn::ui
