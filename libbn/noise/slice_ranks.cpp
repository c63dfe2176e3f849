#include "noise/slice_ranks.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "noise/gaussian_kernel.h"

namespace bn::noise {
namespace {

// Three digits make the 30 bits of an energy.
constexpr int kDigitBits = 10;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
static_assert(kSetMark == 1 << 3 * kDigitBits);

/// A radix sort of indices, from the lowest digit.
void replace_by_ranks(std::span<std::uint32_t> energies) {
  std::array<std::array<std::uint32_t, kDigits>, 3> places{};
  const auto digit = [](std::uint32_t energy, int pass) {
    return energy >> pass * kDigitBits & (kDigits - 1);
  };
  for (const std::uint32_t energy : energies) {
    for (int pass = 0; pass < 3; ++pass) ++places[static_cast<std::size_t>(pass)][digit(energy, pass)];
  }
  std::vector<std::uint32_t> order(energies.size()), next(energies.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  for (int pass = 0; pass < 3; ++pass) {
    auto& place = places[static_cast<std::size_t>(pass)];
    std::uint32_t sum = 0;
    for (std::uint32_t& count : place) sum += std::exchange(count, sum);
    for (const std::uint32_t i : order) next[place[digit(energies[i], pass)]++] = i;
    order.swap(next);
  }
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) energies[order[rank]] = rank;
}

}  // namespace

void replace_by_ranks_in_slices(Grid<std::uint32_t>& energies, const Execution& execution) {
  parallel_for(execution, energies.depth(), [&](std::int64_t slice) {
    throw_if_stopped(execution);
    replace_by_ranks(energies.slice(static_cast<int>(slice)));
  });
}

}  // namespace bn::noise
