// The page of a validation study: for each scene its figures, tables and pictures, read back from the files
// that the study left. So a study made elsewhere can be shown here, and the page can hold nothing that no
// file says.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "bn/error.h"
#include "bn/report.h"
#include "bn/texture.h"
#include "report/html.h"
#include "report/page.h"

namespace bn {
namespace {

namespace fs = std::filesystem;
using report::Curve;
using report::Plot;
using report::PlotStyle;
using report::Role;

/// A CSV file without quotes, as the study writes them: rows by column name.
class Csv {
 public:
  Csv(const fs::path& path, const std::vector<std::string>& needed) : path_(path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) fail("cannot be read", ErrorCode::io);
    names_ = split(line);
    for (const std::string& name : needed) column(name);
    while (std::getline(file, line)) {
      rows_.push_back(split(line));
      if (rows_.back().size() != names_.size())
        fail(fmt::format("line {} has {} columns, not {}", rows_.size() + 1, rows_.back().size(),
                         names_.size()),
             ErrorCode::invalid_input);
    }
  }

  std::size_t rows() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& name) const { return rows_[row][column(name)]; }
  double number(std::size_t row, const std::string& name) const {
    const std::string& value = text(row, name);
    double result = std::nan("");
    std::istringstream in(value);
    in.imbue(std::locale::classic());
    if (!value.empty() && !(in >> result))
      fail(fmt::format("'{}' is no number", value), ErrorCode::invalid_input);
    return result;
  }

 private:
  [[noreturn]] void fail(std::string what, ErrorCode code) const {
    throw Error({.code = code,
                 .what = std::move(what),
                 .where = path_.string(),
                 .limit = "",
                 .remedy = "name a folder that bn validate wrote"});
  }
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    return cells;
  }
  std::size_t column(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) fail("no column " + name, ErrorCode::invalid_input);
    return static_cast<std::size_t>(found - names_.begin());
  }

  fs::path path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

/// The values of a column in the order they first appear.
std::vector<std::string> distinct(const Csv& csv, const std::string& column, const std::string& scene) {
  std::vector<std::string> values;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    if (!scene.empty() && csv.text(row, "scene") != scene) continue;
    const std::string& value = csv.text(row, column);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

struct Study {
  Csv summary, errors, radial, passes;
  explicit Study(const fs::path& folder)
      : summary(folder / "summary.csv", {"scene", "variant", "region", "db_against_white"}),
        errors(folder / "errors.csv",
               {"scene", "variant", "frame", "region", "rmse", "power_to_0.1", "reference_power_to_0.1"}),
        radial(folder / "radial.csv", {"scene", "variant", "frame", "region", "frequency", "power"}),
        passes(folder / "passes.csv",
               {"scene", "variant", "pass", "milliseconds", "percent_of_frame", "bytes"}) {}
};

/// The methods that plots show, a colour each; white noise is the line at 0 dB.
std::vector<std::string> plotted_variants(const Study& study, const std::string& scene) {
  std::vector<std::string> variants = distinct(study.errors, "variant", scene);
  std::erase_if(variants, [](const std::string& name) {
    return name == "white" || name.find("-block-") != std::string::npos ||
           name.find("-by-light") != std::string::npos;
  });
  const auto colours = static_cast<std::size_t>(report::kCurveColours);
  if (variants.size() > colours) variants.erase(variants.begin(), variants.end() - report::kCurveColours);
  return variants;
}

/// Power by frequency at the last frame, against white noise's variance.
Plot radial_plot(const Study& study, const std::string& scene, const std::string& region,
                 const std::string& frame) {
  double white = std::nan("");
  const Csv& errors = study.errors;
  for (std::size_t row = 0; row < errors.rows(); ++row) {
    if (errors.text(row, "scene") == scene && errors.text(row, "variant") == "white" &&
        errors.text(row, "region") == region && errors.text(row, "frame") == frame)
      white = errors.number(row, "rmse");
  }
  Plot plot{PlotStyle::error_power, scene + "-radial", "frequency_cycles_per_pixel", "power_db", {}};
  plot.curves.push_back({"white noise", Role::white, 0, {0.0, 0.7071}, {0.0, 0.0}});
  int colour = 0;
  for (const std::string& variant : plotted_variants(study, scene)) {
    Curve curve{variant, Role::texture, colour++, {}, {}};
    const Csv& radial = study.radial;
    for (std::size_t row = 0; row < radial.rows(); ++row) {
      if (radial.text(row, "scene") != scene || radial.text(row, "variant") != variant ||
          radial.text(row, "region") != region || radial.text(row, "frame") != frame)
        continue;
      curve.x.push_back(radial.number(row, "frequency"));
      curve.y.push_back(10.0 * std::log10(radial.number(row, "power") / (white * white)));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// Low-frequency error by frame, against the mean of white noise's.
Plot frames_plot(const Study& study, const std::string& scene, const std::string& region) {
  std::map<std::string, Curve> powers;
  double white = 0.0;
  int white_frames = 0;
  const Csv& errors = study.errors;
  for (std::size_t row = 0; row < errors.rows(); ++row) {
    if (errors.text(row, "scene") != scene || errors.text(row, "region") != region) continue;
    const double power = errors.number(row, "power_to_0.1") - errors.number(row, "reference_power_to_0.1");
    if (errors.text(row, "variant") == "white") {
      white += power;
      ++white_frames;
    }
    Curve& curve = powers[errors.text(row, "variant")];
    curve.x.push_back(errors.number(row, "frame"));
    curve.y.push_back(power);
  }
  Plot plot{PlotStyle::error_frames, scene + "-frames", "frame", "low_frequency_error_db", {}};
  double last = 1.0;
  int colour = 0;
  std::vector<Curve> curves;
  for (const std::string& variant : plotted_variants(study, scene)) {
    Curve curve = powers[variant];
    curve.name = variant;
    curve.role = Role::texture;
    curve.colour = colour++;
    for (double& y : curve.y) y = y > 0.0 ? 10.0 * std::log10(y / (white / white_frames)) : std::nan("");
    if (!curve.x.empty()) last = std::max(last, curve.x.back());
    curves.push_back(std::move(curve));
  }
  plot.curves.push_back({"white noise", Role::white, 0, {0.0, last}, {0.0, 0.0}});
  plot.curves.insert(plot.curves.end(), curves.begin(), curves.end());
  return plot;
}

std::string summary_table(const Study& study, const std::string& scene,
                          const std::vector<std::string>& regions) {
  std::string head = "<tr><th scope=\"col\">error at f ≤ 0.1 against white noise, dB</th>";
  for (const std::string& region : regions)
    head += fmt::format("<th scope=\"col\">{}</th>", report::escaped(region));
  std::map<std::pair<std::string, std::string>, std::string> cells;
  for (std::size_t row = 0; row < study.summary.rows(); ++row) {
    if (study.summary.text(row, "scene") != scene) continue;
    cells[{study.summary.text(row, "variant"), study.summary.text(row, "region")}] =
        fmt::format("{:.1f}", study.summary.number(row, "db_against_white"));
  }
  std::string rows;
  for (const std::string& variant : distinct(study.summary, "variant", scene)) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", report::escaped(variant));
    for (const std::string& region : regions) rows += fmt::format("<td>{}</td>", cells[{variant, region}]);
    rows += "</tr>\n";
  }
  return fmt::format(
      "<div class=\"wide\"><table class=\"summary\"><thead>{}</tr></thead><tbody>{}</tbody></table></div>\n",
      head, rows);
}

/// What was published of the same passes, measured on a GPU, as a share of the frame there.
std::string_view published_share(std::string_view pass) {
  return pass == "retarget" ? "0.57 %" : pass == "sort" ? "11.1 % at B = 64, about 3 % at B = 16" : "";
}

std::string pass_table(const Study& study, const std::string& scene) {
  std::string rows;
  for (std::size_t row = 0; row < study.passes.rows(); ++row) {
    if (study.passes.text(row, "scene") != scene || study.passes.text(row, "variant") != "reproject")
      continue;
    const std::string& pass = study.passes.text(row, "pass");
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{:.2f} ms</td><td>{:.1f} %</td><td>{}</td><td>{} KiB</td></tr>\n",
        report::escaped(pass), study.passes.number(row, "milliseconds"),
        study.passes.number(row, "percent_of_frame"), published_share(pass),
        report::whole(static_cast<std::int64_t>(study.passes.number(row, "bytes") / 1024)));
  }
  if (rows.empty()) return {};
  return fmt::format(
      "<h3>Cost of reprojected retarget</h3><div class=\"wide\"><table class=\"summary\"><thead><tr><th "
      "scope=\"col\">pass</th><th scope=\"col\">time</th><th scope=\"col\">of the frame</th><th "
      "scope=\"col\">published</th><th scope=\"col\">buffers read and "
      "written</th></tr></thead><tbody>{}</tbody>"
      "</table></div>\n<p>Medians over the frames. Published: measured on a GPU, with textures of 16.1 + "
      "12.1 + "
      "980 + 7920 KB.</p>\n",
      rows);
}

/// Names with commas between, as HTML.
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + report::escaped(name);
  return text;
}

std::string sheets(const Study& study, const std::string& scene, const fs::path& folder) {
  std::vector<std::string> methods = distinct(study.errors, "variant", scene);
  std::erase_if(methods, [](const std::string& name) { return name.find("-block-") != std::string::npos; });
  std::vector<std::string> temporal = methods;
  std::erase_if(temporal, [](const std::string& name) {
    return name != "sort" && name != "retarget" && name != "reproject";
  });
  std::string html;
  const auto add = [&](std::string_view file, std::string title, std::string caption) {
    const fs::path path = folder / scene / file;
    if (fs::exists(path))
      html += report::figure({read_image(path).image, 1, std::move(title), std::move(caption)});
  };
  add("first-frames.png", "The first seven frames.",
      "Errors in the middle of the first region, and under each its spectrum, dark where there is none; two "
      "rows "
      "a method: " +
          listed(temporal) + ".");
  add("methods.png", "The last frame of each method,",
      "from left to right: " + listed(methods) + ". Picture, error, spectrum.");
  add("blocks.png", "Block sizes 2, 4, 8, 16",
      "with retarget: picture, error and spectrum at the last frame.");
  return html;
}

}  // namespace

void write_study_report(const fs::path& study_folder, const fs::path& out, const Execution& execution) {
  check_text_writable(out);
  const Study study(study_folder);
  report::Page page;
  page.title = "Validation";
  page.introduction =
      "Each scene with one path a pixel, by every way to choose random numbers. Errors are against converged "
      "pictures, whose own error is taken off; frequencies are in cycles/pixel. A click on a picture shows "
      "it "
      "larger.";
  for (const std::string& scene : distinct(study.summary, "scene", "")) {
    // Names become paths below: a study names its scenes in letters, digits, spaces, hyphens.
    const bool plain = std::all_of(scene.begin(), scene.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
             c == '_' || c == ' ';
    });
    if (!plain || scene.empty()) {
      throw Error({.code = ErrorCode::invalid_input,
                   .what = fmt::format("scene '{}'", scene),
                   .where = (study_folder / "summary.csv").string(),
                   .limit = "letters, digits, spaces, - and _",
                   .remedy = ""});
    }
    throw_if_stopped(execution);
    const std::vector<std::string> regions = distinct(study.summary, "region", scene);
    const std::string& region = regions.size() > 1 ? regions[1] : regions[0];
    const std::string last = distinct(study.errors, "frame", scene).back();
    report::Section section;
    section.plots = {radial_plot(study, scene, region, last), frames_plot(study, scene, region)};
    section.html = fmt::format("<h2>{}</h2>\n", report::escaped(scene)) +
                   summary_table(study, scene, regions) + "<div class=\"plots\">" +
                   report::plot_figure(section.plots[0], 0, "Radial power",
                                       fmt::format("of the error in region “{}” at frame {}, dB.",
                                                   report::escaped(region), report::escaped(last))) +
                   report::plot_figure(section.plots[1], 1, "Low frequencies by frame",
                                       fmt::format("f ≤ 0.1 in region “{}”, dB.", report::escaped(region))) +
                   "</div>\n<div class=\"pictures\">" + sheets(study, scene, study_folder) + "</div>\n" +
                   pass_table(study, scene);
    page.names.push_back(scene);
    page.kinds.push_back("scene");
    page.sections.push_back(std::move(section));
  }
  std::vector<Plot> plots;
  for (const auto& section : page.sections)
    plots.insert(plots.end(), section.plots.begin(), section.plots.end());
  const report::Drawing drawing = report::draw(plots, execution.stop);
  if (!drawing.failure.empty()) page.notes.push_back("No plots: " + drawing.failure);
  write_text_file(out, report::page_html(page, drawing.svg));
}

}  // namespace bn
