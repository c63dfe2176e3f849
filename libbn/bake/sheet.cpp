// Composition: a section for each retarget set, a row for each spatiotemporal mask, then the masks that no
// set uses.
//
//   name and figures
//   [ mask D     ] [ its spectrum ] [ |D(u)-D(u+d)| ] [ |D(u)-D(u+R+d)| ]  [         ]
//   [ R as hues  ] [ R as arrows  ] [ energy of every motion            ]  [  atlas  ]
//
// A stack: slice 0, its spectrum, a row of pixels over time, the spectrum in x and time. Up to four masks
// have a row each: mask, spectrum, thresholds. More stand in a grid, mask and spectrum side by side. Textures
// are enlarged by whole numbers, nearest pixel; one too large for its panel shows its upper left corner (a
// tile) or every k-th pixel (an atlas), and the caption says so. What is a colour has a bar or a disc with
// numbers.

#include "bake/sheet.h"

#include <fmt/format.h>

#include <algorithm>

#include "bake/canvas.h"
#include "bake/label_font.h"
#include "bake/sheet_spectrum.h"

namespace bn::baking {
namespace {

constexpr int kMargin = 56, kGap = 40;
constexpr int kPanel = 256;
constexpr int kCaption = 92;  // below a panel: two lines, a bar and air
constexpr int kAtlas = 2 * kPanel + kCaption;
constexpr int kHeader = 84;   // above the panels of a section
constexpr int kBetween = 40;  // between sections
constexpr int kColumns = 4;
constexpr int kWidth = 2 * kMargin + kColumns * (kPanel + kGap) - kGap;
constexpr int kWidthWithAtlas = kWidth + kGap + kAtlas;
constexpr int kBothRows = kHeader + 2 * (kPanel + kCaption), kOneRow = kHeader + kPanel + kCaption;
constexpr int kMostRows = 4;  // masks with a row of their own
constexpr int kSmall = 128, kCell = 2 * kSmall + 8,
              kCellGap = 29;  // four cells in a narrow sheet, six in a wide one
constexpr int kCellHeight = 36 + kSmall + 68;
constexpr int kDisc = 56;

constexpr Colour kBackground{22, 24, 28}, kEmpty{30, 33, 38};
constexpr Colour kTitle{245, 245, 240}, kText{214, 217, 222}, kFaint{139, 146, 156}, kRule{52, 56, 63};

constexpr int kResidualGain = 16;  // what is left after retargeting is too dark to see otherwise

Colour grey(double share) {
  const auto value = static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
  return {value, value, value};
}

std::string energy_text(std::int64_t energy, double pixels) {
  return fmt::format("E {}, mean {:.2f}", energy, static_cast<double>(energy) / pixels);
}

double percent_of_start(const TileRecord& tile) {
  return 100.0 * static_cast<double>(tile.energy) /
         static_cast<double>(std::max<std::int64_t>(tile.start_energy, 1));
}

template <class Map>
Grid<Colour> coloured(Extent size, Map map) {
  Grid<Colour> result(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) result(x, y) = map(x, y);
  }
  return result;
}

Grid<Colour> cropped(const Grid<Colour>& picture, int side) {
  const Extent size{std::min(picture.width(), side), std::min(picture.height(), side)};
  return coloured(size, [&](int x, int y) { return picture(x, y); });
}

/// Levels from black to white.
struct GreyLevels {
  const Grid<std::int32_t>& levels;
  int low;
  double span;
  explicit GreyLevels(const Grid<std::int32_t>& of) : levels(of) {
    const auto [least, most] = std::minmax_element(of.begin(), of.end());
    low = *least;
    span = std::max<double>(*most - *least, 1.0);
  }
  double share(int x, int y) const { return (levels(x, y) - low) / span; }
  Grid<Colour> picture() const {
    return coloured(levels.size(), [&](int x, int y) { return grey(share(x, y)); });
  }
};

Grid<Colour> residual(const SheetSet& set, const Grid<Offset>& move, double gain) {
  const Grid<std::int32_t>& levels = set.levels;
  const Offset step = set.step;
  return coloured(levels.size(), [&](int x, int y) {
    const Offset r = move(x, y);
    const std::int32_t there = set.to.torus(std::int64_t{x} + r.x + step.x, std::int64_t{y} + r.y + step.y);
    return scale_colour(std::abs(levels(x, y) - there) * gain);
  });
}

class Sheet {
 public:
  explicit Sheet(Extent size) : canvas_(size, kBackground) {}

  Image image() const { return canvas_.image(); }

  void set(const SheetSet& set) {
    header(set.name, set.about);
    const GreyLevels levels(set.levels);
    const double pixels = static_cast<double>(set.levels.count());
    panel(0, 0, "source D", set.source, levels.picture());
    spectrum(1, 0, set.levels);
    const char* next = set.to == set.levels ? "D" : "T";
    panel(2, 0, fmt::format("|D(u)-{}(u+d)|", next), energy_text(set.plain.start_energy, pixels),
          residual(set, Grid<Offset>(set.levels.size()), 1.0 / levels.span));
    bar(2, 0, kPanel, "0", fmt::format("{:.0f} levels", levels.span));
    if (set.tile) {
      panel(3, 0, fmt::format("|D(u)-{}(u+R+d)|", next), energy_text(set.plain.energy, pixels),
            residual(set, *set.tile, kResidualGain / levels.span));
      bar(3, 0, kPanel, "0", fmt::format("{:.3g} levels", levels.span / kResidualGain));
      hues(set);
      arrows(*set.tile, set.radius);
    }
    if (set.motion > 0) heat_map(set);
    if (set.atlas) atlas(*set.atlas, set);
    end_section(kBothRows);
  }

  /// A row: a slice and its spectrum, a row of pixels over time and the spectrum in x and time.
  void stack(const SheetStack& stack) {
    header(stack.name, stack.about);
    Grid<std::int32_t> slice(stack.levels.size());
    std::copy_n(stack.levels.slice(0).begin(), slice.count(), slice.begin());
    panel(0, 0, "slice 0", fmt::format("{} levels", stack.distinct), GreyLevels(slice).picture());
    spectrum(1, 0, slice);
    panel(2, 0, "row 0 over time", fmt::format("{} slices, downwards", stack.levels.depth()),
          GreyLevels(row_in_time(stack.levels, 0)).picture());
    const Grid<std::uint8_t> power = sheet_spectrum_in_time(stack.levels);
    panel(3, 0, "spectrum, x and time", power.count() > 0 ? "-50 dB to 12.5 dB" : "none of this size",
          coloured(power.size(), [&](int x, int y) { return grey(power(x, y) / 255.0); }));
    end_section(kOneRow);
  }

  /// A row: the mask, its spectrum, two thresholds.
  void mask(const SheetMask& mask) {
    header(mask.name, mask.size + ", " + mask.about);
    const GreyLevels levels(mask.levels);
    panel(0, 0, "mask", fmt::format("{} levels", mask.distinct), levels.picture());
    spectrum(1, 0, mask.levels);
    int column = 2;
    for (const int part : {2, 8}) {
      panel(column++, 0, fmt::format("below 1/{}", part), "", coloured(mask.levels.size(), [&](int x, int y) {
              return grey(levels.share(x, y) * part < 1.0 ? 1.0 : 0.06);
            }));
    }
    end_section(kOneRow);
  }

  /// A cell of a grid: the mask and its spectrum side by side.
  void small_mask(int column, int row, const SheetMask& mask) {
    const int left = kMargin + column * (kCell + kCellGap), top = top_ + row * kCellHeight;
    fitted_text(left, top + 8, mask.name, kCell, kTitle);
    framed(left, top + 36, kSmall, GreyLevels(mask.levels).picture());
    const Grid<std::uint8_t> power = sheet_spectrum(mask.levels);
    framed(left + kSmall + 8, top + 36, kSmall,
           coloured(power.size(), [&](int x, int y) { return grey(power(x, y) / 255.0); }));
    fitted_text(left, top + 36 + kSmall + 8, mask.size, kCell, kFaint);
    fitted_text(left, top + 36 + kSmall + 30, mask.about, kCell, kFaint);
  }

  void end_grid(int rows) { top_ += rows * kCellHeight; }

  void left_out(int more) { canvas_.text(kMargin, top_, fmt::format("and {} more", more), 2, kFaint); }

 private:
  static int column_left(int column) { return kMargin + column * (kPanel + kGap); }
  int row_top(int row) const { return top_ + kHeader + row * (kPanel + kCaption); }

  void header(const std::string& name, const std::string& figures) {
    canvas_.text(kMargin, top_, name, 4, kTitle);
    fitted_text(kMargin, top_ + 50, figures, canvas_.size().width - 2 * kMargin, kFaint);
  }

  void end_section(int height) {
    top_ += height;
    if (top_ + kBetween < canvas_.size().height) {
      canvas_.fill(kMargin, top_, {canvas_.size().width - 2 * kMargin, 1}, kRule);
    }
    top_ += kBetween;
  }

  /// `text` at the largest scale (2 or 1) at which it fits the width, cut off where it does not fit at 1.
  void fitted_text(int x, int y, std::string_view text, int width, Colour colour) {
    const int scale = 2 * text_width(text) <= width ? 2 : 1;
    const auto most = static_cast<std::size_t>(std::max(1, (width / scale + 1) / kGlyphAdvance));
    canvas_.text(x, y + (scale == 1 ? 5 : 0), text.substr(0, most), scale, colour);
  }

  void caption(int left, int top, const std::string& label, const std::string& figures, int width = kPanel) {
    fitted_text(left, top + 10, label, width, kText);
    fitted_text(left, top + 33, figures, width, kFaint);
  }

  /// A picture enlarged in a frame of `side` pixels.
  bool framed(int left, int top, int side, const Grid<Colour>& picture) {
    canvas_.fill(left, top, {side, side}, kEmpty);
    if (picture.count() == 0) return true;
    const Grid<Colour> part = cropped(picture, side);
    const int scale = side / std::max(part.width(), part.height());
    canvas_.picture(left + (side - part.width() * scale) / 2, top + (side - part.height() * scale) / 2, part,
                    scale);
    return part.size() == picture.size();
  }

  void panel(int column, int row, const std::string& label, const std::string& figures,
             const Grid<Colour>& picture) {
    const int left = column_left(column), top = row_top(row);
    const bool whole = framed(left, top, kPanel, picture);
    caption(left, top + kPanel, label, whole ? figures : figures + ", upper left corner");
  }

  void spectrum(int column, int row, const Grid<std::int32_t>& levels) {
    const Grid<std::uint8_t> power = sheet_spectrum(levels);
    panel(column, row, "spectrum", power.count() > 0 ? "-50 dB to 12.5 dB" : "none of this size",
          coloured(power.size(), [&](int x, int y) { return grey(power(x, y) / 255.0); }));
  }

  /// The colours of scale_colour() between two numbers, below a panel's caption.
  void bar(int column, int row, int width, std::string_view low, std::string_view high) {
    const int left = column_left(column), top = row_top(row) + kPanel + 54;
    const int text_left = 2 * text_width(low) + 8, text_right = 2 * text_width(high) + 8;
    canvas_.text(left, top, low, 2, kFaint);
    canvas_.text(left + width - text_right + 8, top, high, 2, kFaint);
    const int length = width - text_left - text_right;
    for (int x = 0; x < length; ++x) {
      canvas_.fill(left + text_left + x, top + 2, {1, 10}, scale_colour(x / std::max(1.0, length - 1.0)));
    }
  }

  /// R, with a disc of all directions to read it by in the caption's right.
  void hues(const SheetSet& set) {
    const int left = column_left(0), top = row_top(1);
    framed(left, top, kPanel, coloured(set.tile->size(), [&](int x, int y) {
             return move_colour((*set.tile)(x, y), set.radius);
           }));
    caption(left, top + kPanel, "R as hues", fmt::format("rim = {} px", set.radius), kPanel - kDisc - 12);
    canvas_.picture(left + kPanel - kDisc, top + kPanel + 10, move_disc(kDisc, kBackground), 1);
  }

  void arrows(const Grid<Offset>& tile, double longest) {
    const int left = column_left(1), top = row_top(1);
    const int cells = std::min({16, tile.width(), tile.height()}), cell = kPanel / cells;
    const int inset = (kPanel - cells * cell) / 2;
    canvas_.fill(left, top, {kPanel, kPanel}, kEmpty);
    for (int y = 0; y < cells; ++y) {
      for (int x = 0; x < cells; ++x) {
        const Offset r = tile(x, y);
        const double cx = left + inset + (x + 0.5) * cell, cy = top + inset + (y + 0.5) * cell;
        const double reach = 0.45 * cell / longest;
        canvas_.arrow(cx - r.x * reach, cy - r.y * reach, cx + r.x * reach, cy + r.y * reach,
                      move_colour(r, longest));
      }
    }
    caption(left, top + kPanel, "R as arrows", fmt::format("{} x {}, upper left", cells, cells));
  }

  /// What each motion costs, in percent of its start: colour and digits are this one quantity. Two panels
  /// wide, so that the digits of nine motions can be read.
  void heat_map(const SheetSet& set) {
    constexpr int kMapWidth = 2 * kPanel + kGap;
    const int left = column_left(2), top = row_top(1), range = set.motion, side = 2 * range + 1;
    const auto [low, high] = std::minmax_element(set.tiles.begin(), set.tiles.end(), [](auto& a, auto& b) {
      return percent_of_start(a) < percent_of_start(b);
    });
    const double least = percent_of_start(*low), most = percent_of_start(*high);
    std::int64_t least_energy = low->energy,
                 most_energy = low->energy;  // starts differ, so other motions may hold them
    for (const TileRecord& tile : set.tiles) {
      least_energy = std::min(least_energy, tile.energy);
      most_energy = std::max(most_energy, tile.energy);
    }
    const Extent cell{kMapWidth / side, kPanel / side};
    canvas_.fill(left, top, {kMapWidth, kPanel}, kEmpty);
    for (const TileRecord& tile : set.tiles) {
      const double percent = percent_of_start(tile);
      const double share = most > least ? (percent - least) / (most - least) : 0.0;
      const int x = left + (kMapWidth - cell.width * side) / 2 + (tile.motion.x + range) * cell.width,
                y = top + (kPanel - cell.height * side) / 2 + (tile.motion.y + range) * cell.height;
      canvas_.fill(x, y, {cell.width - 1, cell.height - 1}, scale_colour(share));
      const std::string label = fmt::format("{:.2f}", percent);
      const int scale = 2 * text_width(label) + 4 <= cell.width && 16 <= cell.height ? 2 : 1;
      if (scale * text_width(label) + 2 > cell.width || 9 > cell.height) continue;
      canvas_.text(x + (cell.width - 1 - scale * text_width(label)) / 2, y + (cell.height - 7 * scale) / 2,
                   label, scale, share > 0.6 ? kBackground : kTitle);
    }
    caption(left, top + kPanel, "energy by motion, % of the start",
            fmt::format("E {}..{}, motion right and down", least_energy, most_energy), kMapWidth);
    bar(2, 1, kMapWidth, fmt::format("{:.2f} %", least), fmt::format("{:.2f} %", most));
  }

  void atlas(const Grid<Offset>& moves, const SheetSet& set) {
    const int left = column_left(kColumns), top = row_top(0);
    const int longest_side = std::max(moves.width(), moves.height());
    const int every = (longest_side + kAtlas - 1) / kAtlas, scale = std::max(1, kAtlas / longest_side);
    // Scaled so that the motions, not the moves about them, span the colours.
    const double longest = set.motion + 0.5 * set.radius;
    const auto picture =
        coloured(moves.size(), [&](int x, int y) { return move_colour(moves(x, y), longest); });
    canvas_.fill(left, top, {kAtlas, kAtlas}, kEmpty);
    const int shown_width = (moves.width() + every - 1) / every * scale,
              shown_height = (moves.height() + every - 1) / every * scale;
    canvas_.picture(left + (kAtlas - shown_width) / 2, top + (kAtlas - shown_height) / 2, picture, scale,
                    every);
    const int side = 2 * set.motion + 1;
    const std::string_view th = every == 2 ? "nd" : every == 3 ? "rd" : "th";
    caption(left, top + kAtlas, fmt::format("atlas: motions -{} to {} in x and y", set.motion, set.motion),
            fmt::format("{} x {} tiles, {} x {}{}", side, side, moves.width(), moves.height(),
                        every == 1 ? "" : fmt::format(", every {}{} shown", every, th)),
            kAtlas - kDisc - 12);
    canvas_.picture(left + kAtlas - kDisc, top + kAtlas + 10, move_disc(kDisc, kBackground), 1);
  }

  Canvas canvas_;
  int top_ = kMargin;
};

}  // namespace

Image draw_sheet(const std::vector<SheetSet>& sets, const std::vector<SheetStack>& stacks,
                 const std::vector<SheetMask>& masks, int left_out, const Execution& execution) {
  const bool atlas =
      std::any_of(sets.begin(), sets.end(), [](const SheetSet& set) { return set.atlas.has_value(); });
  const int width = atlas ? kWidthWithAtlas : kWidth;
  const auto count = static_cast<int>(masks.size());
  const bool rows_each = count <= kMostRows;
  const int columns = std::max(1, (width - 2 * kMargin + kCellGap) / (kCell + kCellGap));
  const int grid_rows = rows_each ? 0 : (count + columns - 1) / columns;
  const int height = kMargin + static_cast<int>(sets.size()) * (kBothRows + kBetween) +
                     static_cast<int>(stacks.size()) * (kOneRow + kBetween) +
                     (rows_each ? count * (kOneRow + kBetween) : grid_rows * kCellHeight + kBetween) +
                     (left_out > 0 ? kMargin : 0);
  Sheet sheet({width, height});
  for (const SheetSet& set : sets) {
    throw_if_stopped(execution);
    sheet.set(set);
  }
  for (const SheetStack& stack : stacks) {
    throw_if_stopped(execution);
    sheet.stack(stack);
  }
  for (int i = 0; i < count; ++i) {
    throw_if_stopped(execution);
    if (rows_each) {
      sheet.mask(masks[static_cast<std::size_t>(i)]);
    } else {
      sheet.small_mask(i % columns, i / columns, masks[static_cast<std::size_t>(i)]);
    }
  }
  if (!rows_each) sheet.end_grid(grid_rows);
  if (left_out > 0) sheet.left_out(left_out);
  return sheet.image();
}

}  // namespace bn::baking
