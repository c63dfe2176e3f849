// The kernel through which two pixels of a mask see each other, as integers; most often a Gaussian.
//
// Integer weights make adding and removing exact, so energies depend on the set of pixels alone and
// never on the order in which they came. The scale is chosen so that everything that is ever added up
// in one pixel fits an int32: the whole kernel once (every pixel set), the random start value, and the
// mark of a set pixel.

#pragma once

#include <cstdint>
#include <vector>

namespace bn::noise {

/// Added to the energy of a pixel when it is set: above every energy of an unset pixel.
inline constexpr std::int32_t kSetMark = std::int32_t{1} << 30;

/// Random start energies are 0..kStartEnergyLimit-1.
inline constexpr std::int32_t kStartEnergyLimit = 1 << 12;

/// The largest kernel radius in pixels; a cut-off of 0 stops here too.
inline constexpr int kMaxKernelRadius = 64;

/// Weights by distance. Their sum plus kStartEnergyLimit stays below kSetMark.
class PixelKernel {
 public:
  /// The largest |x| or |y| of a weight that is not zero.
  int radius() const { return radius_; }
  /// How far pixels see each other along the axes: the largest distance whose weight is no less than the
  /// start energies' limit.
  int sight() const;
  /// The weight at a distance; zero outside -radius()..radius().
  std::int32_t weight(int x, int y) const;
  /// The sum of all weights: the energy that all set pixels together give each pixel.
  std::int32_t sum() const { return sum_; }

 protected:
  PixelKernel() = default;

  int radius_ = 0;
  std::int32_t sum_ = 0;
  std::vector<std::int32_t> weights_;  // by (y + radius_) * (2 * radius_ + 1) + x + radius_
};

/// exp(-(x² + y²) / (2 sigma²)), scaled and rounded, within a disc.
class GaussianKernel : public PixelKernel {
 public:
  /// `cutoff_px` is the radius of the disc, 0 for kMaxKernelRadius. Arguments are checked by the
  /// caller.
  GaussianKernel(double sigma_px, int cutoff_px);
};

}  // namespace bn::noise
