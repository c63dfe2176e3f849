// Retarget tiles as permutations: the check that a tile is a bijection within reach, and its inverse.
//
// A tile moves the seed at u to u + R(u) on the torus. It is a bijection iff no two seeds arrive at one
// pixel, which one pass over an array of arrivals decides.

#include <fmt/format.h>

#include "bn/error.h"
#include "retarget/problem.h"

namespace bn {
using namespace retarget;
namespace {

constexpr std::int64_t kNobody = -1;

[[noreturn]] void fail(std::int64_t pixel, int width, std::string what, std::string limit) {
  throw Error({.code = ErrorCode::verification_failed,
               .what = std::move(what),
               .where = fmt::format("pixel ({}, {})", pixel % width, pixel / width),
               .limit = std::move(limit),
               .remedy = ""});
}

/// For each pixel the index of the seed that arrives there; throws at the second arrival at one pixel.
std::vector<std::int64_t> arrivals(const Grid<Offset>& move) {
  const auto [width, height] = move.size();
  std::vector<std::int64_t> from(move.count(), kNobody);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Offset r = move(x, y);
      const int to_x = wrap(std::int64_t{x} + r.x, width);
      const int to_y = wrap(std::int64_t{y} + r.y, height);
      const std::int64_t pixel = std::int64_t{y} * width + x;
      auto& first = from[static_cast<std::size_t>(std::int64_t{to_y} * width + to_x)];
      if (first != kNobody) {
        fail(pixel, width,
             fmt::format(
                 "no bijection: moves by ({}, {}) to ({}, {}), where the seed of pixel ({}, {}) also goes",
                 r.x, r.y, to_x, to_y, first % width, first / width),
             "one seed for each pixel");
      }
      first = pixel;
    }
  }
  return from;
}

}  // namespace

void check_permutation(const Grid<Offset>& move, const RetargetOptions& options) {
  check_options(options);
  const auto [width, height] = move.size();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::int64_t pixel = std::int64_t{y} * width + x;
      const Offset r = move(x, y);
      const std::int64_t k_x = std::int64_t{r.x} - options.motion.x;
      const std::int64_t k_y = std::int64_t{r.y} - options.motion.y;
      const std::int64_t radius = options.radius;
      const bool near = k_x >= -radius && k_x <= radius && k_y >= -radius && k_y <= radius;
      if (!near || !within_reach({static_cast<int>(k_x), static_cast<int>(k_y)}, options)) {
        fail(pixel, width,
             fmt::format("moves by ({}, {}), out of reach of the motion ({}, {})", r.x, r.y, options.motion.x,
                         options.motion.y),
             fmt::format("radius {}, {}", options.radius,
                         options.reach == Reach::euclidean ? "euclidean" : "chebyshev"));
      }
      const std::int64_t to_x = wrap(std::int64_t{x} + options.step.x, width) + k_x;
      const std::int64_t to_y = wrap(std::int64_t{y} + options.step.y, height) + k_y;
      const bool inside = to_x >= 0 && to_x < width && to_y >= 0 && to_y < height;
      if (!options.wrap && !inside) {
        fail(pixel, width, fmt::format("moves by ({}, {}), across the tile's border", r.x, r.y),
             "inside the tile, as wrap is off");
      }
    }
  }
  arrivals(move);
}

Grid<Offset> invert_moves(const Grid<Offset>& move) {
  const std::vector<std::int64_t> from = arrivals(move);
  Grid<Offset> gather(move.size());
  for (std::size_t to = 0; to < from.size(); ++to) {
    const Offset r = move[static_cast<std::size_t>(from[to])];
    gather[to] = {-r.x, -r.y};
  }
  return gather;
}

}  // namespace bn
