// bn study temporal: the tables of docs/validation.md that need no renderer.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "bn/retarget.h"
#include "bn_study/models.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSeeds = 8;
constexpr std::array kFrames{1, 3, 8, 16, 32, 64};

struct Line {
  std::string name;
  std::vector<Grid<Offset>> tiles;  ///< one, or one for each of several runs of a random search
  int block = 8;
  bool retarget = true;
  bool jitter = false;
};

double mean_length(const Grid<Offset>& tile) {
  double sum = 0.0;
  for (const Offset& move : tile) sum += std::hypot(move.x, move.y);
  return sum / static_cast<double>(tile.count());
}

/// Tiles on a flat picture, seeds and tiles averaged.
Json tile_rows(const TemporalTextures& base, Session& session) {
  const auto proven = [&](int radius) {
    return std::vector{solve_retarget(base.mask(0), {.step = base.step, .radius = radius}).move};
  };
  const auto swapped = [&](int radius, std::int64_t energy) {
    std::vector<Grid<Offset>> tiles;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
      tiles.push_back(swapped_tile(base.mask(0), base.step, radius, energy, seed));
    return tiles;
  };
  std::vector<Line> lines{{"sort only", proven(6), 8, false},
                          {"sort only", proven(6), 16, false},
                          {"proven, radius 6", proven(6), 2},
                          {"proven, radius 6", proven(6), 4},
                          {"proven, radius 6", proven(6), 8},
                          {"proven, radius 6", proven(6), 16},
                          {"the same, blocks moved", proven(6), 8, true, true},
                          {"the same, blocks moved", proven(6), 16, true, true},
                          {"swaps, radius 6", swapped(6, 40000)},
                          {"swaps, radius 6", swapped(6, 20000)},
                          {"swaps, radius 6, published", swapped(6, 10714)},
                          {"swaps, radius 6, published", swapped(6, 9444)},
                          {"swaps, radius 6", swapped(6, 8000)},
                          {"swaps, radius 10", swapped(10, 9444)},
                          {"proven, radius 2", proven(2)},
                          {"proven, radius 3", proven(3)},
                          {"proven, radius 4", proven(4)},
                          {"proven, radius 8", proven(8)},
                          {"proven, radius 10", proven(10)},
                          {"proven, radius 12", proven(12)}};
  Json rows = Json::array();
  for (const Line& line : lines) {
    std::array<double, kFrames.size()> db{};
    for (int run = 0; run < kSeeds; ++run) {
      throw_if_stopped(session.execution);
      TemporalTextures textures = base;
      textures.moves = {line.tiles[static_cast<std::size_t>(run) % line.tiles.size()]};
      textures.motion_range = 0;
      const auto power = run_flat_model({.block = line.block,
                                         .jitter = line.jitter,
                                         .retarget = line.retarget,
                                         .frames = kFrames.back(),
                                         .seed = static_cast<std::uint64_t>(run + 1)},
                                        textures)
                             .power_db;
      for (std::size_t i = 0; i < kFrames.size(); ++i)
        db[i] += power[static_cast<std::size_t>(kFrames[i])] / kSeeds;
    }
    const Grid<Offset>& tile = line.tiles.front();
    Json row{{"tile", line.name}};
    if (line.retarget) {
      row["energy"] = retarget_energy(base.mask(0), tile, {.step = base.step, .radius = 16});
      row["mean_move"] = mean_length(tile);
    }
    row["block"] = line.block;
    row["frames"] = kFrames;
    row["db"] = db;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string tile_markdown(const Json& rows) {
  std::string text = "| tile | energy | mean move | block |";
  for (const int frame : kFrames) text += fmt::format(" {} |", frame);
  text += "\n|---|---|---|---|";
  for (std::size_t i = 0; i < kFrames.size(); ++i) text += "---|";
  text += "\n";
  for (const Json& row : rows) {
    text += fmt::format("| {} |", row["tile"].get<std::string>());
    text += row.contains("energy") ? fmt::format(" {} | {:.1f} |", row["energy"].get<std::int64_t>(),
                                                 row["mean_move"].get<double>())
                                   : " | |";
    text += fmt::format(" {} |", row["block"].get<int>());
    for (const Json& value : row["db"]) text += fmt::format(" {:.1f} |", value.get<double>());
    text += "\n";
  }
  return text;
}

constexpr std::array kLateFrames{8, 16, 32, 64};

Json stack_rows(const TemporalTextures& base, Session& session) {
  Json rows = Json::array();
  for (const StackRow& row : study_stacks(base, kLateFrames, session.execution)) {
    rows.push_back({{"masks", row.masks},
                    {"floor_db", row.floor_db},
                    {"radius", row.radius},
                    {"block", row.block},
                    {"energy", row.energy},
                    {"frames", kLateFrames},
                    {"db", row.db},
                    {"averaged_db", row.averaged_db},
                    {"averaged_blurred_db", row.averaged_blurred_db}});
  }
  return rows;
}

std::string stack_markdown(const Json& rows) {
  std::string text = "| masks | floor | radius | block | energy |";
  for (const char* what : {"frame", "averaged,", "averaged and blurred,"}) {
    for (const int frame : kLateFrames) text += fmt::format(" {} {} |", what, frame);
  }
  text += "\n|---|---|---|---|---|";
  for (std::size_t i = 0; i < 3 * kLateFrames.size(); ++i) text += "---|";
  text += "\n";
  for (const Json& row : rows) {
    text += fmt::format("| {} | {:.1f} | {} | {} | {:.0f} |", row["masks"].get<std::string>(),
                        row["floor_db"].get<double>(), row["radius"].get<int>(), row["block"].get<int>(),
                        row["energy"].get<double>());
    for (const char* what : {"db", "averaged_db", "averaged_blurred_db"}) {
      for (const Json& value : row[what]) text += fmt::format(" {:.1f} |", value.get<double>());
    }
    text += "\n";
  }
  return text;
}

/// The poster model: plain and reprojected retarget, over pans, tiles, edges and what is sorted by.
Json pan_rows(const TemporalTextures& base, Session& session) {
  Json rows = Json::array();
  for (const int radius : {10, 6, 2, 1}) {
    TemporalTextures textures = base;
    textures.motion_range = 4;
    textures.moves.clear();
    for (RetargetTile& tile :
         solve_motion_set(base.mask(0), {.step = base.step, .radius = radius}, 4, session.execution))
      textures.moves.push_back(std::move(tile.move));
    for (const auto edge : {PosterModel::Edge::colour, PosterModel::Edge::surface}) {
      for (const bool by_light : {false, true}) {
        for (const double pan : {0.0, 1.0, 1.25, 4.0, 11.0}) {
          std::array<double, 2> db{}, crossing{};
          for (const bool reproject : {false, true}) {
            for (int seed = 1; seed <= kSeeds; ++seed) {
              throw_if_stopped(session.execution);
              const PosterRun run = run_poster_model({.pan_px = pan,
                                                      .edge = edge,
                                                      .reproject = reproject,
                                                      .sort_by_light = by_light,
                                                      .seed = static_cast<std::uint64_t>(seed)},
                                                     textures);
              const auto half = static_cast<std::ptrdiff_t>(run.power_db.size() / 2);
              for (auto at = run.power_db.begin() + half; at != run.power_db.end(); ++at)
                db[reproject] +=
                    *at / static_cast<double>(run.power_db.end() - run.power_db.begin() - half) / kSeeds;
              crossing[reproject] += run.crossing / kSeeds;
            }
          }
          rows.push_back({{"radius", radius},
                          {"edges_of", edge == PosterModel::Edge::colour ? "colour" : "surface"},
                          {"sorted_by", by_light ? "light" : "value"},
                          {"pan_px", pan},
                          {"plain_db", db[0]},
                          {"reprojected_db", db[1]},
                          {"plain_crossing", crossing[0]},
                          {"reprojected_crossing", crossing[1]}});
        }
      }
    }
  }
  return rows;
}

std::string pan_markdown(const Json& rows) {
  std::string text =
      "| radius | edges of | sorted by | pan, pixels a frame | plain, dB | reprojected, dB | gain | seeds "
      "that cross an edge: plain | reprojected |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const Json& row : rows) {
    const auto number = [&](const char* name) { return row[name].get<double>(); };
    text += fmt::format("| {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} % | {:.1f} % |\n",
                        row["radius"].get<int>(), row["edges_of"].get<std::string>(),
                        row["sorted_by"].get<std::string>(), number("pan_px"), number("plain_db"),
                        number("reprojected_db"), number("plain_db") - number("reprojected_db"),
                        100.0 * number("plain_crossing"), 100.0 * number("reprojected_crossing"));
  }
  return text;
}

}  // namespace

Verb study_temporal_verb() {
  Verb verb;
  verb.name = "study temporal";
  verb.summary = "Measure what retarget tiles bring on model pictures whose error is known exactly.";
  verb.examples = {{"bn study temporal", "the tables of docs/validation.md, some minutes"}};
  verb.details =
      "Power of the error at 0 < f <= 0.1 cycles per pixel against white noise, dB, the mean of eight sets "
      "of seeds. "
      "First tiles on a flat picture of 256 x 256, by frame; then one moved mask against stacks of masks "
      "there, also by the error of an exponential average (0.1), without and with a blur of 1.5 pixels, "
      "against "
      "white noise's; then a poster under a pan, where plain and "
      "reprojected "
      "retarget are compared by radius, kind of edge, what is sorted by, and speed, frames 8 to 16. Mask and "
      "tiles "
      "are made on the spot: 64 x 64, 8 bit.";
  const auto json = std::make_shared<bool>(false);
  verb.arguments.flag("--json", *json, true, "Print the rows of all tables as JSON.");
  verb.run = [json](Session& session) {
    const TemporalTextures base = make_temporal_textures(0, session.execution);
    const Json tiles = tile_rows(base, session);
    if (!*json) session.output.write(tile_markdown(tiles) + "\n");
    const Json stacks = stack_rows(base, session);
    if (!*json) session.output.write(stack_markdown(stacks) + "\n");
    const Json pans = pan_rows(base, session);
    if (*json)
      return session.output.write_result({{"tiles", tiles}, {"stacks", stacks}, {"pans", pans}}, true);
    session.output.write(pan_markdown(pans));
  };
  return verb;
}

}  // namespace bn::tools
