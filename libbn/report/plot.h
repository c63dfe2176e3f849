// Plots: their data, their CSV, and gnuplot's drawing of them.

#pragma once

#include <stop_token>
#include <string>
#include <vector>

namespace bn::report {

/// One file of scripts/plots each.
enum class PlotStyle {
  power,
  power_in_time,
  anisotropy,
  autocorrelation,
  histogram,
  residual,
  moves,
  energies,
  slice_bands,
  error_power,
  error_frames
};

/// What a curve stands for decides its colour and line; see scripts/plots/common.gnuplot.
enum class Role { white, reference, texture, others };

struct Curve {
  std::string name;
  Role role = Role::texture;
  int colour = 0;            ///< of a texture, 0..kCurveColours-1
  std::vector<double> x, y;  ///< NaN in y leaves a gap
};

inline constexpr int kCurveColours = 6;

struct Plot {
  PlotStyle style;
  std::string file_name;  ///< of its CSV, without extension
  std::string x_name, y_name;
  std::vector<Curve> curves;
  bool wide = false;  ///< for half of the page, whatever its style
};

/// Lines "curve,x,y" with a header of the plot's own names; numbers as short as they can be read back
/// exactly.
std::string to_csv(const Plot& plot);

struct Drawing {
  std::vector<std::string> svg;  ///< one element a plot; empty if gnuplot did not draw
  std::string failure;           ///< then why
};

/// Draws all plots in one run of gnuplot. It is handed numbers only: no text of any file reaches it.
Drawing draw(const std::vector<Plot>& plots, std::stop_token stop);

}  // namespace bn::report
