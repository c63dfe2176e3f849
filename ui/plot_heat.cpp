// Heat maps: coloured cells, those without a value hatched.

#include <cmath>

#include "ui/plot_canvas.h"
#include "ui/theme.h"

namespace bn::ui {
namespace {

ImU32 heat_colour(double share) { return screen_colour(scale_colour(share)); }

/// Slanting lines, that go on from cell to cell: no value, which no colour of the scale says.
void hatch(const Canvas& c, ImVec2 low, ImVec2 high) {
  const float step = em(0.5f);
  c.list.PushClipRect(low, high, true);
  for (float at = std::floor((low.x + low.y) / step) * step; at < high.x + high.y; at += step)
    c.list.AddLine({at - high.y, high.y}, {at - low.y, low.y}, faded(palette().dim_text, 90));
  c.list.PopClipRect();
}

}  // namespace

void draw_heat(const Canvas& c, const HeatMap& heat) {
  const Scale colour(heat.logarithmic, heat.colours);
  const double width = (heat.x.high - heat.x.low) / std::max(1, heat.columns);
  for (int row = 0; row < static_cast<int>(heat.rows.size()); ++row) {
    for (int column = 0; column < heat.columns; ++column) {
      const double value = heat.values[static_cast<std::size_t>(row * heat.columns + column)];
      if (std::isnan(value)) {
        hatch(c, {c.place_x(heat.x.low + column * width), c.place_y(row + 0.5)},
              {c.place_x(heat.x.low + (column + 1) * width), c.place_y(row - 0.5)});
        continue;
      }
      const double share = heat.logarithmic && value <= 0.0 ? 0.0 : colour.share(value);
      c.list.AddRectFilled({c.place_x(heat.x.low + column * width), c.place_y(row + 0.5)},
                           {c.place_x(heat.x.low + (column + 1) * width), c.place_y(row - 0.5)},
                           heat_colour(share));
    }
  }
  if (!heat.marked) return;
  const auto [column, row] = *heat.marked;
  c.list.AddRect({c.place_x(heat.x.low + column * width), c.place_y(row + 0.5)},
                 {c.place_x(heat.x.low + (column + 1) * width), c.place_y(row - 0.5)}, IM_COL32_WHITE, 0, 0,
                 2.0f);
}

void draw_colour_bar(const Canvas& c, const HeatMap& heat, float left) {
  constexpr int kSteps = 24;
  const Scale colour(heat.logarithmic, heat.colours);
  const float height = c.max.y - c.min.y, text = ImGui::GetTextLineHeight();
  for (int i = 0; i < kSteps; ++i) {
    const float low = c.max.y - height * static_cast<float>(i) / kSteps;
    c.list.AddRectFilled({left, low - height / kSteps}, {left + em(0.6f), low},
                         heat_colour((i + 0.5) / kSteps));
  }
  for (const double share : {0.0, 0.5, 1.0}) {
    const float at = c.max.y - height * static_cast<float>(share);
    const float y = std::clamp(at - 0.5f * text, c.min.y - 0.2f * text, c.max.y - 0.9f * text);
    c.list.AddText({left + em(0.8f), y}, palette().dim_text,
                   ((share == 0.0 && heat.logarithmic ? "≤ " : "") +
                    short_number(colour.value(share), heat.logarithmic ? 2 : 5))
                       .c_str());
  }
}

}  // namespace bn::ui
