#include "tools/records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bn::tools {

Json to_json(Offset offset) { return Json::array({offset.x, offset.y}); }

Json to_json(Extent size) { return Json::array({size.width, size.height}); }

Json to_json(const Facts& facts) {
  Json json = Json::object();
  for (const auto& [key, value] : facts) {
    std::visit(
        [&, &name = key](const auto& held) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) json[name] = held;
        },
        value);
  }
  return json;
}

Json to_json(const TileRecord& tile) {
  return {{"motion", to_json(tile.motion)},
          {"start_energy", tile.start_energy},
          {"energy", tile.energy},
          {"lower_bound", tile.lower_bound},
          {"optimal", tile.energy == tile.lower_bound}};
}

Json to_json(const FileRecord& file) {
  return {{"path", file.path}, {"kind", file.kind}, {"pixel_hash", file.pixel_hash}};
}

namespace {

template <class T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(to_json(item));
  return list;
}

}  // namespace

Json to_json(const JobRecord& job) {
  Json json{{"kind", job.kind},
            {"name", job.name},
            {"skipped", job.skipped},
            {"seconds", rounded_seconds(job.seconds)}};
  json.update(to_json(job.facts));
  json["files"] = list_of(job.files);
  if (!job.tiles.empty()) json["tiles"] = list_of(job.tiles);
  if (!job.notes.empty()) json["notes"] = job.notes;
  return json;
}

Json to_json(const PlannedJob& job) {
  return {{"kind", job.kind},
          {"name", job.name},
          {"up_to_date", job.up_to_date},
          {"estimated_seconds", rounded_seconds(job.estimated_seconds)},
          {"memory_bytes", job.memory_bytes},
          {"files", job.files}};
}

Json to_json(const VerifyItem& item) {
  return {{"file", item.file.string()}, {"check", item.check}, {"pass", item.pass}, {"detail", item.detail}};
}

std::string energy_text(const std::vector<TileRecord>& tiles) {
  if (tiles.empty()) return "";
  const auto [least, greatest] = std::minmax_element(
      tiles.begin(), tiles.end(), [](const auto& a, const auto& b) { return a.energy < b.energy; });
  double worst_gap = 0.0;
  // A bound of 0 says nothing: annealing a residual or a volume proves none.
  const bool bounded = std::all_of(tiles.begin(), tiles.end(),
                                   [](const auto& tile) { return tile.lower_bound > 0 || tile.energy == 0; });
  for (const auto& tile : tiles) {
    const auto excess = static_cast<double>(tile.energy - tile.lower_bound);
    if (excess > 0)
      worst_gap =
          std::max(worst_gap, excess / static_cast<double>(std::max<std::int64_t>(tile.lower_bound, 1)));
  }
  std::string text = tiles.size() == 1
                         ? fmt::format("{}", least->energy)
                         : fmt::format("{}..{} over {} tiles", least->energy, greatest->energy, tiles.size());
  if (!bounded) return text;
  // Rounded up: the claim must hold.
  text += worst_gap == 0.0
              ? ", proven optimal"
              : fmt::format(", at most {:.2f} % above the optimum", std::ceil(worst_gap * 1e4) / 1e2);
  return text;
}

double rounded_seconds(double seconds) { return std::round(seconds * 1e4) / 1e4; }

}  // namespace bn::tools
