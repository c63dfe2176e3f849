// What a permutation makes of an image, as pictures that are zoomed together.

#pragma once

#include <memory>
#include <optional>

#include "bn/anneal.h"
#include "bn/spectrum.h"
#include "ui/image_view.h"
#include "ui/plot.h"
#include "ui/run.h"
#include "ui/source.h"
#include "ui/task.h"

namespace bn::ui {

/// The levels that the seeds bring along, at the pixels they land on: at u + R(u) the level of u.
Picture permuted_picture(const Grid<std::int32_t>& levels, const Grid<Offset>& move);
/// The levels that belong there: at v the level of v + d.
Picture target_picture(const Grid<std::int32_t>& levels, Offset step);
/// The size of their difference.
Picture difference_picture(const Grid<std::int32_t>& levels, const Grid<Offset>& move, Offset step);
/// R(u) - m as hue (where to) and saturation (how far, of `radius`); with arrows where there is room for
/// them.
Picture offset_picture(const Grid<Offset>& move, const RetargetOptions& options);

class RunPictures {
 public:
  /// Takes what is to be shown; nothing happens where it is shown already. `placement` may be null: the image
  /// itself is all there is.
  void show(std::shared_ptr<const Source> source, const AnnealProblem& problem,
            std::shared_ptr<const Placement> placement);
  /// Five pictures, `size` in all; with `ranges` each has the control of its range below.
  void draw(ImVec2 size, bool ranges);
  Figure spectrum_figure() const;  ///< power by frequency
  bool busy() const { return transform_.running(); }
  void parameters(Parameters& p);
  ViewLink& link() { return link_; }

 private:
  struct Transformed {
    Grid<std::uint8_t> picture;
    RadialCurve curve;
  };
  void take_spectrum();

  std::shared_ptr<const Source> source_;
  std::shared_ptr<const Placement> placement_;
  RetargetOptions options_;
  ImageView permuted_, target_, difference_, offsets_, spectrum_;
  ViewLink link_, spectrum_link_;
  int spectrum_of_ = 0;  ///< 0 permuted, 1 target, 2 difference
  bool spectrum_stale_ = false;
  Task<Transformed> transform_;
  std::optional<RadialCurve> curve_;
};

}  // namespace bn::ui
