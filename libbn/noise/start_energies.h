// The random energies that the pixels of an empty torus have.

#pragma once

#include <cstdint>

#include "bn/execution.h"
#include "bn/random.h"
#include "noise/energy_field.h"

namespace bn::noise {

/// The start energies of pixels in the order of their indices, 0..kStartEnergyLimit-1.
class StartEnergies {
 public:
  StartEnergies(std::uint64_t seed, std::uint32_t stream, std::uint64_t first)
      : seed_(seed), stream_(stream), index_(first), four_(bits() >> 16 * (first % 4)) {}

  std::int32_t next() {
    const auto energy = static_cast<std::int32_t>(four_ % kStartEnergyLimit);
    four_ >>= 16;
    if (++index_ % 4 == 0) four_ = bits();
    return energy;
  }

 private:
  std::uint64_t bits() const { return random_bits(seed_, stream_, index_ / 4); }

  std::uint64_t seed_;
  std::uint32_t stream_;
  std::uint64_t index_;
  std::uint64_t four_;
};

/// Calls body(x, y, index, start energy) for every pixel, rows in parallel.
template <class Body>
void for_each_pixel(Extent size, std::uint64_t seed, std::uint32_t stream, const Execution& execution,
                    const Body& body) {
  const auto [width, height] = size;
  parallel_for(execution, height, [&](std::int64_t y) {
    auto index = static_cast<std::size_t>(y * width);
    StartEnergies start(seed, stream, index);
    for (int x = 0; x < width; ++x, ++index) body(x, static_cast<int>(y), index, start.next());
  });
}

inline void write_start_energies(EnergyField& field, std::uint64_t seed, std::uint32_t stream,
                                 const Execution& execution) {
  for_each_pixel(field.size, seed, stream, execution,
                 [&](int x, int y, std::size_t, std::int32_t start) { field.at(x, y) = start; });
}

}  // namespace bn::noise
