// The power of an error picture by frequency, in the unit of its variance.
#pragma once

#include <vector>

#include "bn/grid.h"
#include "bn/spectrum.h"

namespace bn::study {

/// The window along an axis of `size` pixels.
double hann_window(int at, int size);

/// Of a part of a picture: windowed (Hann), since a part does not wrap. White noise of variance v reads v at
/// every frequency, whatever the size.
class ErrorSpectrum {
 public:
  explicit ErrorSpectrum(const Grid<float>& error);

  /// The mean power over low < f <= high, cycles per pixel.
  double band(double low, double high) const;
  /// By radial frequency; the power scaled likewise.
  RadialCurve radial() const;

 private:
  Extent size_;
  PowerSpectrum power_;
  double scale_ = 0.0;
};

}  // namespace bn::study
