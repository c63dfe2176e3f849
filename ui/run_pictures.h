// What a permutation makes of an image, as pictures that are zoomed together.

#pragma once

#include <memory>
#include <optional>

#include "bn/retarget_anneal.h"
#include "bn/spectrum.h"
#include "ui/image_view.h"
#include "ui/move_legend.h"
#include "ui/plot.h"
#include "ui/run.h"
#include "ui/source.h"
#include "ui/task.h"

namespace bn::ui {

/// The levels that the seeds bring along, at the pixels they land on: at u + R(u) the level of u.
Picture permuted_picture(const Grid<std::int32_t>& levels, const Grid<Offset>& move);
/// The levels that belong there: at v the level of v + d.
Picture target_picture(const Grid<std::int32_t>& levels, Offset step);
/// The size of their difference. White is 1 / `gain` of all levels; 0: a power of two that nearly all is
/// below.
Picture difference_picture(const Grid<std::int32_t>& levels, const Grid<Offset>& move, Offset step, int gain);
/// The length that has the full colour in offset_picture().
double longest_move(const RetargetOptions& options);
/// R(u) - m in the colours of bn/palette.h: the hue says where to, its strength how far; with arrows where
/// there is room for them.
Picture offset_picture(const Grid<Offset>& move, const RetargetOptions& options);

class RunPictures {
 public:
  /// Takes what is to be shown, each frame; nothing happens where it is shown already. `placement` may be
  /// null: the image itself is all there is. Errors: over_limit, bad_alloc.
  void show(std::shared_ptr<const Source> source, const RetargetOptions& options,
            std::shared_ptr<const Placement> placement);
  /// Five pictures, `size` in all; with `ranges` each has the control of its range below.
  void draw(ImVec2 size, bool ranges);
  /// For narrow windows: the pictures take `size`, their controls stand below.
  void draw_controls_last(ImVec2 size);
  Figure spectrum_figure() const;  ///< power by frequency
  bool busy() const;
  void parameters(Parameters& p);
  ViewLink& link() { return link_; }

 private:
  /// What is shown, as one: the options are of the pictures.
  struct Subject {
    std::shared_ptr<const Source> source;
    std::shared_ptr<const Placement> placement;
    RetargetOptions options;
    std::size_t gain = 0;
    bool same_image(const Subject& other) const {
      return source == other.source && options.step == other.options.step &&
             options.motion == other.options.motion;
    }
    bool same(const Subject& other) const {
      return same_image(other) && placement == other.placement && options.radius == other.options.radius &&
             options.reach == other.options.reach && gain == other.gain;
    }
  };
  struct Made {
    Subject of;
    std::shared_ptr<const Picture> permuted, target, difference, offsets;
  };
  /// `target`: of the same image, if it has been made before.
  static Made make(const Subject& subject, std::shared_ptr<const Picture> target);
  struct Transformed {
    Picture picture;
    RadialCurve curve;
  };
  void draw_controls();
  void draw_pictures(ImVec2 size, bool ranges);
  void clear();
  void take_pictures();
  void take_spectrum();

  Subject wanted_, making_, shown_;
  bool too_large_ = false;
  Task<Made> make_;
  ImageView permuted_, target_, difference_, offsets_, spectrum_;
  MoveLegend legend_;
  ViewLink link_, spectrum_link_;
  int spectrum_of_ = 0;  ///< 0 permuted, 1 target, 2 difference
  int gain_ = 0;         ///< index into kGains
  bool spectrum_stale_ = false;
  Task<Transformed> transform_;
  std::optional<RadialCurve> curve_;
};

}  // namespace bn::ui
