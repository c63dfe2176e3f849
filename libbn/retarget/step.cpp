// The dither step: how long its orbit on the torus is, and the step that `auto` stands for.
//
// Frame t reads the mask at p + t*d. On an axis of length n the multiples of d repeat after n / gcd(n, d)
// frames, on the torus after the least common multiple of both axes' periods. The plastic number g places
// successive offsets far apart in two dimensions (the R2 sequence of M. Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018); `auto` takes the nearest integer step of longest orbit.

#include <fmt/format.h>

#include <numeric>

#include "bn/error.h"
#include "bn/retarget.h"

namespace bn {
namespace {

void check_size(Extent size) {
  if (size.width >= 1 && size.height >= 1) return;
  throw Error({.code = ErrorCode::invalid_input,
               .what = fmt::format("a tile of {}x{}", size.width, size.height),
               .where = "size",
               .limit = "at least 1x1",
               .remedy = ""});
}

/// `period` / `divisor` in 1/2^16 pixels, rounded. IEEE division and multiplication only, so the integer
/// is the same on every machine.
std::int64_t fixed_point(int period, double divisor) {
  return static_cast<std::int64_t>(period / divisor * 65536.0 + 0.5);
}

/// No step on ring `ring` or beyond is nearer to the target than this (squared, fixed point): rings are
/// counted from the target rounded down.
std::int64_t nearest_beyond(std::int64_t ring) { return ((ring - 1) << 16) * ((ring - 1) << 16); }

}  // namespace

std::int64_t orbit_length(Extent size, Offset step) {
  check_size(size);
  const std::int64_t period_x = size.width / std::gcd(size.width, wrap(step.x, size.width));
  const std::int64_t period_y = size.height / std::gcd(size.height, wrap(step.y, size.height));
  return std::lcm(period_x, period_y);
}

AutoStep auto_step(Extent size) {
  check_size(size);
  constexpr double kPlastic = 1.32471795724474602596;
  const std::int64_t target_x = fixed_point(size.width, kPlastic);
  const std::int64_t target_y = fixed_point(size.height, kPlastic * kPlastic);
  const std::int64_t centre_x = target_x >> 16, centre_y = target_y >> 16;
  const std::int64_t longest = std::lcm<std::int64_t>(size.width, size.height);

  // Square rings around the target, outwards, until none further out can be nearer. The step (1, 1) has
  // the longest orbit, or (0, 0) on one pixel, so the search ends.
  AutoStep best{{0, 0}, orbit_length(size, {0, 0})};
  std::int64_t best_distance = -1;
  for (std::int64_t ring = 0; best_distance < 0 || nearest_beyond(ring) <= best_distance; ++ring) {
    for (std::int64_t y = centre_y - ring; y <= centre_y + ring; ++y) {
      if (y < 0 || y >= size.height) continue;
      const bool edge = y == centre_y - ring || y == centre_y + ring;
      const std::int64_t stride = edge || ring == 0 ? 1 : 2 * ring;
      for (std::int64_t x = centre_x - ring; x <= centre_x + ring; x += stride) {
        if (x < 0 || x >= size.width) continue;
        const Offset step{static_cast<int>(x), static_cast<int>(y)};
        if (orbit_length(size, step) != longest) continue;
        const std::int64_t dx = (x << 16) - target_x, dy = (y << 16) - target_y;
        const std::int64_t distance = dx * dx + dy * dy;
        const bool lower = y < best.step.y || (y == best.step.y && x < best.step.x);
        if (best_distance < 0 || distance < best_distance || (distance == best_distance && lower)) {
          best = {step, longest};
          best_distance = distance;
        }
      }
    }
  }
  return best;
}

}  // namespace bn
