#include "bake/manifest.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "bn/error.h"
#include "bn/version.h"

namespace bn::baking {
namespace {

using Json = nlohmann::ordered_json;

/// JSON on one line, with spaces.
std::string on_one_line(const Json& value) {
  if (!value.is_structured()) return value.dump();
  std::string text(1, value.is_object() ? '{' : '[');
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (item != value.begin()) text += ", ";
    if (value.is_object()) text += Json(item.key()).dump() + ": ";
    text += on_one_line(*item);
  }
  return text + (value.is_object() ? '}' : ']');
}

/// JSON indented by two, with what fits on a line on one line.
void print(const Json& value, int indent, std::string& text) {
  constexpr std::size_t kWidth = 130;
  const std::string line = on_one_line(value);
  if (!value.is_structured() || value.empty() || (indent > 1 && indent * 2 + line.size() <= kWidth)) {
    text += line;
    return;
  }
  const std::string pad(static_cast<std::size_t>(indent + 1) * 2, ' ');
  text += value.is_object() ? "{\n" : "[\n";
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (item != value.begin()) text += ",\n";
    text += pad;
    if (value.is_object()) text += Json(item.key()).dump() + ": ";
    print(*item, indent + 1, text);
  }
  text += '\n';
  text.append(static_cast<std::size_t>(indent) * 2, ' ');
  text += value.is_object() ? '}' : ']';
}

double milliseconds(double seconds) { return std::round(seconds * 1000.0) / 1000.0; }

Json json_of(const TileRecord& tile) {
  return {{"motion", {tile.motion.x, tile.motion.y}},
          {"start_energy", tile.start_energy},
          {"energy", tile.energy},
          {"lower_bound", tile.lower_bound}};
}

TileRecord tile_of(const Json& json) {
  return {.motion = {json.at("motion").at(0).get<int>(), json.at("motion").at(1).get<int>()},
          .start_energy = json.at("start_energy").get<std::int64_t>(),
          .energy = json.at("energy").get<std::int64_t>(),
          .lower_bound = json.at("lower_bound").get<std::int64_t>()};
}

Value value_of(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_float()) return json.get<double>();
  if (json.is_number()) return json.get<std::int64_t>();
  if (json.is_array()) return json.get<std::vector<std::int64_t>>();
  return json.get<std::string>();
}

Json json_of(const JobRecord& job) {
  Json json{{"name", job.name}, {"kind", job.kind}};
  for (const auto& [key, value] : job.facts) {
    std::visit(
        [&, &name = key](const auto& held) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) json[name] = held;
        },
        value);
  }
  if (!job.notes.empty()) json["notes"] = job.notes;
  for (const FileRecord& file : job.files) {
    Json entry{{"path", file.path}, {"kind", file.kind}, {"pixel_hash", file.pixel_hash}};
    // A file has the tiles of one motion, one for each slice, or of all, in the order of `tiles`.
    if (!file.tiles.empty() && (file.tiles.size() == 1 || file.tiles.size() < job.tiles.size()))
      entry["motion"] = {file.tiles[0].motion.x, file.tiles[0].motion.y};
    json["files"].push_back(std::move(entry));
  }
  for (const TileRecord& tile : job.tiles) json["tiles"].push_back(json_of(tile));
  return json;
}

JobRecord job_of(const Json& json) {
  JobRecord job;
  job.name = json.at("name").get<std::string>();
  job.kind = json.at("kind").get<std::string>();
  for (const auto& [key, value] : json.items()) {
    if (key == "name" || key == "kind" || key == "notes" || key == "files" || key == "tiles") continue;
    job.facts.add(key, value_of(value));
  }
  if (json.contains("notes")) job.notes = json["notes"].get<std::vector<std::string>>();
  if (json.contains("tiles")) {
    for (const Json& tile : json["tiles"]) job.tiles.push_back(tile_of(tile));
  }
  for (const Json& entry : json.at("files")) {
    FileRecord file{.path = entry.at("path").get<std::string>(),
                    .kind = entry.at("kind").get<std::string>(),
                    .pixel_hash = entry.at("pixel_hash").get<std::string>(),
                    .tiles = job.tiles};
    if (entry.contains("motion")) {
      const Offset motion{entry["motion"].at(0).get<int>(), entry["motion"].at(1).get<int>()};
      std::erase_if(file.tiles, [&](const TileRecord& tile) { return tile.motion != motion; });
    }
    job.files.push_back(std::move(file));
  }
  return job;
}

}  // namespace

std::string manifest_text(const Manifest& manifest) {
  Json json{{"manifest_version", kManifestVersion},
            {"tool_version", kVersion},
            {"complete", manifest.complete},
            {"recipe", manifest.recipe},
            {"jobs", Json::array()},
            {"times", {{"unit", "seconds"}, {"jobs", Json::object()}}}};
  double total = 0.0;
  for (const JobRecord& job : manifest.jobs) {
    json["jobs"].push_back(json_of(job));
    json["times"]["jobs"][job.name] = milliseconds(job.seconds);
    total += job.seconds;
  }
  json["times"]["all_jobs"] = milliseconds(total);
  std::string text;
  print(json, 0, text);
  return text + "\n";
}

Manifest read_manifest(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  try {
    const Json json = Json::parse(text);
    if (json.at("manifest_version") != kManifestVersion) throw std::invalid_argument("of another version");
    Manifest manifest{.recipe = json.at("recipe").get<std::string>(),
                      .complete = json.at("complete").get<bool>(),
                      .jobs = {}};
    for (const Json& entry : json.at("jobs")) {
      manifest.jobs.push_back(job_of(entry));
      manifest.jobs.back().seconds = json.at("times").at("jobs").at(manifest.jobs.back().name).get<double>();
    }
    return manifest;
  } catch (const std::exception& error) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("no manifest that can be read: {}", error.what()),
                 .where = path.string(),
                 .limit = fmt::format("JSON, manifest_version {}", kManifestVersion),
                 .remedy = "delete it and bake again"});
  }
}

}  // namespace bn::baking
