// Retarget pass: carry seeds that are sorted like the mask of frame t to where the mask of frame
// t+1 has the same levels, by one look-up a pixel in the baked permutation (Heitz and Belcour 2019,
// section 4.2). When the camera moves, the variant of the tile for the mean motion also carries them
// along with the picture, so that a seed meets a surface like the one it was sorted on.
//
// The tile is a bijection of its torus. The seed image is a whole number of tiles in each axis and
// wraps, so the pass is a bijection too, whatever the screen's size.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "bn/render.h"

namespace bn {
namespace {

constexpr std::int64_t kMotionUnit = 256;  // PixelMotion counts 1/256 pixel

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  return a / b - ((a % b != 0) && ((a < 0) != (b < 0)));
}

int rounded_mean(std::int64_t sum, std::int64_t count, int range) {
  if (count == 0) return 0;
  // floor(mean + 1/2), all in integers.
  const std::int64_t mean = floor_divide(2 * sum + kMotionUnit * count, 2 * kMotionUnit * count);
  return static_cast<int>(std::clamp<std::int64_t>(mean, -range, range));
}

std::size_t variants_of(int motion_range) {
  const auto side = static_cast<std::size_t>(2 * motion_range + 1);
  return side * side;
}

[[noreturn]] void refuse(std::string what, std::string limit) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = "textures",
               .limit = std::move(limit),
               .remedy = "take all textures from one bake"});
}

}  // namespace

void TemporalTextures::check() const {
  if (masks.empty() || masks.front().count() == 0) refuse("the mask is empty", "");
  for (const Grid<std::int32_t>& mask : masks) {
    if (mask.size() != size()) {
      refuse(fmt::format("a mask of {}x{} after {}x{}", mask.width(), mask.height(), size().width,
                         size().height),
             "masks of one size");
    }
    const auto [low, high] = std::minmax_element(mask.begin(), mask.end());
    if (*low < 0 || *high > 65535) refuse(fmt::format("mask levels {}..{}", *low, *high), "0..65535");
  }
  if (motion_range < 0 || motion_range > 8) refuse(fmt::format("motion range {}", motion_range), "0..8");
  const std::size_t tiles = masks.size() * variants_of(motion_range);
  if (!(moves.empty() && motion_range == 0) && moves.size() != tiles) {
    refuse(fmt::format("{} retarget tiles", moves.size()),
           fmt::format("{} for {} masks and motion range {}", tiles, masks.size(), motion_range));
  }
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Grid<Offset>& tile = moves[i];
    if (tile.size() != size()) {
      refuse(fmt::format("retarget tile {} is {}x{}", i, tile.width(), tile.height()),
             fmt::format("the mask's {}x{}", size().width, size().height));
    }
    std::vector<bool> taken(tile.count(), false);
    for (int y = 0; y < tile.height(); ++y) {
      for (int x = 0; x < tile.width(); ++x) {
        const int to_x = wrap(x + tile(x, y).x, tile.width());
        const int to_y = wrap(y + tile(x, y).y, tile.height());
        const auto to = static_cast<std::size_t>(to_y) * static_cast<std::size_t>(tile.width()) +
                        static_cast<std::size_t>(to_x);
        if (taken[to]) {
          refuse(fmt::format("retarget tile {} is no permutation: two seeds go to texel ({}, {})", i, to_x,
                             to_y),
                 "a bijection of the torus");
        }
        taken[to] = true;
      }
    }
  }
}

std::size_t TemporalTextures::mask_index(std::int64_t frame) const {
  return static_cast<std::size_t>(frame) % masks.size();
}

Offset TemporalTextures::shift(std::int64_t frame) const { return tile_shift(size(), step, frame); }

const Grid<Offset>& TemporalTextures::move(Offset motion, std::int64_t frame) const {
  const int side = 2 * motion_range + 1;
  const auto variant = static_cast<std::size_t>((motion.y + motion_range) * side + motion.x + motion_range);
  return moves.at(mask_index(frame) * variants_of(motion_range) + variant);
}

Offset tile_shift(Extent tile, Offset step, std::int64_t frame) {
  // Wrapped first: frame * step stays within 64 bits for any frame.
  const auto along = [&](int period, int d) {
    return wrap(wrap(frame, period) * std::int64_t{wrap(d, period)}, period);
  };
  return {along(tile.width, step.x), along(tile.height, step.y)};
}

Seeds retarget_seeds(const Seeds& seeds, const Grid<Offset>& move, Offset shift, const Execution& execution) {
  if (move.count() == 0 || seeds.width() % move.width() != 0 || seeds.height() % move.height() != 0) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("{}x{} seeds and a retarget tile of {}x{}", seeds.width(),
                                     seeds.height(), move.width(), move.height()),
                 .where = "retarget_seeds",
                 .limit = "sides of the seed image that are multiples of the tile's",
                 .remedy = "pad the seed image: padded_extent()"});
  }
  Seeds moved(seeds.size());
  parallel_for(execution, seeds.height(), [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    const int tile_y = wrap(std::int64_t{y} + shift.y, move.height());
    // Divisions are slow, and nearly no pixel needs one.
    const auto inside = [](int at, int side) { return at >= 0 && at < side ? at : wrap(at, side); };
    for (int x = 0, tile_x = wrap(shift.x, move.width()); x < seeds.width(); ++x) {
      const Offset by = move(tile_x, tile_y);
      moved(inside(x + by.x, seeds.width()), inside(y + by.y, seeds.height())) = seeds(x, y);
      if (++tile_x == move.width()) tile_x = 0;
    }
  });
  return moved;
}

Offset choose_motion(const Grid<PixelMotion>& motion, int range) {
  std::int64_t sum_x = 0;
  std::int64_t sum_y = 0;
  std::int64_t count = 0;
  for (const PixelMotion& pixel : motion) {
    if (pixel.x == kNoMotion) continue;
    sum_x += pixel.x;
    sum_y += pixel.y;
    ++count;
  }
  return {rounded_mean(sum_x, count, range), rounded_mean(sum_y, count, range)};
}

}  // namespace bn
