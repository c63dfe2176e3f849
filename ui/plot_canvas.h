// What the files of Plot share: where everything is while a plot is drawn.

#pragma once

#include <imgui.h>

#include "ui/plot.h"
#include "ui/plot_scale.h"

namespace bn::ui {

struct Canvas {
  ImDrawList& list;
  ImVec2 min, max;  ///< of the area inside the axes
  Scale x, y;

  float place_x(double v) const { return min.x + static_cast<float>(x.share(v)) * (max.x - min.x); }
  float place_y(double v) const { return max.y - static_cast<float>(y.share(v)) * (max.y - min.y); }
  double share_x(float px) const { return (px - min.x) / (max.x - min.x); }
  double share_y(float py) const { return (max.y - py) / (max.y - min.y); }
};

inline ImU32 faded(ImU32 colour, unsigned alpha) {
  return (colour & ~IM_COL32_A_MASK) | alpha << IM_COL32_A_SHIFT;
}

void draw_heat(const Canvas& c, const HeatMap& heat);
/// The scale of its colours, right of the plot.
void draw_colour_bar(const Canvas& c, const HeatMap& heat, float left);

}  // namespace bn::ui
