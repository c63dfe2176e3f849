// bn_study/convergence_study.h - floor 4 (study): which samples a renderer's frames converge with best. Not
// installed.
//
// A source gives every pixel and frame one or two numbers in [0, 1). A renderer evaluates a function at them
// (the integrand; its integral is known), averages frames, and blurs. What is left of the error is measured.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "bn_study/convergence.h"

namespace bn {

// --- what samples ----------------------------------------------------------------------------------

/// Numbers of all pixels in frames 0, 1 ... which follow each other around.
struct SampleSource {
  std::string name;
  Grid<float> first, second;
};

/// White noise; one 8-bit blue-noise mask read at shifts by R2 and one moved on by the golden ratio (a second
/// mask for the second number); R2, Halton (bases 2 and 3) and Sobol points, the same for all pixels but
/// rotated by two blue-noise masks; the presets of spatiotemporal_mask() in 8 bit. Errors: those of the
/// masks.
std::vector<SampleSource> sample_sources(Shape size, std::uint64_t seed, const Execution& execution = {});

/// A stack as a source. Its second number is the first of a pixel as far away as can be (sample_shifts()),
/// which blue noise hardly depends on; so it is with the presets above.
SampleSource source_of_stack(std::string name, Grid<float> samples);

// --- what is integrated ----------------------------------------------------------------------------

/// Functions over [0, 1) or its square. Those of two numbers are those of P. Christensen, A. Kensler, C.
/// Kilpatrick, "Progressive multi-jittered sample sequences", EGSR 2018.
struct Integrand {
  std::string_view name;
  std::function<float(float x, float y)> value;
  double integral;
};
/// step [x < 1/2], ramp x, triangle [y > x], disk [x^2 + y^2 < 2 / pi], bilinear x y, gauss exp(-x^2 - y^2).
/// The random steps of filtered_error(), here called heavisides, come on top of them.
std::span<const Integrand> integrands();

// --- what is left ----------------------------------------------------------------------------------

/// What blurs the last average: box 3, box 5, Gauss 1, Gauss 2, median 3x3.
inline constexpr std::array<std::string_view, 5> kDenoisers{"box 3", "box 5", "gauss 1", "gauss 2",
                                                            "median 3"};

/// Root mean squares, over pixels, of what is left of one integrand's error.
struct Convergence {
  std::string source;
  std::string integrand;
  std::vector<double> mean;      ///< by frame: of the plain mean of each pixel's frames
  std::vector<double> filtered;  ///< by frame: after the blur and the exponential average
  std::vector<double> later;     ///< the same, begun a third of the frames after the first
  /// The same where pixels move: each loses its average every `reset` frames, at a time of its own; over the
  /// last `reset` frames.
  double moving = 0.0;
  std::array<double, kDenoisers.size()>
      denoised{};  ///< of the last exponential average, without a blur before
};

struct ConvergenceOptions {
  FrameFilter filter;
  int frames = 64;  ///< 2..4096
  int reset = 16;   ///< 1..frames
};

/// One source's errors, an entry an integrand; heavisides first, as the root of the mean over 64 steps.
/// Errors: invalid_input. Threads: an integrand, or a step, each.
std::vector<Convergence> study_convergence(const SampleSource& source, const ConvergenceOptions& options,
                                           const Execution& execution = {});

/// Lines "source,integrand,frame,mean,filtered,later" and "source,integrand,moving,box 3,...".
std::string convergence_csv(std::span<const Convergence> rows);
std::string denoised_csv(std::span<const Convergence> rows);

}  // namespace bn
