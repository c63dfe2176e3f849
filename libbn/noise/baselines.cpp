// The patterns that blue-noise masks are compared with, as ranks.
//
// Each has a value per pixel; the rank of the value, ties by index, makes it a mask like any other, so that
// one analysis fits all. Values are integers of 64 bits wherever the pattern allows, which makes the order
// exact.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "bn/error.h"
#include "bn/noise.h"
#include "bn/random.h"

namespace bn {
namespace {

constexpr int kMaxSide = 16384;

/// Stream number of random_bits() for white noise.
constexpr std::uint32_t kWhiteStream = 64;

// 2^64 / g and 2^64 / g^2, g = 1.32471795724474602596 the plastic number, and 2^64 / phi; rounded down.
constexpr std::uint64_t kPlastic = 0xC13FA9A902A6328Fu;
constexpr std::uint64_t kPlasticSquared = 0x91E10DA5C79E7B1Du;
constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;

void check_side(int side, std::string_view where) {
  if (side >= 1 && side <= kMaxSide) return;
  throw Error({.code = ErrorCode::invalid_input,
               .what = fmt::format("a side of {}", side),
               .where = std::string(where),
               .limit = fmt::format("1..{}", kMaxSide),
               .remedy = ""});
}

void check_extent(Extent size, std::string_view where) {
  check_side(size.width, where);
  check_side(size.height, where);
}

/// Ranks of value(x, y), an unsigned integer.
template <class Value>
Grid<std::uint32_t> ranks_of(Extent size, const Value& value) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(static_cast<std::size_t>(size.area()));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      order.emplace_back(value(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)),
                         static_cast<std::uint32_t>(order.size()));
    }
  }
  std::sort(order.begin(), order.end());
  Grid<std::uint32_t> rank(size);
  for (std::uint32_t r = 0; r < order.size(); ++r) rank[order[r].second] = r;
  return rank;
}

}  // namespace

Grid<std::uint32_t> white_noise_mask(Extent size, std::uint64_t seed) {
  check_extent(size, "white noise");
  Grid<std::uint32_t> rank(size);
  std::iota(rank.begin(), rank.end(), 0u);
  // Fisher and Yates, from the end.
  for (auto i = static_cast<std::uint32_t>(rank.count() - 1); i > 0; --i) {
    const auto bits = static_cast<std::uint32_t>(random_bits(seed, kWhiteStream, i));
    std::swap(rank[i], rank[random_below(bits, i + 1)]);
  }
  return rank;
}

Grid<std::uint32_t> bayer_mask(int side) {
  check_side(side, "Bayer matrix");
  if (!std::has_single_bit(static_cast<unsigned>(side))) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("a side of {}", side),
                 .where = "Bayer matrix",
                 .limit = "a power of two",
                 .remedy = ""});
  }
  // M(2n) = 4 M(n) + [0 2; 3 1] for the quadrants: the lowest bits of x and y decide the highest of the rank.
  return ranks_of({side, side}, [&](std::uint64_t x, std::uint64_t y) {
    std::uint64_t value = 0;
    for (int bit = 0; (1 << bit) < side; ++bit) {
      value = 4 * value + 2 * ((x >> bit ^ y >> bit) & 1u) + (y >> bit & 1u);
    }
    return value;
  });
}

Grid<std::uint32_t> interleaved_gradient_mask(Extent size) {
  check_extent(size, "interleaved gradient noise");
  const auto fraction = [](double v) { return v - std::floor(v); };
  return ranks_of(size, [&](std::uint64_t x, std::uint64_t y) {
    const double inner = 0.06711056 * static_cast<double>(x) + 0.00583715 * static_cast<double>(y);
    // Non-negative doubles are ordered as their bits.
    return std::bit_cast<std::uint64_t>(fraction(52.9829189 * fraction(inner)));
  });
}

Grid<std::uint32_t> r2_mask(Extent size) {
  check_extent(size, "R2");
  return ranks_of(size, [](std::uint64_t x, std::uint64_t y) { return x * kPlastic + y * kPlasticSquared; });
}

std::vector<Grid<std::uint32_t>> golden_ratio_slices(const Grid<std::uint32_t>& mask, int depth) {
  check_extent(mask.size(), "golden ratio");
  check_side(depth, "golden ratio");
  const std::uint64_t n = mask.count();
  for (const std::uint32_t rank : mask) {
    if (rank < n) continue;
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("rank {}", rank),
                 .where = "golden ratio",
                 .limit = fmt::format("0..{}", n - 1),
                 .remedy = ""});
  }
  std::vector<Grid<std::uint32_t>> slices(static_cast<std::size_t>(depth), mask);
  for (std::size_t t = 0; t < slices.size(); ++t) {
    // The upper half of the product of 64-bit fractions; N fits 28 bits, 36 of the fraction are plenty.
    const std::uint64_t shift = ((t * kGolden >> 28) * n) >> 36;
    for (std::uint32_t& rank : slices[t]) rank = static_cast<std::uint32_t>((rank + shift) % n);
  }
  return slices;
}

Grid<std::uint32_t> tiled(const Grid<std::uint32_t>& mask, Extent size) {
  check_extent(mask.size(), "tiling");
  check_extent(size, "tiling");
  Grid<std::uint32_t> picture(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) picture(x, y) = mask.torus(x, y);
  }
  return picture;
}

}  // namespace bn
