// A counting sort in two levels: values are dealt into buckets by their highest bits, in chunks of
// pixels that know where in each bucket they may write, so threads need no agreement and equal values
// keep the order of their indices; each bucket, now small enough for the cache, is then sorted by the
// other bits.

#include "noise/rank_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <utility>
#include <vector>

namespace bn {
namespace {

struct Entry {
  std::uint32_t value;
  std::uint32_t index;
};

/// Sorts by value and keeps the order of equal ones: two rounds of counting sort, `bits` (<= 22) low
/// bits.
void sort_bucket(Entry* entries, std::size_t count, int bits) {
  const auto scratch = std::make_unique_for_overwrite<Entry[]>(count);
  const int half = (bits + 1) / 2;
  const std::uint32_t mask = (1u << half) - 1;
  std::array<std::uint32_t, 2048> starts;
  Entry* from = entries;
  Entry* to = scratch.get();
  for (int round = 0; round < 2; ++round, std::swap(from, to)) {
    const int shift = round * half;
    std::fill_n(starts.begin(), mask + 1, 0u);
    for (std::size_t i = 0; i < count; ++i) ++starts[(from[i].value >> shift) & mask];
    std::uint32_t start = 0;
    for (std::uint32_t digit = 0; digit <= mask; ++digit) {
      start += std::exchange(starts[digit], start);
    }
    for (std::size_t i = 0; i < count; ++i) to[starts[(from[i].value >> shift) & mask]++] = from[i];
  }
}

}  // namespace

void replace_by_ranks(Grid<std::uint32_t>& values, const Execution& execution) {
  std::uint32_t greatest = 0;
  for (const std::uint32_t value : values) {
    if (value != kUnranked) greatest = std::max(greatest, value);
  }
  // Buckets by the highest bits; what is left, at most 22 bits, is sorted within each.
  constexpr int kBucketBits = 10;
  const int low_bits = std::max(0, static_cast<int>(std::bit_width(greatest)) - kBucketBits);
  const auto bucket_of = [&](std::uint32_t value) { return value >> low_bits; };
  constexpr std::size_t kBuckets = std::size_t{1} << kBucketBits;

  constexpr std::size_t kChunk = std::size_t{1} << 18;
  const std::size_t count = values.count();
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<std::array<std::uint32_t, kBuckets>> starts(chunks);
  const auto for_chunk = [&](std::int64_t chunk, auto&& visit) {
    const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
    for (std::size_t i = begin; i < std::min(begin + kChunk, count); ++i) {
      if (values[i] != kUnranked) visit(i);
    }
  };
  parallel_for(execution, static_cast<std::int64_t>(chunks), [&](std::int64_t chunk) {
    auto& counts = starts[static_cast<std::size_t>(chunk)];
    counts.fill(0);
    for_chunk(chunk, [&](std::size_t i) { ++counts[bucket_of(values[i])]; });
  });
  std::array<std::uint32_t, kBuckets + 1> bucket_starts{};
  std::uint32_t start = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    bucket_starts[bucket] = start;
    for (auto& counts : starts) start += std::exchange(counts[bucket], start);
  }
  bucket_starts[kBuckets] = start;

  const auto entries = std::make_unique_for_overwrite<Entry[]>(start);
  parallel_for(execution, static_cast<std::int64_t>(chunks), [&](std::int64_t chunk) {
    auto& next = starts[static_cast<std::size_t>(chunk)];
    for_chunk(chunk, [&](std::size_t i) {
      entries[next[bucket_of(values[i])]++] = {values[i], static_cast<std::uint32_t>(i)};
    });
  });
  parallel_for(execution, kBuckets, [&](std::int64_t bucket) {
    const std::uint32_t begin = bucket_starts[static_cast<std::size_t>(bucket)];
    const std::uint32_t end = bucket_starts[static_cast<std::size_t>(bucket) + 1];
    sort_bucket(entries.get() + begin, end - begin, low_bits);
    for (std::uint32_t rank = begin; rank < end; ++rank) values[entries[rank].index] = rank;
  });
}

}  // namespace bn
