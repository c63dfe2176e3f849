#include "report/retarget_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bn/error.h"

namespace bn::report {
namespace {

Grid<std::int32_t> slice_of_levels(const Grid<std::int32_t>& levels, int z) {
  Grid<std::int32_t> slice(levels.size());
  std::copy_n(levels.slice(z).begin(), slice.count(), slice.begin());
  return slice;
}

/// The masks of the frame that a tile starts from and of the next.
struct FrameLevels {
  Grid<std::int32_t> from, to;
};
FrameLevels frame_levels(const RetargetSet& set, int slice) {
  return {slice_of_levels(*set.levels, slice),
          set.to ? slice_of_levels(*set.to, slice) : slice_of_levels(*set.levels, (slice + 1) % set.slices)};
}

/// Of several channels, or of a residual seen through a filter: no sum over the pixels of one mask. Recipes
/// of ours have a key a line.
bool is_another_energy(const Metadata& metadata) {
  if (metadata.algorithm != "retarget-anneal") return false;
  const auto value_of = [&](std::string_view key) {
    const auto at = metadata.recipe.find(fmt::format("\n{} = ", key));
    if (at == std::string::npos) return std::string();
    const auto begin = at + key.size() + 4;
    return metadata.recipe.substr(begin, metadata.recipe.find('\n', begin) - begin);
  };
  const std::string filter = value_of("residual_sigma");
  return value_of("channels").find(',') != std::string::npos || !value_of("weights").empty() ||
         (!filter.empty() && filter != "0.0");
}

}  // namespace

RetargetOptions options_of(const Metadata& metadata, Offset motion) {
  const Facts& facts = metadata.facts;
  RetargetOptions options;
  options.step = *facts.get<Offset>("step");
  options.motion = motion;
  options.radius = *facts.get<int>("radius");
  options.reach = facts.get<std::string>("reach") == "euclidean" ? Reach::euclidean : Reach::chebyshev;
  options.metric = facts.get<std::string>("metric") == "l2" ? Metric::l2 : Metric::l1;
  options.wrap = facts.get<bool>("wrap").value_or(true);
  return options;
}

const RetargetSet::Tile& main_tile(const RetargetSet& set) {
  const RetargetSet::Tile* shown = nullptr;
  for (const auto& tile : set.tiles) {
    if (tile.record.motion != Offset{0, 0}) continue;
    if (shown == nullptr || tile.record.energy > shown->record.energy) shown = &tile;
  }
  return shown != nullptr ? *shown : set.tiles.front();
}

std::vector<const RetargetSet::Tile*> tiles_of(const RetargetSet& set, Offset motion) {
  std::vector<const RetargetSet::Tile*> tiles;
  for (const auto& tile : set.tiles) {
    if (tile.record.motion == motion) tiles.push_back(&tile);
  }
  return tiles;
}

Audit audit(const RetargetSet& set) {
  Audit result;
  if (!set.levels) {
    result.why_not = "the mask is missing";
  } else if (is_another_energy(set.metadata)) {
    result.why_not = "it is of several channels or of a filtered residual; bn verify does";
  }
  result.recomputed = result.why_not.empty();
  for (const auto& [record, move, slice] : set.tiles) {
    const RetargetOptions options = options_of(set.metadata, record.motion);
    result.optimal += record.energy == record.lower_bound;
    try {
      check_permutation(move, options);
      ++result.permutations;
      if (!result.recomputed) continue;
      const FrameLevels levels = frame_levels(set, slice);
      result.energies += retarget_energy({levels.from, levels.to}, move, options) == record.energy;
    } catch (const Error& error) {
      if (result.fault.empty()) result.fault = error.what();
    }
  }
  return result;
}

Grid<double> residual_of(const RetargetSet& set, const RetargetSet::Tile& tile) {
  const FrameLevels levels = frame_levels(set, tile.slice);
  const Offset step = *set.metadata.facts.get<Offset>("step");
  Grid<double> residual(tile.move.size());
  for (int y = 0; y < residual.height(); ++y) {
    for (int x = 0; x < residual.width(); ++x) {
      const Offset r = tile.move(x, y);
      residual(x, y) =
          levels.from(x, y) - levels.to.torus(std::int64_t{x} + r.x + step.x, std::int64_t{y} + r.y + step.y);
    }
  }
  return residual;
}

std::vector<std::vector<double>> repeated(const RetargetSet& set, Offset motion) {
  const auto tiles = tiles_of(set, motion);
  const Offset step = *set.metadata.facts.get<Offset>("step");
  Grid<std::int32_t> screen = slice_of_levels(*set.levels, 0), next(screen.size());
  std::vector<std::vector<double>> result{{screen.begin(), screen.end()}};
  const int frames = set.to ? 1 : kRepeats.back();  // between two masks there is one
  for (int t = 0; t < frames; ++t) {
    const Grid<Offset>& move = tiles[static_cast<std::size_t>(t) % tiles.size()]->move;
    for (int y = 0; y < screen.height(); ++y) {
      for (int x = 0; x < screen.width(); ++x) {
        const Offset r = move.torus(x + std::int64_t{t} * step.x, y + std::int64_t{t} * step.y);
        next(wrap(x + r.x, screen.width()), wrap(y + r.y, screen.height())) = screen(x, y);
      }
    }
    std::swap(screen, next);
    if (std::find(kRepeats.begin(), kRepeats.end(), t + 1) != kRepeats.end())
      result.emplace_back(screen.begin(), screen.end());
  }
  return result;
}

}  // namespace bn::report
