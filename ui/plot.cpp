#include "ui/plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/items.h"
#include "ui/plot_canvas.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace bn::ui {

namespace {

void draw_axes(const Canvas& c, const Figure& figure, const std::vector<Tick>& y_ticks, Interval x) {
  const Palette& p = palette();
  const float gap = em(0.3f), height = ImGui::GetTextLineHeight();
  c.list.AddRectFilled(c.min, c.max, p.background);
  const auto grid = [&](const Tick& t) { return faded(p.line, t.text.empty() ? 90 : 200); };
  float free_from = -FLT_MAX;
  for (const Tick& t :
       ticks_of(figure.x, x, (c.max.x - c.min.x) / em(figure.heat && x.high < 100.0 ? 2.5f : 5.0f))) {
    const float at = std::round(c.place_x(t.value));
    if (!figure.heat) c.list.AddLine({at, c.min.y}, {at, c.max.y}, grid(t));
    const float wide = ImGui::CalcTextSize(t.text.c_str()).x;
    const float left = std::min(at - 0.5f * wide, c.max.x - wide + em(0.5f));
    if (t.text.empty() || left < free_from) continue;
    c.list.AddText({left, c.max.y + gap}, p.dim_text, t.text.c_str());
    free_from = left + wide + em(0.8f);
  }
  // The name of x has a line of its own, so that no number takes its place.
  const float name = ImGui::CalcTextSize(figure.x.name.c_str()).x;
  c.list.AddText({std::max(c.min.x, 0.5f * (c.min.x + c.max.x - name)), c.max.y + gap + 0.9f * height},
                 p.text, figure.x.name.c_str());
  float free_to = FLT_MAX;
  for (const Tick& t : y_ticks) {
    const float at = std::round(c.place_y(t.value));
    if (!figure.heat) c.list.AddLine({c.min.x, at}, {c.max.x, at}, grid(t));
    if (t.text.empty() || at + 0.5f * height > free_to) continue;
    const float width = ImGui::CalcTextSize(t.text.c_str()).x;
    c.list.AddText({c.min.x - gap - width, at - 0.5f * height}, p.dim_text, t.text.c_str());
    free_to = at - 0.5f * height;
  }
}

/// The stretch of a line that lies in a box, as shares of it; the first above the second where none does.
std::pair<double, double> share_within(ImVec2 from, ImVec2 to, ImVec2 low, ImVec2 high) {
  double enter = 0.0, leave = 1.0;
  const auto cut = [&](float at, float by, float least, float most) {
    if (by == 0.0f) {
      if (at < least || at > most) leave = -1.0;
      return;
    }
    const double a = static_cast<double>((least - at) / by), b = static_cast<double>((most - at) / by);
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  };
  cut(from.x, to.x - from.x, low.x, high.x);
  cut(from.y, to.y - from.y, low.y, high.y);
  return {enter, leave};
}

void draw_curve(const Canvas& c, const Figure& figure, const Curve& curve) {
  const std::size_t count = std::min(curve.x.size(), curve.y.size());
  const float thick = std::max(1.5f, em(0.11f));
  for (std::size_t i = 0; i + 1 < std::min({count, curve.band_low.size(), curve.band_high.size()}); ++i) {
    const auto corner = [&](std::size_t j, const std::vector<double>& edge) {
      return ImVec2(c.place_x(curve.x[j]), c.place_y(clean(figure.y, edge[j])));
    };
    const ImVec2 a = corner(i, curve.band_low), b = corner(i + 1, curve.band_low),
                 d = corner(i + 1, curve.band_high), e = corner(i, curve.band_high);
    if (std::isfinite(a.y + b.y + d.y + e.y)) c.list.AddQuadFilled(a, b, d, e, faded(curve.colour, 60));
  }
  std::vector<ImVec2> points;
  const auto flush = [&] {
    if (points.size() == 1) c.list.AddCircleFilled(points[0], thick, curve.colour);
    if (points.size() > 1 && !curve.dashed) {
      c.list.AddPolyline(points.data(), static_cast<int>(points.size()), curve.colour, 0, thick);
    }
    // Dashes by length on the screen, so that they look the same at any density of points; only those in
    // sight, as a line may be a hundred thousand pixels long.
    double before = 0.0;  // length of the line up to here
    const double dash = static_cast<double>(em(0.5f)), period = 2.0 * dash;
    for (std::size_t i = 0; curve.dashed && i + 1 < points.size(); ++i) {
      const ImVec2 from = points[i], to = points[i + 1];
      const double dx = static_cast<double>(to.x - from.x), dy = static_cast<double>(to.y - from.y);
      const double length = std::hypot(dx, dy);
      const auto at = [&](double s) {
        return ImVec2(from.x + static_cast<float>(dx * (s - before) / length),
                      from.y + static_cast<float>(dy * (s - before) / length));
      };
      const auto [enter, leave] = share_within(from, to, c.list.GetClipRectMin(), c.list.GetClipRectMax());
      const double first = before + enter * length, last = before + leave * length;
      for (double begin = std::floor(first / period) * period; begin < last; begin += period) {
        const double s = std::max(begin, first), end = std::min(begin + dash, last);
        if (s < end) c.list.AddLine(at(s), at(end), curve.colour, thick);
      }
      before += length;
    }
    points.clear();
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double x = clean(figure.x, curve.x[i]), y = clean(figure.y, curve.y[i]);
    if (std::isnan(x) || std::isnan(y)) {
      flush();
      continue;
    }
    // Far outside, floats of pixels lose their way.
    const ImVec2 at{std::clamp(c.place_x(x), -1e5f, 1e5f), std::clamp(c.place_y(y), -1e5f, 1e5f)};
    if (points.empty() || std::abs(at.x - points.back().x) > 0.3f || std::abs(at.y - points.back().y) > 0.3f)
      points.push_back(at);
  }
  flush();
}

/// The point of a curve nearest in x, from its first to its last. None: x is beyond them.
std::optional<std::size_t> nearest(const Curve& curve, double x) {
  const std::size_t count = std::min(curve.x.size(), curve.y.size());
  if (count == 0 || x < curve.x.front() || x > curve.x[count - 1]) return {};
  const auto end = curve.x.begin() + static_cast<std::ptrdiff_t>(count);
  auto at = std::lower_bound(curve.x.begin(), end, x);
  if (at == end || (at != curve.x.begin() && x - *(at - 1) < *at - x)) --at;
  return static_cast<std::size_t>(at - curve.x.begin());
}

/// Of what can be seen: all of x, and the y that lies within the shown stretch of x.
struct Fit {
  Interval x, y;
  std::size_t points = 0;
};

Fit fit(const Figure& figure, const std::set<std::string>& hidden, const std::optional<Interval>& shown_x) {
  Fit result;
  Extremes x, y;
  const auto each = [&](auto take) {
    for (const Curve& curve : figure.curves) {
      if (!curve.fits || hidden.contains(curve.name)) continue;
      for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
        if (!std::isnan(clean(figure.x, curve.x[i])) && !std::isnan(clean(figure.y, curve.y[i])))
          take(curve, i);
      }
    }
  };
  each([&](const Curve& curve, std::size_t i) {
    x.take(curve.x[i]);
    ++result.points;
  });
  if (figure.heat) {
    x.take(figure.heat->x.low), x.take(figure.heat->x.high);
    y.take(-0.5), y.take(static_cast<double>(figure.heat->rows.size()) - 0.5);
    for (const double value : figure.heat->values) result.points += !std::isnan(value);
  }
  result.x = finish(figure.x, x, 0.0);
  const Interval window = shown_x.value_or(result.x);
  each([&](const Curve& curve, std::size_t i) {
    if (curve.x[i] < window.low || curve.x[i] > window.high) return;
    y.take(curve.y[i]);
    if (i < curve.band_low.size()) y.take(clean(figure.y, curve.band_low[i]));
    if (i < curve.band_high.size()) y.take(clean(figure.y, curve.band_high[i]));
  });
  for (const Level& level : figure.levels) {
    if (!hidden.contains(level.name)) y.take(clean(figure.y, level.y));
  }
  result.y = finish(figure.y, y, figure.heat ? 0.0 : 0.05);
  return result;
}

/// Title and names; a click on a name hides its curve or brings it back.
void draw_legend(const char* plot, const Figure& figure, float width, std::set<std::string>& hidden) {
  const float dash = em(1.0f), gap = em(0.35f), space = em(1.0f);
  ImGui::TextUnformatted(figure.title.c_str());
  float used = ImGui::CalcTextSize(figure.title.c_str()).x;
  const auto entry = [&](const std::string& name, ImU32 colour, bool dashed) {
    if (name.empty()) return;
    const float wide = dash + gap + ImGui::CalcTextSize(name.c_str()).x;
    const bool fits = used + space + wide <= width;
    if (fits) ImGui::SameLine(0, space);
    used = fits ? used + space + wide : wide;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight();
    if (ImGui::InvisibleButton(name.c_str(), {wide, height}) && !hidden.erase(name)) hidden.insert(name);
    const bool off = hidden.contains(name);
    items::record(fmt::format("{}: {}", plot, name), off ? "off" : "on");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = at.y + 0.55f * height, thick = std::max(2.0f, em(0.16f));
    const ImU32 ink = off ? palette().line : colour;
    list.AddLine({at.x, middle}, {at.x + (dashed ? 0.4f : 1.0f) * dash, middle}, ink, thick);
    if (dashed) list.AddLine({at.x + 0.6f * dash, middle}, {at.x + dash, middle}, ink, thick);
    list.AddText({at.x + dash + gap, at.y}, off ? palette().line : palette().dim_text, name.c_str());
  };
  for (const Curve& curve : figure.curves) entry(curve.name, curve.colour, curve.dashed);
  for (const Level& level : figure.levels) entry(level.name, level.colour, true);
}

/// Values at the cursor: dots on the curves, and a tip where the mouse is.
void draw_cursor(const Canvas& c, const Figure& figure, const std::set<std::string>& hidden, double x,
                 bool tip) {
  const float at = c.place_x(x);
  if (at < c.min.x || at > c.max.x) return;
  c.list.AddLine({at, c.min.y}, {at, c.max.y}, faded(palette().text, 110));
  std::string text = fmt::format("{}{}{}", figure.x.name, figure.x.name.empty() ? "" : "  ", short_number(x));
  for (const Curve& curve : figure.curves) {
    const auto i = hidden.contains(curve.name) ? std::nullopt : nearest(curve, x);
    if (!i || std::isnan(clean(figure.y, curve.y[*i]))) continue;
    const float y = c.place_y(curve.y[*i]);
    if (y >= c.min.y && y <= c.max.y)
      c.list.AddCircleFilled({c.place_x(curve.x[*i]), y}, em(0.22f), curve.colour);
    text += fmt::format("\n{}  {:.6g}", curve.name, curve.y[*i]);
    if (*i < curve.band_low.size() && *i < curve.band_high.size()) {
      text += fmt::format(" ({:.6g} .. {:.6g})", curve.band_low[*i], curve.band_high[*i]);
    }
  }
  for (const Level& level : figure.levels) {
    if (!hidden.contains(level.name)) text += fmt::format("\n{}  {:.6g}", level.name, level.y);
  }
  if (tip) tooltip(text);
}

/// Pan, zoom, box and fit.
void steer(const Canvas& c, const Figure& figure, bool inside, bool held, std::optional<Interval>& x,
           std::optional<Interval>& y, std::optional<ImVec2>& box_from) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto show = [&](double left, double right, double bottom, double top, bool in_x, bool in_y) {
    const Interval wide = c.x.between(left, right), high = c.y.between(bottom, top);
    if (in_x && is_sound(figure.x, wide)) x = wide;
    if (in_y && !figure.heat && is_sound(figure.y, high)) y = high;
  };
  if (held && ImGui::IsMouseDown(0) && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
    const double dx = -io.MouseDelta.x / (c.max.x - c.min.x), dy = io.MouseDelta.y / (c.max.y - c.min.y);
    show(dx, 1.0 + dx, dy, 1.0 + dy, dx != 0.0, dy != 0.0);
  }
  if (inside && io.MouseWheel != 0.0f) {
    const double grow = std::pow(1.25, static_cast<double>(-io.MouseWheel));
    const double sx = c.share_x(io.MousePos.x), sy = c.share_y(io.MousePos.y);
    show(sx - sx * grow, sx + (1.0 - sx) * grow, sy - sy * grow, sy + (1.0 - sy) * grow, !io.KeyCtrl,
         !io.KeyShift);
  }
  if (inside && ImGui::IsMouseClicked(1)) box_from = io.MousePos;
  if (box_from && !ImGui::IsMouseDown(1)) {
    const ImVec2 a = *box_from, b = io.MousePos;
    box_from.reset();
    if (std::abs(a.x - b.x) > 4.0f && std::abs(a.y - b.y) > 4.0f) {
      show(c.share_x(std::min(a.x, b.x)), c.share_x(std::max(a.x, b.x)), c.share_y(std::max(a.y, b.y)),
           c.share_y(std::min(a.y, b.y)), true, true);
    }
  }
  if (inside && ImGui::IsMouseDoubleClicked(0)) x.reset(), y.reset();
}

}  // namespace

void Plot::draw(const char* name, const Figure& figure, ImVec2 size, PlotLink& link) {
  ImGui::PushID(name);
  ImGui::BeginGroup();
  const Palette& p = palette();
  const ImVec2 top = ImGui::GetCursorScreenPos();
  draw_legend(name, figure, size.x, link.hidden);
  const Fit fitting = fit(figure, link.hidden, link.x);
  Interval x = link.x.value_or(fitting.x), y = y_.value_or(fitting.y);
  if (!is_sound(figure.x, x)) x = fitting.x;
  if (!is_sound(figure.y, y)) y = fitting.y;

  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 area{std::max(em(4), size.x), std::max(em(4), size.y - (corner.y - top.y))};
  ImGui::InvisibleButton("area", area, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  const auto curves = std::count_if(figure.curves.begin(), figure.curves.end(),
                                    [&](const Curve& curve) { return !link.hidden.contains(curve.name); });
  items::record(name, fitting.points == 0 ? "empty"
                      : figure.heat       ? fmt::format("{} cells", fitting.points)
                                          : fmt::format("{} curves, {} points", curves, fitting.points));
  const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive();

  const float text = ImGui::GetTextLineHeight();
  std::vector<Tick> y_ticks = ticks_of(figure.y, y, area.y / em(2.2f));
  if (figure.heat) {
    y_ticks.clear();
    for (std::size_t i = 0; i < figure.heat->rows.size(); ++i)
      y_ticks.push_back({static_cast<double>(i), figure.heat->rows[i]});
  }
  float label_width = em(3);  // enough for most, so that plots below each other are aligned
  for (const Tick& t : y_ticks) label_width = std::max(label_width, ImGui::CalcTextSize(t.text.c_str()).x);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float bar = figure.heat ? em(5.2f) : em(0.6f);
  const Canvas canvas{
      list,
      {corner.x + label_width + em(0.5f), corner.y + em(0.3f)},
      {corner.x + area.x - bar, corner.y + area.y - (figure.x.name.empty() ? 1.0f : 1.9f) * text - em(0.4f)},
      Scale(figure.x.logarithmic, x),
      Scale(figure.y.logarithmic, y)};
  if (fitting.points > 0) {
    draw_axes(canvas, figure, y_ticks, x);
  } else {
    list.AddRectFilled(canvas.min, canvas.max, p.background);  // numbers of nothing would mean nothing
  }

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool inside = hovered && mouse.x >= canvas.min.x && mouse.x <= canvas.max.x &&
                      mouse.y >= canvas.min.y && mouse.y <= canvas.max.y;
  const int frame = ImGui::GetFrameCount();
  if (inside) link.cursor = canvas.x.value(canvas.share_x(mouse.x)), link.cursor_frame = frame;

  list.PushClipRect(canvas.min, canvas.max, true);
  if (figure.heat) draw_heat(canvas, *figure.heat);
  for (const Level& level : figure.levels) {
    if (link.hidden.contains(level.name)) continue;
    Curve line;
    line.colour = level.colour;
    line.x = {x.low, x.high};
    line.y = {level.y, level.y};
    line.dashed = true;
    draw_curve(canvas, figure, line);
  }
  for (const Curve& curve : figure.curves) {
    if (!link.hidden.contains(curve.name)) draw_curve(canvas, figure, curve);
  }
  const bool linked = fitting.points > 0 && link.cursor_frame >= frame - 1;
  if (linked) items::record(fmt::format("{} cursor", name), short_number(link.cursor));
  if (linked && figure.heat) {
    const float at = canvas.place_x(link.cursor);
    list.AddLine({at, canvas.min.y}, {at, canvas.max.y}, faded(p.text, 110));
  } else if (linked)
    draw_cursor(canvas, figure, link.hidden, link.cursor, inside && !held);
  if (box_from_) list.AddRect(*box_from_, mouse, p.accent, 0, 0, 1.5f);
  list.PopClipRect();
  if (figure.heat) draw_colour_bar(canvas, *figure.heat, canvas.max.x + em(0.5f));
  if (fitting.points == 0) {
    const ImVec2 half = ImGui::CalcTextSize(figure.empty.c_str());
    list.AddText(
        {0.5f * (canvas.min.x + canvas.max.x - half.x), 0.5f * (canvas.min.y + canvas.max.y - half.y)},
        p.dim_text, figure.empty.c_str());
  }
  list.AddRect(canvas.min, canvas.max, p.line);
  if (inside && figure.heat && figure.heat->describe) {
    const HeatMap& heat = *figure.heat;
    const int column =
        static_cast<int>((link.cursor - heat.x.low) / (heat.x.high - heat.x.low) * heat.columns);
    const int row = static_cast<int>(std::lround(canvas.y.value(canvas.share_y(mouse.y))));
    if (column >= 0 && column < heat.columns && row >= 0 && row < static_cast<int>(heat.rows.size())) {
      tooltip(heat.describe(column, row));
      if (heat.click && ImGui::IsMouseClicked(0)) heat.click(column, row);
    }
  }
  steer(canvas, figure, inside, held, link.x, y_, box_from_);
  ImGui::EndGroup();
  ImGui::PopID();
}

}  // namespace bn::ui
