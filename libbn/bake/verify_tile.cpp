// Retarget tiles of other programs: what they do, and how far they are from the optimum. Nothing of their
// making is known, so everything is measured on the mask that they are said to be for.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bake/inputs.h"
#include "bn/bake.h"
#include "bn/error.h"

namespace bn {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, std::string what, std::string limit, std::string remedy) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = file.string(),
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

/// The moves as they are stored, the level that means 0 taken off.
Grid<Offset> stored_moves(const ForeignTile& tile, const Execution& execution) {
  const Image image = read_image(tile.tile, execution).image;
  const bool integers = image.type == SampleType::u8 || image.type == SampleType::u16;
  if (image.channels < 2 || image.depth > 1 || !integers) {
    refuse(tile.tile,
           fmt::format("{} {} channels of {}", image.depth > 1 ? "a volume of" : "", image.channels,
                       name_of(image.type)),
           "8bit or 16bit with x in red and y in green", "");
  }
  const ChannelSamples x = samples_of_channel(image, 0), y = samples_of_channel(image, 1);
  Grid<Offset> moves(image.size);
  for (std::size_t i = 0; i < moves.count(); ++i) {
    moves[i] = {static_cast<int>(x.value[i]) - tile.zero_level,
                static_cast<int>(y.value[i]) - tile.zero_level};
  }
  return moves;
}

Grid<std::int32_t> mask_levels(const fs::path& file, int channel, Extent size, const Execution& execution) {
  const Image image = read_image(file, execution).image;
  Grid<std::int32_t> levels = levels_of_channel(image, channel).value;
  if (levels.size() != size || image.depth > 1) {
    refuse(file, fmt::format("{}x{} pixels, {} slices", levels.width(), image.size.height, image.depth),
           fmt::format("{}x{} in one slice, as the tile", size.width, size.height), "");
  }
  return levels;
}

/// How far the moves reach beyond the motion, in the measure of `reach`, rounded up.
int farthest_move(const Grid<Offset>& moves, const ForeignTile& tile) {
  int farthest = 0;
  for (const Offset& r : moves) {
    const int x = std::abs(r.x - tile.motion.x), y = std::abs(r.y - tile.motion.y);
    const int length = tile.reach == Reach::chebyshev
                           ? std::max(x, y)
                           : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(x * x + y * y))));
    farthest = std::max(farthest, length);
  }
  return farthest;
}

/// Two numbers of the tile name the stored offset: moves of -6..6 stored from 0 on read as -128..-116.
std::string encoding_hint(const Grid<Offset>& moves, const ForeignTile& tile) {
  int low = 1 << 16, high = -low;
  for (const Offset& r : moves) {
    low = std::min({low, r.x, r.y});
    high = std::max({high, r.x, r.y});
  }
  const int centre = (low + high) / 2;
  if (std::abs(centre) <= (high - low) / 2) return "";
  return fmt::format("; the moves are {}..{}, so is it stored as plus{}?", low, high,
                     tile.zero_level + centre);
}

std::string percent(std::int64_t part, std::int64_t of) {
  if (of == 0) return part == 0 ? "0 %" : "more than all";
  return fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(of));
}

}  // namespace

std::vector<VerifyItem> verify_tile(const ForeignTile& tile, const Execution& execution) {
  Grid<Offset> move = stored_moves(tile, execution);
  const Grid<std::int32_t> from = mask_levels(tile.mask, tile.channel, move.size(), execution);
  const Grid<std::int32_t> to =
      tile.to.empty() ? from : mask_levels(tile.to, tile.channel, move.size(), execution);
  std::vector<VerifyItem> items;
  const auto add = [&](const char* check, bool pass, std::string detail) {
    items.push_back({.file = tile.tile, .check = check, .pass = pass, .detail = std::move(detail)});
  };
  try {
    const Grid<Offset> inverse = invert_moves(move);
    if (tile.form == MoveForm::gather) move = inverse;
    add("bijection", true, fmt::format("{} pixels", move.count()));
  } catch (const Error& error) {
    add("bijection", false, error.what());
    return items;
  }
  constexpr int kMostRadius = 32;
  const int farthest = farthest_move(move, tile);
  const int radius = tile.radius > 0 ? tile.radius : std::max(1, farthest);
  const bool within = farthest <= radius && radius <= kMostRadius;
  add("radius", within,
      fmt::format("the farthest move is {} pixels, {}{}", farthest, name_of(tile.reach),
                  within || tile.radius > kMostRadius ? "" : encoding_hint(move, tile)));
  const RetargetOptions options{.step = tile.step,
                                .motion = tile.motion,
                                .radius = std::min(radius, kMostRadius),
                                .reach = tile.reach,
                                .metric = tile.metric};
  const std::int64_t energy = retarget_energy({from, to}, move, options);
  const std::int64_t start = retarget_energy({from, to}, Grid<Offset>(move.size(), tile.motion), options);
  add("energy", true,
      fmt::format("{}, {} of {} without moves{}", energy, percent(energy, start), start,
                  energy > start ? "; is the step another, or the form?" : ""));
  if (!within) return items;
  const RetargetTile optimum = solve_retarget({from, to}, options, execution);
  add("bound", true,
      fmt::format("the optimum of radius {} is {}; the tile is {} above it", options.radius, optimum.energy,
                  percent(energy - optimum.energy, optimum.energy)));
  return items;
}

}  // namespace bn
