// bn_study/convergence.h - floor 4: how fast a renderer that takes a mask's samples converges.
//
// A renderer compares a value with the mask's sample of the pixel and frame, and gets 0 or 1: the picture [v
// < tau]. It blurs each frame and averages frames exponentially, or averages each pixel's frames alone. What
// is left of the error is measured over all values tau, spread evenly over (0, 1).
//
// Headers of bn_study are for the tools and tests of this repository. They are not installed and promise
// nothing about the next version.

#pragma once

#include <array>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"

namespace bn {

/// What a renderer does with its frames.
struct FrameFilter {
  /// A separable blur: its weights along either axis, of sum 1, around the torus. Empty: none.
  std::vector<double> taps = gaussian_taps(1.3435);
  double alpha = 0.1;  ///< share of the new frame in the exponential average, above 0, up to 1

  static std::vector<double> gaussian_taps(double sigma_px);
  static std::vector<double> box_taps(int side);
  static std::vector<double> binomial_taps(int order);  ///< 2: [1 2 1] / 4
};

// Samples are in [0, 1); slice t is frame t.

/// The middle of each rank's level: (floor(rank levels / N) + 1/2) / levels, N the pixels of a slice.
Grid<float> samples_of_ranks(const Grid<std::uint32_t>& ranks, int levels = 256);

/// E(n) at index n - 1: the root of the mean, over 64 values tau, of the variance over pixels of what is left
/// after n frames. The average starts with the first frame, which is `start` slices after slice 0; slices
/// follow each other around. White noise and a Gaussian: sqrt(1/6) / (2 sigma sqrt(pi)) at first, times
/// sqrt(alpha / (2 - alpha)) late.
/// `frames` at least 1. Threads: one value tau each; sums are added in the order of the values. Cost: 128
/// times the number of taps, a sample.
std::vector<double> filtered_error(const Grid<float>& samples, const FrameFilter& filter, int frames,
                                   int start = 0, const Execution& execution = {});

/// At index n - 1: the root mean square, over pixels and 32 values tau, of the error of the mean of n frames.
std::vector<double> pixel_error(const Grid<float>& samples);

/// Power of pixels' series at 0, 1 ... 4 cycles a stack, against white noise, which reads 1; mean over
/// pixels.
std::array<double, 5> series_power(const Grid<float>& samples);

}  // namespace bn
