// What the Texture view shows of retarget tiles in place of spectra: a legend of the moves' hues, and of an
// atlas the energy of each motion.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/run_pictures.h"
#include "ui/texture_view.h"
#include "ui/widgets.h"

namespace bn::ui {

void TextureView::draw_motion_controls() {
  const int range = motion_range(*texture_);
  const int side = 2 * range + 1;
  int x = slice_ % side - range, y = slice_ / side - range;
  const bool moved = slider("Motion x", x, -range, range, "The tile for a picture that moves so far right") |
                     slider("Motion y", y, -range, range, "The tile for a picture that moves so far down");
  if (moved) slice_ = (y + range) * side + x + range;
}

void TextureView::draw_moves(ImVec2 size) {
  heading("Moves");
  if (holds_moves(*texture_)) {
    legend_.draw_with_words(em(7), longest_move(move_options(*texture_, slice_)));
    note("The hue is where a seed goes, beyond the motion; grey: nowhere.");
  } else {
    note("Of moves in other samples than bytes the channels are shown.");
  }
  const int range = motion_range(*texture_);
  if (range < 1) return;
  const auto& tiles = texture_->metadata->tiles;
  const int side = 2 * range + 1;
  HeatMap heat{.columns = side,
               .x = {-range - 0.5, range + 0.5},
               .rows = {},
               .values = {},
               .colours = {},
               .marked = {{slice_ % side, side - 1 - slice_ / side}}};
  Interval& colours = heat.colours = {1e300, -1e300};
  for (int row = 0; row < side; ++row) {  // from the bottom: the greatest motion down
    heat.rows.push_back(fmt::format("{}", range - row));
    for (int column = 0; column < side; ++column) {
      const TileRecord& tile = tiles[static_cast<std::size_t>((side - 1 - row) * side + column)];
      const auto energy = static_cast<double>(tile.energy);
      heat.values.push_back(energy);
      colours = {std::min(colours.low, energy), std::max(colours.high, energy)};
    }
  }
  if (colours.low == colours.high) colours.high += 1.0;
  heat.describe = [&tiles, side, range](int column, int row) {
    const TileRecord& tile = tiles[static_cast<std::size_t>((side - 1 - row) * side + column)];
    return fmt::format("motion ({}, {})\nenergy {}\n{}\na click shows its tile", column - range, range - row,
                       tile.energy,
                       tile.energy == tile.lower_bound ? std::string("proven optimal")
                                                       : fmt::format("lower bound {}", tile.lower_bound));
  };
  heat.click = [this, side](int column, int row) { slice_ = (side - 1 - row) * side + column; };
  Figure figure{.title = "Energy of each motion", .x = {.name = "motion x (y: down the rows)"}, .y = {}};
  figure.heat = std::move(heat);
  // Square cells, as far as there is room.
  const float high = std::min(size.x * 0.9f, size.y - em(16));
  energy_map_.draw("Energy map", figure, {size.x, std::max(em(12), high)}, energy_link_);
}

}  // namespace bn::ui
