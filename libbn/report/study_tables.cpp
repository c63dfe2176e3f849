#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/html.h"
#include "report/study_parts.h"

namespace bn::report {
namespace {

std::string decibels(double db) {
  if (std::isnan(db)) return "–";
  const std::string text = fmt::format("{:.1f}", std::abs(db));
  return db < 0.0 && text != "0.0" ? "\u2212" + text : text;
}

/// Names with commas between and "and" before the last, as HTML.
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += i == 0 ? "" : i + 1 == names.size() ? " and " : ", ";
    text += escaped(names[i]);
  }
  return text;
}

/// A column of the table: least is best.
struct Column {
  std::string heading;  ///< HTML
  std::vector<double> values = {};
  std::vector<std::string> cells = {};

  void add(double value, std::string cell) {
    values.push_back(value);
    cells.push_back(std::move(cell));
  }
  /// All cells that read as the least one does are marked, unless it is most of them.
  void mark_best() {
    std::size_t best = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (values[i] < values[best] || std::isnan(values[best])) best = i;
    }
    const std::string least = cells.empty() ? "" : cells[best];
    if (2 * std::count(cells.begin(), cells.end(), least) > std::ssize(cells)) return;
    for (std::string& cell : cells) {
      if (cell == least && least != "–") cell = fmt::format("<b class=\"best\">{}</b>", cell);
    }
  }
};

std::vector<Column> columns_of(const std::vector<MethodRow>& rows, const std::vector<std::string>& regions) {
  std::vector<Column> columns;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    Column column{.heading = regions[r] == "picture" ? "whole picture, dB" : escaped(regions[r]) + ", dB"};
    for (const MethodRow& row : rows) column.add(row.db[r], decibels(row.db[r]));
    columns.push_back(std::move(column));
  }
  const std::pair<const char*, double MethodRow::*> kRest[] = {
      {"RMSE", &MethodRow::rmse},
      {"RMSE, blurred", &MethodRow::blurred},
      {"flicker", &MethodRow::flicker},
      {"RMSE, averaged", &MethodRow::averaged},
      {"RMSE, averaged and blurred", &MethodRow::averaged_blurred}};
  for (const auto& [heading, member] : kRest) {
    Column column{.heading = heading};
    for (const MethodRow& row : rows) column.add(row.*member, number(row.*member));
    columns.push_back(std::move(column));
  }
  for (Column& column : columns) column.mark_best();
  return columns;
}

/// Rows that agree in every figure, and why where that is known.
std::string remark_on_equals(const std::vector<MethodRow>& rows, const std::vector<Column>& columns,
                             bool moves) {
  std::map<std::string, std::vector<std::string>> groups;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::string key;
    for (const Column& column : columns) key += column.cells[i] + "|";
    groups[key].push_back(rows[i].name);
  }
  std::string html;
  bool of_motion = false;
  for (const MethodRow& row : rows) {  // in the table's order
    for (const auto& [key, names] : groups) {
      if (names.size() < 2 || names.front() != row.name) continue;
      html += fmt::format("The rows of {} are the same. ", listed(names));
      of_motion |= std::any_of(names.begin(), names.end(),
                               [](const std::string& name) { return name.starts_with("reproject"); });
    }
  }
  if (html.empty()) return {};
  if (of_motion && !moves)
    html += "Nothing moves here, so the tile for the picture's motion is the plain one.";
  return fmt::format("<p>{}</p>\n", html);
}

/// What was published of the same passes, measured on a GPU, as a share of the frame there.
std::string_view published_share(std::string_view pass) {
  return pass == "retarget" ? "0.57 %" : pass == "sort" ? "11.1 % at B = 64, about 3 % at B = 16" : "";
}

}  // namespace

std::string verdict_html(const std::vector<MethodRow>& rows, const std::string& region, std::size_t index) {
  const std::string where = region == "picture" ? "the whole picture" : fmt::format("“{}”", escaped(region));
  const MethodRow* best = best_of(rows, index);
  if (best == nullptr) {
    return fmt::format(
        "<p class=\"verdict\">In {} no method leaves less low-frequency error than white noise by more than "
        "the scatter of about {} dB.</p>\n",
        where, kScatter_db);
  }
  std::vector<std::string> near;
  for (const MethodRow& row : rows) {
    if (&row != best && row.db[index] <= best->db[index] + kScatter_db) near.push_back(row.name);
  }
  return fmt::format(
      "<p class=\"verdict\"><b>Best in {}: {}, {} dB</b>, {:.0f} % of the low-frequency error that white "
      "noise "
      "leaves.{}</p>\n",
      where, escaped(best->name), decibels(best->db[index]), 100.0 * std::pow(10.0, 0.1 * best->db[index]),
      near.empty() ? ""
                   : fmt::format(" Within the scatter of about {} dB of it: {}.", kScatter_db, listed(near)));
}

std::string short_verdict(const std::vector<MethodRow>& rows, const std::string& region, std::size_t index) {
  const MethodRow* best = best_of(rows, index);
  if (best == nullptr) return "no method gains more than scatter";
  return fmt::format("best: {}, {} dB in {}", escaped(best->name), decibels(best->db[index]),
                     region == "picture" ? "the whole picture" : escaped(region));
}

std::string methods_table(const std::vector<MethodRow>& rows, const std::vector<std::string>& regions,
                          const StudyScene& scene) {
  const std::vector<Column> columns = columns_of(rows, regions);
  std::string html =
      "<div class=\"wide\"><table class=\"summary methods\"><thead><tr><th scope=\"col\">method</th>";
  for (const Column& column : columns) html += fmt::format("<th scope=\"col\">{}</th>", column.heading);
  html += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(rows[i].name));
    for (const Column& column : columns) html += fmt::format("<td>{}</td>", column.cells[i]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n" + remark_on_equals(rows, columns, scene.moves);
}

std::string pass_table(const Study& study, const std::string& scene) {
  std::string rows;
  for (std::size_t row = 0; row < study.passes.rows(); ++row) {
    if (study.passes.text(row, "scene") != scene || study.passes.text(row, "variant") != "reproject")
      continue;
    const std::string& pass = study.passes.text(row, "pass");
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{:.2f} ms</td><td>{:.1f} %</td><td>{}</td><td>{} KiB</td></tr>\n",
        escaped(pass), study.passes.number(row, "milliseconds"), study.passes.number(row, "percent_of_frame"),
        published_share(pass), whole(static_cast<std::int64_t>(study.passes.number(row, "bytes") / 1024)));
  }
  if (rows.empty()) return {};
  return fmt::format(
      "<h3>Cost of reprojected retarget</h3><div class=\"wide\"><table class=\"summary\"><thead><tr><th "
      "scope=\"col\">pass</th><th scope=\"col\">time</th><th scope=\"col\">of the frame</th><th "
      "scope=\"col\">published</th><th scope=\"col\">buffers read and "
      "written</th></tr></thead><tbody>{}</tbody></table></div>\n<p>Medians over the frames, on {}. "
      "Published: "
      "measured on a GPU, with textures of 16.1 + 12.1 + 980 + 7920 KB.</p>\n",
      rows, escaped(study.device));
}

std::string method_words(const Study& study) {
  std::string rows;
  for (const std::string& name : distinct(study.summary, "variant", "")) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"words\">{}</td></tr>\n", escaped(name),
                        escaped(words_for(name)));
  }
  return fmt::format(
      "<section><h2>The methods</h2>\n<div class=\"wide\"><table "
      "class=\"summary\"><tbody>{}</tbody></table></div>"
      "</section>\n",
      rows);
}

}  // namespace bn::report
