// A small spatiotemporal mask, made the plain way: what the tests of the volumes' figures and checks look at.
//
// Two voxels of a volume interact only if they share the slice, by a Gaussian of their distance in x and y,
// or the pixel, by one of their distance in z; every axis wraps. Voxels are set one by one where the energy
// of those already set is least, and a voxel's rank is its turn. So every slice is a blue-noise mask, and
// every pixel's sequence is blue in time. Source: A. Wolfe, N. Morrical, T. Akenine-Möller, R. Ramamoorthi,
// "Spatiotemporal blue noise masks", EGSR 2022; the filling of voids: R. Ulichney, Proc. SPIE 1913, 1993.
// Cost: N (W H + D) steps.

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bn/random.h"
#include "bn/spectrum.h"

namespace bn::test {

/// Ranks 0..N-1 of the voxels, index (z * H + y) * W + x.
inline std::vector<double> spatiotemporal_mask(Shape shape, double sigma_px, double sigma_frames,
                                               std::uint64_t seed) {
  const int w = shape.width, h = shape.height, d = shape.depth;
  const auto index = [&](int x, int y, int z) { return static_cast<std::size_t>((z * h + y) * w + x); };
  const auto gaussian = [](double squared, double sigma) {
    return std::exp(-0.5 * squared / (sigma * sigma));
  };
  std::vector<double> in_slice(index(0, 0, 1)), in_time(static_cast<std::size_t>(d));
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const double dx = wrap_centred(x, w), dy = wrap_centred(y, h);
      in_slice[index(x, y, 0)] = gaussian(dx * dx + dy * dy, sigma_px);
    }
  }
  for (int z = 0; z < d; ++z) {
    const double dz = wrap_centred(z, d);
    in_time[static_cast<std::size_t>(z)] = gaussian(dz * dz, sigma_frames);
  }

  std::vector<double> energy(static_cast<std::size_t>(shape.count())), rank(energy.size());
  // A little noise, far below the least difference that matters, lets chance decide between equals.
  for (std::size_t i = 0; i < energy.size(); ++i) {
    energy[i] = 1e-4 * static_cast<double>(random_bits(seed, 0, i) >> 11) * 0x1p-53;
  }
  // The least of each slice is remembered: a turn changes one slice, and one voxel of each other.
  std::vector<std::size_t> least(static_cast<std::size_t>(d));
  const auto find_least = [&](int z) {
    const auto begin = energy.begin() + static_cast<std::ptrdiff_t>(index(0, 0, z));
    const auto end = begin + static_cast<std::ptrdiff_t>(in_slice.size());
    least[static_cast<std::size_t>(z)] =
        static_cast<std::size_t>(std::min_element(begin, end) - energy.begin());
  };
  for (int z = 0; z < d; ++z) find_least(z);
  for (std::size_t turn = 0; turn < energy.size(); ++turn) {
    const std::size_t chosen = *std::min_element(
        least.begin(), least.end(), [&](std::size_t a, std::size_t b) { return energy[a] < energy[b]; });
    const int at = static_cast<int>(chosen), x0 = at % w, y0 = at / w % h, z0 = at / (w * h);
    rank[chosen] = static_cast<double>(turn);
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        energy[index(x, y, z0)] += in_slice[index(wrap(x - x0, w), wrap(y - y0, h), 0)];
      }
    }
    energy[chosen] = std::numeric_limits<double>::infinity();
    find_least(z0);
    for (int z = 0; z < d; ++z) {
      if (z == z0) continue;
      const std::size_t same_pixel = index(x0, y0, z);
      energy[same_pixel] += in_time[static_cast<std::size_t>(wrap(z - z0, d))];
      if (least[static_cast<std::size_t>(z)] == same_pixel) find_least(z);
    }
  }
  return rank;
}

}  // namespace bn::test
