// Seeds: one 32-bit number a pixel, the only source of randomness of what is rendered there.
//
// The temporal algorithm moves seeds and never makes new ones, so the multiset of seeds is an
// invariant of every pass. To make a lost or doubled seed visible, the initial seeds are all
// different, and a digest sums a 64-bit hash of each: blind to order, sensitive to anything else.

#include <fmt/format.h>

#include "bn/error.h"
#include "bn/render.h"

namespace bn {

Extent padded_extent(Extent screen, Extent tile) {
  if (screen.width < 1 || screen.height < 1 || screen.width > 65536 || screen.height > 65536) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("a screen of {}x{} pixels", screen.width, screen.height),
                 .where = "size",
                 .limit = "sides of 1..65536 pixels",
                 .remedy = ""});
  }
  if (tile.width < 1 || tile.height < 1) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "an empty tile",
                 .where = "textures",
                 .limit = "",
                 .remedy = "bake a mask first"});
  }
  const auto up = [](int side, int period) { return (side + period - 1) / period * period; };
  return {up(screen.width, tile.width), up(screen.height, tile.height)};
}

Seeds initial_seeds(Extent size, std::uint32_t start) {
  Seeds seeds(size);
  for (std::size_t i = 0; i < seeds.count(); ++i) seeds[i] = pcg_hash(start + static_cast<std::uint32_t>(i));
  return seeds;
}

std::uint64_t multiset_digest(const Seeds& seeds) {
  std::uint64_t sum = 0;
  for (const std::uint32_t seed : seeds) {
    // Two rounds of the 64-bit finaliser of splitmix: sums of raw seeds would hide exchanges.
    std::uint64_t x = seed + 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    sum += x ^ (x >> 31);
  }
  return sum;
}

}  // namespace bn
