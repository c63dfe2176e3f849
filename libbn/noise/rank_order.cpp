// Ranks by counting, in two levels, without moving a pixel. Energies are dealt into buckets by their
// highest bits, in chunks of pixels that know where in each bucket they may write, so threads need no
// agreement and equal energies keep the order of their indices. In each bucket, small enough for the
// cache, a radix sort of two digits finds the rank of every place, which replaces the energy there. Then
// each chunk fetches its ranks from where its energies went. So what is far apart in memory is only read
// and written in runs.

#include "noise/rank_order.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace bn::noise {
namespace {

// The bits of an energy, from the highest: bucket, digit, digit.
constexpr int kDigitBits = 10;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
static_assert(kSetMark == 1 << 3 * kDigitBits);

/// Of fewer energies, clearing the counts takes longer than comparing.
constexpr std::uint32_t kFew = 256;

using Counts = std::array<std::uint32_t, kDigits>;

std::size_t high_digit(std::uint32_t energy) { return energy >> 2 * kDigitBits; }
std::size_t middle_digit(std::uint32_t energy) { return energy >> kDigitBits & (kDigits - 1); }
std::size_t low_digit(std::uint32_t energy) { return energy & (kDigits - 1); }

/// Replaces counts by the sums of those before, from `start`.
void add_up(Counts& counts, std::uint32_t start) {
  for (std::uint32_t& count : counts) start += std::exchange(count, start);
}

/// rank_bucket() by comparing.
void rank_few(std::uint32_t* energies, std::uint32_t count, std::uint32_t first) {
  std::array<std::uint64_t, kFew> order;
  for (std::uint32_t i = 0; i < count; ++i) order[i] = std::uint64_t{energies[i]} << 32 | i;
  std::sort(order.begin(), order.begin() + count);
  for (std::uint32_t i = 0; i < count; ++i) energies[static_cast<std::uint32_t>(order[i])] = first + i;
}

/// Replaces the `count` energies of one bucket by their ranks, from `first`; equal ones in the order they
/// have.
void rank_bucket(std::uint32_t* energies, std::uint32_t count, std::uint32_t first) {
  if (count < kFew) return rank_few(energies, count, first);
  Counts low{};
  Counts middle{};
  for (std::uint32_t i = 0; i < count; ++i) {
    ++low[low_digit(energies[i])];
    ++middle[middle_digit(energies[i])];
  }
  add_up(low, 0);
  add_up(middle, first);
  const auto by_low_digit = std::make_unique_for_overwrite<std::uint32_t[]>(count);
  for (std::uint32_t i = 0; i < count; ++i) by_low_digit[low[low_digit(energies[i])]++] = i;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t& energy = energies[by_low_digit[i]];
    energy = middle[middle_digit(energy)]++;
  }
}

}  // namespace

void replace_by_ranks(Grid<std::uint32_t>& energies, std::span<std::uint32_t> room,
                      const Execution& execution) {
  constexpr std::size_t kChunk = std::size_t{1} << 18;
  const std::size_t pixels = energies.count();
  const std::size_t chunks = (pixels + kChunk - 1) / kChunk;
  const auto for_chunks = [&](auto&& body) {
    parallel_for(execution, static_cast<std::int64_t>(chunks), [&](std::int64_t chunk) {
      const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
      body(static_cast<std::size_t>(chunk), begin, std::min(begin + kChunk, pixels));
    });
  };

  // First how many of each chunk's energies go into each bucket, then the place of the first of them; the
  // last row is where the buckets end.
  std::vector<Counts> places(chunks + 1);
  for_chunks([&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (energies[i] != kUnranked) ++places[chunk][high_digit(energies[i])];
    }
  });
  std::uint32_t place = 0;
  for (std::size_t bucket = 0; bucket < kDigits; ++bucket) {
    for (Counts& row : places) place += std::exchange(row[bucket], place);
  }

  for_chunks([&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Counts next = places[chunk];
    for (std::size_t i = begin; i < end; ++i) {
      if (energies[i] != kUnranked) room[next[high_digit(energies[i])]++] = energies[i];
    }
  });
  parallel_for(execution, static_cast<std::int64_t>(kDigits), [&](std::int64_t i) {
    const auto bucket = static_cast<std::size_t>(i);
    const std::uint32_t first = places.front()[bucket];
    rank_bucket(room.data() + first, places.back()[bucket] - first, first);
  });
  for_chunks([&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Counts next = places[chunk];
    for (std::size_t i = begin; i < end; ++i) {
      if (energies[i] != kUnranked) energies[i] = room[next[high_digit(energies[i])]++];
    }
  });
}

}  // namespace bn::noise
