// Plots by gnuplot.
//
// One process draws all of them, reading a script from its stdin: the styles of scripts/plots, which are
// built in, and data blocks. Styles name colours by number, as the grey rgb(n, n, n); the drawing becomes
// part of the page by replacing these with the page's CSS variables --plot-n, so the plots follow light, dark
// and print.

#include "report/plot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "report/gnuplot.h"

namespace bn::report {
namespace {

constexpr std::string_view kCommon =
#include "report/common.gnuplot.inc"
    ;

/// Page pixels of a drawing, as wide as the columns it stands in: text keeps its size.
struct PlotSize {
  int width, height;
};
constexpr PlotSize kHalfOfThePage{520, 280}, kThirdOfThePage{360, 230};

struct StyleFile {
  std::string_view script;
  std::string_view drawn_with;
  PlotSize size;
};

/// In the order of PlotStyle.
const StyleFile& style_file(PlotStyle style) {
  static constexpr std::array<StyleFile, 11> kFiles{{
      {
#include "report/power.gnuplot.inc"
          , "lines", kHalfOfThePage},
      {
#include "report/power_in_time.gnuplot.inc"
          , "linespoints", kHalfOfThePage},
      {
#include "report/anisotropy.gnuplot.inc"
          , "lines", kThirdOfThePage},
      {
#include "report/autocorrelation.gnuplot.inc"
          , "linespoints", kThirdOfThePage},
      {
#include "report/histogram.gnuplot.inc"
          , "steps", kThirdOfThePage},
      {
#include "report/residual.gnuplot.inc"
          , "lines", kThirdOfThePage},
      {
#include "report/moves.gnuplot.inc"
          , "boxes", kThirdOfThePage},
      {
#include "report/energies.gnuplot.inc"
          , "linespoints", kThirdOfThePage},
      {
#include "report/slice_bands.gnuplot.inc"
          , "linespoints", kHalfOfThePage},
      {
#include "report/error_power.gnuplot.inc"
          , "lines", kHalfOfThePage},
      {
#include "report/error_frames.gnuplot.inc"
          , "linespoints", kHalfOfThePage},
  }};
  return kFiles[static_cast<std::size_t>(style)];
}

PlotSize size_of(const Plot& plot) { return plot.wide ? kHalfOfThePage : style_file(plot.style).size; }

/// Line styles of common.gnuplot.
int line_style(const Curve& curve) {
  switch (curve.role) {
    case Role::white:
      return 1;
    case Role::reference:
      return 2;
    case Role::others:
      return 9;
    case Role::texture:
      break;
  }
  return 3 + curve.colour % kCurveColours;
}

std::string script_of(const std::vector<Plot>& plots) {
  std::string script;
  auto to = std::back_inserter(script);
  for (const Plot& plot : plots) {
    const StyleFile& file = style_file(plot.style);
    const PlotSize size = size_of(plot);
    fmt::format_to(to, "reset session\nplot_width = {}\nplot_height = {}\n{}\n{}\n", size.width, size.height,
                   kCommon, file.script);
    std::string drawn;
    for (std::size_t c = 0; c < plot.curves.size(); ++c) {
      const Curve& curve = plot.curves[c];
      fmt::format_to(to, "$curve{} << END\n", c);
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        if (std::isfinite(curve.y[i])) {
          fmt::format_to(to, "{:.6g} {:.6g}\n", curve.x[i], curve.y[i]);
        } else {
          fmt::format_to(to, "{:.6g} NaN\n", curve.x[i]);
        }
      }
      fmt::format_to(to, "END\n");
      // Points are for the few values of a texture; what it is compared with is a line.
      const std::string_view with =
          curve.role == Role::texture || file.drawn_with != "linespoints" ? file.drawn_with : "lines";
      drawn += fmt::format("{}$curve{} using 1:2 with {} linestyle {} notitle", drawn.empty() ? "" : ", ", c,
                           with, line_style(curve));
    }
    fmt::format_to(to, "plot {}\n", drawn);
  }
  return script;
}

/// Replaces every "rgb(n, n, n)" with var(--plot-n).
std::string with_page_colours(std::string_view line) {
  std::string result;
  while (true) {
    const auto at = line.find("rgb(");
    if (at == std::string_view::npos) break;
    result += line.substr(0, at);
    line.remove_prefix(at + 4);
    int number = 0;
    std::size_t i = 0;
    while (i < line.size() && line[i] == ' ') ++i;
    for (; i < line.size() && line[i] >= '0' && line[i] <= '9'; ++i) number = number * 10 + (line[i] - '0');
    result += fmt::format("var(--plot-{})", number);
    line.remove_prefix(std::min(line.find(')') + 1, line.size()));
  }
  return result.append(line);
}

/// One document of gnuplot's as an element of the page: without what only a document has (declaration, names,
/// marks and identifiers that would be there once a plot), groups that draw nothing, and colours of its own.
std::string inlined(std::string_view document) {
  std::string svg;
  bool in_definitions = false;
  std::string group;  // an opened group of which nothing is known yet
  while (!document.empty()) {
    const auto end = std::min(document.find('\n'), document.size());
    std::string_view line = document.substr(0, end);
    document.remove_prefix(std::min(end + 1, document.size()));
    while (!line.empty() && (line.front() == '\t' || line.front() == ' ')) line.remove_prefix(1);
    if (line.starts_with("<defs>")) in_definitions = true;
    const bool skipped =
        in_definitions || line.empty() || line.starts_with("<title>") || line.starts_with("<desc>");
    if (line.starts_with("</defs>")) in_definitions = false;
    if (skipped) continue;
    if (line == "</g>" && !group.empty()) {
      group.clear();
      continue;
    }
    svg += group;
    group.clear();
    std::string text;
    if (line.starts_with("<g id=")) {
      text = "<g>";
    } else {
      text = with_page_colours(line);
    }
    if (line.starts_with("<g fill=\"none\" color=")) {
      group = text + "\n";
    } else {
      svg += text + "\n";
    }
  }
  return svg;
}

std::string number(double value) { return std::isnan(value) ? std::string() : fmt::format("{}", value); }

}  // namespace

std::string to_csv(const Plot& plot) {
  std::string csv = fmt::format("curve,{},{}\n", plot.x_name, plot.y_name);
  for (const Curve& curve : plot.curves) {
    std::string name = "\"";
    for (const char c : curve.name) name += c == '"' ? "\"\"" : std::string(1, c);
    name += '"';
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      csv += fmt::format("{},{},{}\n", name, number(curve.x[i]), number(curve.y[i]));
    }
  }
  return csv;
}

Drawing draw(const std::vector<Plot>& plots, std::stop_token stop) {
  Drawing drawing;
  const GnuplotResult run = run_gnuplot(script_of(plots), {}, stop);
  if (!run.failure.empty()) {
    drawing.failure = run.failure;
    return drawing;
  }
  std::string_view rest = run.output;
  constexpr std::string_view kEnd = "</svg>";
  for (auto begin = rest.find("<svg"); begin != std::string_view::npos; begin = rest.find("<svg")) {
    const auto end = rest.find(kEnd, begin);
    if (end == std::string_view::npos) break;
    if (drawing.svg.size() == plots.size()) break;
    // The opening tag is ours: gnuplot's has its size in pixels.
    const PlotSize size = size_of(plots[drawing.svg.size()]);
    const auto tag_end = rest.find('>', begin);
    drawing.svg.push_back(fmt::format(
        "<svg class=\"chart{}\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"plot\">\n{}</svg>\n",
        size.width == kHalfOfThePage.width ? " half" : "", size.width, size.height,
        inlined(rest.substr(tag_end + 1, end - tag_end - 1))));
    rest.remove_prefix(end + kEnd.size());
  }
  if (drawing.svg.size() != plots.size()) {
    drawing.failure = fmt::format("gnuplot drew {} of {} plots", drawing.svg.size(), plots.size());
    drawing.svg.clear();
  }
  return drawing;
}

}  // namespace bn::report
