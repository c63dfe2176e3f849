// The Compare view: several runs, their curves in one plot, their pictures against each other.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ui/run_figures.h"
#include "ui/run_pictures.h"
#include "ui/theme.h"

namespace bn::ui {

class App;
class Parameters;

class CompareView {
 public:
  void draw(App& app);
  /// Every value that the user can change here; see ui/parameters.h.
  void parameters(Parameters& p);
  /// Whether something is going on, so that the window must be drawn again without input.
  bool busy() const;
  /// Keeps a run, the newest last; of too many the oldest that has ended goes. The first two become A and B,
  /// then each new one B.
  void add(std::shared_ptr<RunEntry> entry);

 private:
  struct Kept {
    std::shared_ptr<RunEntry> entry;
    int repeat = 0;  ///< the least number that no other run of its schedule has here
    bool shown = true;
    ImU32 colour() const { return schedule_colour(entry->settings.schedule_name(), repeat); }
  };
  /// A picture of one side and what it was made from.
  struct Side {
    int number = 0;  ///< of the run; 0: none
    std::shared_ptr<const Placement> placement;
    int what = -1;
    Picture picture;
  };

  void update(App& app);
  const RunEntry* find(int number) const;
  void remove(int number);
  void draw_table();
  /// Of all runs of its problem, of which there are others, none has less energy.
  bool is_best(const RunEntry& entry) const;
  void draw_row(Kept& kept);
  void draw_plots(ImVec2 size);
  void choose_pair(float width);
  void draw_pictures(ImVec2 size);
  bool refresh(Side& side);
  void start_export(App& app, const std::filesystem::path& folder);

  std::vector<Kept> kept_;
  std::vector<std::shared_ptr<RunEntry>> leaving_;  ///< removed; their threads still end
  int removed_ = 0;                                 ///< the run whose button was clicked in this frame

  int what_ = 0;  ///< 0 permuted, 1 difference, 2 offsets
  int mode_ = 0;  ///< 0 side by side, 1 flip, 2 split
  bool flipped_ = false;
  double split_ = 0.5;
  Side a_, b_;
  ImageView view_a_, view_b_;
  MoveLegend legend_;
  ViewLink link_;
  bool compose_ = true;  ///< the picture of flip or split must be made again

  int over_ = 0;  ///< the curves over 0 proposals, 1 seconds
  Plot energy_plot_, temperature_plot_, acceptance_plot_;
  PlotLink plot_link_;

  std::filesystem::path export_folder_ = "comparison";
  Task<std::string> exporting_;
};

}  // namespace bn::ui
