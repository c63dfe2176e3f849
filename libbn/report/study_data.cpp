#include "report/study_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bn/error.h"
#include "bn/texture.h"

namespace bn::report {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, std::string what, ErrorCode code = ErrorCode::invalid_input) {
  throw Error({.code = code,
               .what = std::move(what),
               .where = path.string(),
               .limit = "",
               .remedy = "name a folder that bn validate wrote"});
}

std::vector<std::string> split(const std::string& line) {
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

/// Names become paths: a study names its scenes and methods in letters, digits, spaces, hyphens.
void check_name(const fs::path& path, const std::string& name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == ' ';
  });
  if (plain) return;
  throw Error({.code = ErrorCode::invalid_input,
               .what = fmt::format("the name '{}'", name),
               .where = path.string(),
               .limit = "letters, digits, spaces, - and _",
               .remedy = ""});
}

}  // namespace

Csv::Csv(const fs::path& path, const std::vector<std::string>& needed) : path_(path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) fail(path, "cannot be read", ErrorCode::io);
  names_ = split(line);
  for (const std::string& name : needed) column(name);
  while (std::getline(file, line)) {
    rows_.push_back(split(line));
    if (rows_.back().size() != names_.size())
      fail(path, fmt::format("line {} has {} columns, not {}", rows_.size() + 1, rows_.back().size(),
                             names_.size()));
  }
}

double Csv::number(std::size_t row, const std::string& name) const {
  const std::string& value = text(row, name);
  double result = std::nan("");
  std::istringstream in(value);
  in.imbue(std::locale::classic());
  if (!value.empty() && !(in >> result)) fail(path_, fmt::format("'{}' is no number", value));
  return result;
}

std::size_t Csv::column(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) fail(path_, "no column " + name);
  return static_cast<std::size_t>(found - names_.begin());
}

std::vector<std::string> distinct(const Csv& csv, const std::string& column, const std::string& scene) {
  std::vector<std::string> values;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    if (!scene.empty() && csv.text(row, "scene") != scene) continue;
    const std::string& value = csv.text(row, column);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

Study::Study(const fs::path& folder)
    : summary(folder / "summary.csv", {"scene", "variant", "region", "db_against_white"}),
      errors(folder / "errors.csv", {"scene", "variant", "frame", "region", "rmse", "rmse_blur_1.5",
                                     "power_to_0.1", "reference_power_to_0.1", "flicker",
                                     "rmse_exponential_average", "rmse_exponential_average_blur_1.5"}),
      radial(folder / "radial.csv", {"scene", "variant", "frame", "region", "frequency", "power"}),
      passes(folder / "passes.csv",
             {"scene", "variant", "pass", "milliseconds", "percent_of_frame", "bytes"}) {
  const fs::path path = folder / "study.json";
  try {
    const auto json = nlohmann::json::parse(read_text_file(path));
    json.at("size").at(0).get_to(width);
    json.at("size").at(1).get_to(height);
    json.at("bounces").get_to(bounces);
    json.at("first_counted").get_to(first_counted);
    json.at("frames").get_to(frames);
    json.at("block").get_to(block);
    json.at("reference_paths").get_to(reference_paths);
    json.at("device").get_to(device);
    for (const auto& scene : json.at("scenes")) {
      scenes.push_back({scene.at("name"), scene.at("about"), scene.at("moves"), scene.at("reference_rmse")});
    }
  } catch (const nlohmann::json::exception& error) {
    fail(path, error.what());
  }
  for (const StudyScene& scene : scenes) check_name(path, scene.name);
  for (const std::string& scene : distinct(summary, "scene", "")) {
    if (std::none_of(scenes.begin(), scenes.end(), [&](const auto& s) { return s.name == scene; }))
      fail(folder / "summary.csv", fmt::format("scene '{}', which study.json does not have", scene));
  }
  for (const std::string& method : distinct(summary, "variant", "")) {
    check_name(folder / "summary.csv", method);
  }
}

std::vector<MethodRow> rows_of(const Study& study, const std::string& scene) {
  const std::vector<std::string> regions = distinct(study.summary, "region", scene);
  std::vector<MethodRow> rows;
  for (const std::string& name : distinct(study.summary, "variant", scene)) {
    rows.push_back({.name = name, .db = std::vector<double>(regions.size(), std::nan(""))});
  }
  const auto row_of = [&](const std::string& name) {
    return std::find_if(rows.begin(), rows.end(), [&](const MethodRow& row) { return row.name == name; });
  };
  const Csv& summary = study.summary;
  for (std::size_t i = 0; i < summary.rows(); ++i) {
    if (summary.text(i, "scene") != scene) continue;
    const auto region = std::find(regions.begin(), regions.end(), summary.text(i, "region"));
    row_of(summary.text(i, "variant"))->db[static_cast<std::size_t>(region - regions.begin())] =
        summary.number(i, "db_against_white");
  }
  // The last frame stands last.
  const Csv& errors = study.errors;
  for (std::size_t i = 0; i < errors.rows(); ++i) {
    if (errors.text(i, "scene") != scene || errors.text(i, "region") != "picture") continue;
    const auto row = row_of(errors.text(i, "variant"));
    if (row == rows.end()) continue;
    row->rmse = errors.number(i, "rmse");
    row->blurred = errors.number(i, "rmse_blur_1.5");
    row->flicker = errors.number(i, "flicker");
    row->averaged = errors.number(i, "rmse_exponential_average");
    row->averaged_blurred = errors.number(i, "rmse_exponential_average_blur_1.5");
  }
  return rows;
}

std::string words_for(const std::string& method) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"white",
       "white noise: new random numbers for every pixel and frame, what the others are held against"},
      {"mask-still", "one blue-noise mask, the same in every frame"},
      {"mask-moved", "the mask, moved by the step from frame to frame"},
      {"mask-golden", "the mask at rest, its values turned by the golden ratio from frame to frame"},
      {"stbn", "a spatiotemporal stack, a slice a frame: slices and each pixel's series are blue"},
      {"filtered", "a spatiotemporal stack made for a blur and an exponential average over time"},
      {"both", "a spatiotemporal stack made for both: blue series, and least error after blur and average"},
      {"slices", "the stack that was given, a slice a frame"},
      {"sort",
       "in each block the seeds are sorted like the mask by the light they gave; nothing is carried on"},
      {"retarget", "sort, and a tile carries the seeds to the places the next frame's mask has for them"},
      {"reproject", "retarget with the tile for the picture's motion"}};
  // The name without what differs from the options; else a stack's.
  const std::string plain = method.substr(0, std::min(method.find("-block-"), method.find("-by-light")));
  std::string words = method;
  for (const auto& [name, what] : kWords) {
    if (plain == name) words = what;
    if (plain == fmt::format("retarget-{}", name))
      words = fmt::format("retarget from slice to slice of the stack {}, each with a tile of its own", name);
  }
  if (const auto at = method.find("-block-"); at != std::string::npos)
    words += fmt::format("; blocks of {0} × {0} pixels", method.substr(at + 7));
  if (method.ends_with("-by-light")) words += "; sorted by the light alone, without the surface's colour";
  return words;
}

const MethodRow* best_of(const std::vector<MethodRow>& rows, std::size_t region) {
  const MethodRow* best = nullptr;
  for (const MethodRow& row : rows) {
    if (row.name == "white" || !(row.db[region] < -kScatter_db)) continue;
    if (best == nullptr || row.db[region] < best->db[region]) best = &row;
  }
  return best;
}

}  // namespace bn::report
