// bn_study/measures.h - floor 4 (study): measures of error pictures. Not installed.

#pragma once

#include "bn/grid.h"

namespace bn {

/// Power of `picture` at 0 < f <= limit against white noise of its variance: white noise reads 1.
double low_frequency_power(const Grid<float>& picture, double limit);

/// The same without dividing by the variance, of a part of an error picture: what a blur would leave
/// visible. Windowed (Hann), since a part does not wrap.
double low_frequency_error(const Grid<float>& error, double limit);

/// Root of the mean square of `error` after a Gaussian blur of `sigma_px` (0: none), edges repeated.
double blurred_rms(const Grid<float>& error, double sigma_px);

}  // namespace bn
