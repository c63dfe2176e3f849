// Curves and heat maps with axes, for as long as Debian ships no ImPlot.
//
// A Figure says what is shown and nothing of how; Plot keeps what the user has zoomed to and hidden, and
// draws it. Whoever replaces this widget by another library keeps Figure and rewrites plot.cpp.
//
// Drag pans, the wheel zooms about the cursor (with shift along x only, with ctrl along y only), a drag of
// the right button zooms to a box, a double click fits; a click on a name in the legend hides its curve.

#pragma once

#include <imgui.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace bn::ui {

struct Interval {
  double low = 0.0, high = 1.0;
};

struct Axis {
  std::string name;
  bool logarithmic = false;  ///< values that are not above 0 are left out
  /// Ends that do not follow the data; NaN: follow them.
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// Values y over ascending x. NaN interrupts the line.
struct Curve {
  std::string name;
  ImU32 colour = 0;
  std::vector<double> x, y;
  std::vector<double> band_low = {}, band_high = {};  ///< not empty: the space between is shaded
  bool dashed = false;
  bool fits = true;  ///< whether the ranges of the axes take it in
};

/// A line across the plot at one y.
struct Level {
  std::string name;
  ImU32 colour = 0;
  double y = 0.0;
};

/// Coloured cells; row i is centred on y = i, named in place of a number.
struct HeatMap {
  int columns = 0;
  Interval x;                     ///< edges of the first and the last column
  std::vector<std::string> rows;  ///< names, from the bottom
  std::vector<double> values;     ///< row * columns + column; NaN: an empty cell
  Interval colours;               ///< values of the ends of the colour scale
  bool logarithmic = false;       ///< likewise
  /// What to say of a cell under the cursor, and what a click on it does.
  std::function<std::string(int column, int row)> describe = {};
  std::function<void(int column, int row)> click = {};
  std::optional<std::pair<int, int>> marked = {};  ///< column and row of a cell with a frame
};

struct Figure {
  std::string title;
  Axis x, y;
  std::vector<Curve> curves = {};
  std::vector<Level> levels = {};
  std::optional<HeatMap> heat = {};
  std::string empty = "nothing yet";  ///< what to say where there is no data
};

/// What plots side by side share: the stretch of x that they show, what is hidden, and where the cursor is.
struct PlotLink {
  std::optional<Interval> x = {};     ///< none: all of it
  std::set<std::string> hidden = {};  ///< names of curves
  double cursor = 0.0;
  int cursor_frame = -1;  ///< of ImGui, in which the cursor was there
};

class Plot {
 public:
  /// `name` is its item name for scripts; the item's text says how much it shows.
  void draw(const char* name, const Figure& figure, ImVec2 size, PlotLink& link);

 private:
  std::optional<Interval> y_;       ///< none: fits
  std::optional<ImVec2> box_from_;  ///< where the right button went down
};

/// "1e9", "0.25", "3638": short, as on an axis; at most `digits` that count.
std::string short_number(double value, int digits = 5);

}  // namespace bn::ui
