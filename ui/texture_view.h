// The Texture view: a baked file, an atlas or a stack of slices; what it says of itself, and whether that is
// true.

#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "bn/bake.h"
#include "ui/image_view.h"
#include "ui/move_legend.h"
#include "ui/plot.h"
#include "ui/task.h"
#include "ui/texture_file.h"

namespace bn::ui {

class App;
class Parameters;

class TextureView {
 public:
  /// Reads it in the background.
  void open(const std::filesystem::path& path);
  void draw(App& app);
  void parameters(Parameters& p);
  bool playing() const { return playing_; }
  bool busy() const {
    return playing_ || loading_.running() || cutting_.running() || analysing_.running() ||
           verifying_.running() || picture_.busy() || spectrum_.busy();
  }

 private:
  /// Takes up results of the tasks; starts what the settings ask for.
  void update(App& app);
  void update_picture();
  void update_analysis();
  void take_spectrum();
  void take(std::shared_ptr<const TextureFile> texture);

  void draw_picture(ImVec2 size);
  void draw_section_controls();
  void draw_pixel_controls();
  void draw_channel_buttons();
  void draw_spectrum(ImVec2 size);
  /// "of channel R" where there are several; else empty.
  std::string channel_text() const;
  // In texture_moves.cpp.
  void draw_motion_controls();
  void draw_moves(ImVec2 size);
  // In texture_facts.cpp.
  void draw_facts(App& app);
  void draw_verdict();
  void draw_metadata();
  void draw_tile_record();
  void draw_figures();

  // What the user has set.
  std::filesystem::path path_;
  Section section_;  ///< index: the slice, or the row of an XZ cut
  int slice_ = 0, row_ = 0;
  bool whole_stack_ = true;  ///< the spectrum of all slices, else of the one that is shown
  int thresholds_ = 0;       ///< index into kThresholds
  int frames_per_second_ = 12;

  std::shared_ptr<const TextureFile> texture_;
  std::filesystem::path opened_;  ///< the path that was last tried
  bool fresh_ = false;            ///< opened by the user: its settings begin anew, not a session's
  Section shown_;                 ///< that picture_ is of, or soon will be
  bool stale_ = true;
  bool playing_ = false;
  double since_slice_s_ = 0.0;
  std::string go_to_;  ///< "x, y", as the user writes it
  bool go_to_refused_ = false;

  struct AnalysisKey {
    AtlasCut cut;
    int channel = -1, index = -2;
    friend bool operator==(const AnalysisKey&, const AnalysisKey&) = default;
  };
  AnalysisKey analysed_;
  std::optional<TextureAnalysis> analysis_;
  std::optional<std::vector<VerifyItem>> verdict_;

  ImageView picture_, spectrum_;
  MoveLegend legend_;
  ViewLink link_, spectrum_link_;
  Plot plot_, energy_map_;
  PlotLink plot_link_, energy_link_;
  Task<std::shared_ptr<const TextureFile>> loading_;
  Task<std::shared_ptr<const Picture>> cutting_;
  Task<TextureAnalysis> analysing_;
  Task<std::vector<VerifyItem>> verifying_;
};

}  // namespace bn::ui
