// Sort pass: order the seeds of each block like the blue noise of this frame.
//
// Problem: the values just rendered are white noise over the block; the mask's levels there are blue
// noise. Both orders of the block's pixels are made, and the k-th seed of one is put on the k-th
// pixel of the other (a histogram transfer, Heitz and Belcour 2019, section 4.1). The same seed renders
// nearly the same value at a neighbour, so the values follow the seeds.
//
// A pixel is one 32-bit key, its quantity above, its index in the block in the low 8 bits; so keys are
// all different, and any sorting method, here std::sort and in the shader a network, finds the one
// order. Luminance is a non-negative float, whose bits order like its value; shifted left by one (the
// sign is 0), 16 of its 23 fraction bits stay. Two pixels nearer than 1/65536 of their value are
// equally dark for every purpose here.
//
// Pixels outside the screen get equal, greatest keys in both orders: they keep their seeds.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "bn/error.h"
#include "bn/random.h"
#include "bn/render.h"

namespace bn {
namespace {

constexpr std::uint32_t kIndexMask = 0xFFu;
constexpr std::uint32_t kInfinityBits = 0x7F800000u;
/// Stream number of random_bits() for the jitter of the block grid.
constexpr std::uint32_t kJitterStream = 0x52540001u;

std::uint32_t luminance_key(float luminance, std::uint32_t index) {
  const auto bits = std::bit_cast<std::uint32_t>(luminance);
  return ((bits > kInfinityBits ? 0u : bits << 1) & ~kIndexMask) | index;
}

std::uint32_t level_key(std::int32_t level, std::uint32_t index) {
  return static_cast<std::uint32_t>(level) << 8 | index;
}

void check_blocks(const SortBlocks& blocks) {
  const int side = blocks.side;
  if (side != 2 && side != 4 && side != 8 && side != 16) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("sort blocks of {} pixels", side),
                 .where = "block",
                 .limit = "2, 4, 8 or 16",
                 .remedy = ""});
  }
  const auto inside = [&](int value) { return value >= 0 && value < side; };
  if (!inside(blocks.origin.x) || !inside(blocks.origin.y)) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("block grid origin ({}, {})", blocks.origin.x, blocks.origin.y),
                 .where = "origin",
                 .limit = fmt::format("0..{}", side - 1),
                 .remedy = ""});
  }
}

}  // namespace

SortBlocks sort_blocks(int side, bool jitter, std::uint64_t seed, std::int64_t frame) {
  SortBlocks blocks{.side = side, .origin = {0, 0}};
  check_blocks(blocks);
  if (jitter) {
    const std::uint64_t bits = random_bits(seed, kJitterStream, static_cast<std::uint64_t>(frame));
    const auto below = [&](std::uint64_t word) {
      return static_cast<int>(
          random_below(static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(side)));
    };
    blocks.origin = {below(bits), below(bits >> 32)};
  }
  return blocks;
}

void sort_seeds(Seeds& seeds, const Grid<float>& luminance, const Grid<std::int32_t>& mask, Offset shift,
                const SortBlocks& blocks, const Execution& execution) {
  check_blocks(blocks);
  if (seeds.width() < luminance.width() || seeds.height() < luminance.height() || mask.count() == 0) {
    throw Error(
        {.code = ErrorCode::invalid_input,
         .what = fmt::format("{}x{} seeds for a screen of {}x{}, mask {}x{}", seeds.width(), seeds.height(),
                             luminance.width(), luminance.height(), mask.width(), mask.height()),
         .where = "sort_seeds",
         .limit = "seeds no smaller than the screen, a mask that is not empty",
         .remedy = ""});
  }
  const int side = blocks.side;
  const int columns = (luminance.width() + blocks.origin.x + side - 1) / side;
  const int rows = (luminance.height() + blocks.origin.y + side - 1) / side;
  parallel_for(execution, rows, [&](std::int64_t row) {
    std::array<std::uint32_t, 256> darkest;
    std::array<std::uint32_t, 256> lowest;
    std::array<std::uint32_t, 256> block_seeds;
    for (int column = 0; column < columns; ++column) {
      const int left = column * side - blocks.origin.x;
      const int top = static_cast<int>(row) * side - blocks.origin.y;
      const auto pixel = [&](std::uint32_t index) {
        return Offset{left + static_cast<int>(index) % side, top + static_cast<int>(index) / side};
      };
      std::size_t count = 0;
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(side * side); ++i) {
        const auto [x, y] = pixel(i);
        if (x < 0 || y < 0 || x >= luminance.width() || y >= luminance.height()) continue;
        darkest[count] = luminance_key(luminance(x, y), i);
        lowest[count] = level_key(mask.torus(x + shift.x, y + shift.y), i);
        block_seeds[i] = seeds(x, y);
        ++count;
      }
      std::sort(darkest.begin(), darkest.begin() + static_cast<std::ptrdiff_t>(count));
      std::sort(lowest.begin(), lowest.begin() + static_cast<std::ptrdiff_t>(count));
      for (std::size_t k = 0; k < count; ++k) {
        const auto [x, y] = pixel(lowest[k] & kIndexMask);
        seeds(x, y) = block_seeds[darkest[k] & kIndexMask];
      }
    }
  });
}

}  // namespace bn
