// bn/spectrum.h - floor 2: what is in a texture, frequency by frequency, and whether it is what it claims.
//
// Frequencies are in cycles/pixel along x and y and cycles/frame along z: fx = kx/W for the integer
// index kx, taken in -1/2..1/2; W, H and D may differ. Power is |F|^2 / (N * variance), so that white
// noise reads 1 everywhere. DC (the mean) is taken out before the transform.
//
// Determinism: every sum is in a written order, so results have the same bits for any number of
// threads. They rest on the C library's sine and cosine, so they may differ in the last digits
// between machines; no baked byte depends on them.
// Errors, all functions: invalid_input (sizes that disagree; NaN or infinity, with their count and the
// first position), over_limit (memory), cancelled.

#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"

namespace bn {

// --- transforms ----------------------------------------------------------------------------------

/// Frequencies kx = 0..W/2 that a transform of real data needs; the others are their conjugates. A line has
/// the shape W x 1 x 1, a picture W x H x 1, a volume W x H x D.
inline int half_width(const Shape& shape) { return shape.width / 2 + 1; }

/// Sides of a shape: 1..65536, any size, primes too.
inline constexpr int kMaxSpectrumSide = 65536;

/// The transform of real data, for kx = 0..W/2 only; F(-k) = conj(F(k)) gives the rest.
template <class T>
struct HalfSpectrum {
  Shape shape;                          ///< of the real data
  std::vector<std::complex<T>> values;  ///< index (kz * H + ky) * half_width(shape) + kx
};

/// F(k) = sum over p of v(p) exp(-2 pi i (kx x / W + ky y / H + kz z / D)), in one, two or three
/// dimensions; T float or double.
/// Error: root mean square at most 8 rounding units of T (2^-53, 2^-24), relative to that of F; half of that
/// where no side has a prime factor above 47 (docs/spectrum.md).
/// Cost: N log N for every size (Bluestein 1970 where a prime factor is large); memory N + 2 complex
/// halves.
template <class T>
HalfSpectrum<T> transform(std::span<const T> values, Shape shape, const Execution& execution = {});

/// The data again: v(p) = 1/N sum over k of F(k) exp(+2 pi i k p). Reads the half plane only.
template <class T>
std::vector<T> inverse_transform(HalfSpectrum<T> spectrum, const Execution& execution = {});

// --- power ---------------------------------------------------------------------------------------

/// Power against white noise: P(k) = |F(k)|^2 / (N * variance), P(0) = 0. The mean over all k is 1
/// (Parseval). A constant texture has P = 0 everywhere.
struct PowerSpectrum {
  Shape shape;
  std::vector<double> half;   ///< index (kz * H + ky) * half_width(shape) + kx
  std::int64_t textures = 1;  ///< how many independent periodograms were averaged
  /// The power at any integer frequency index, negative ones included.
  double at(std::int64_t kx, std::int64_t ky = 0, std::int64_t kz = 0) const;
};

/// The periodogram of `values`. The mean is removed in two passes and the scale is taken out by a
/// power of two: an offset of 1e8 under a signal of 1, or values of 1e-300, cost no accuracy.
PowerSpectrum power_spectrum(std::span<const double> values, Shape shape, const Execution& execution = {});

/// Takes `next` into a running average of periodograms (Bartlett 1948). Both have one shape. The
/// average of K independent textures fluctuates by 1/sqrt(K) around the expected power.
void accumulate(PowerSpectrum& average, const PowerSpectrum& next);

/// What a volume's spectrum is averaged to.
enum class Projection {
  xy,  ///< (kx, ky): the mean spectrum of the slices
  xz,  ///< (kx, kz) as width and height: the mean spectrum of the sections of constant y
  z,   ///< kz as width: the mean spectrum of the pixels' sequences in time
};

/// The volume's power averaged over the axes that `projection` leaves out; by Parseval this is the
/// average of the lower-dimensional spectra. The DC of the volume is no part of any mean.
PowerSpectrum project(const PowerSpectrum& volume, Projection projection);

/// The circular autocorrelation r(d) = sum over p of (v(p) - m)(v(p + d) - m) / (N * variance), r(0) = 1,
/// in the layout of the texture (Wiener-Khinchin: the inverse transform of the power).
std::vector<double> autocorrelation(const PowerSpectrum& power, const Execution& execution = {});

/// The whole plane of a line's or picture's power with DC in the middle (W/2, H/2), for display.
Grid<double> centred_power(const PowerSpectrum& power);

// --- ranks, thresholds, histograms ---------------------------------------------------------------

/// The rank of every value, 0..N-1; equal values share the mean of their ranks. What a mask's encoding
/// (8 bit, 16 bit, float) does to its values, ranks undo. N below 2^32. Cost: O(N).
std::vector<double> midranks(std::span<const double> values, const Execution& execution = {});

/// The binary picture of `values` at grey level 0 < level < 1: 1 where (midrank + 1/2) / N < level,
/// else 0.
std::vector<double> thresholded(std::span<const double> values, double level,
                                const Execution& execution = {});

/// Counts of `values` in `bins` equal parts of low..high; values outside go to the first or last one.
std::vector<std::int64_t> histogram(std::span<const double> values, double low, double high, int bins);

/// Largest |count / (N / bins) - 1| over bins: 0 for a flat histogram.
double histogram_max_deviation(std::span<const std::int64_t> counts);

// --- curves and figures of a picture's power -------------------------------------------------------
// For a line or a picture; project() a volume first.

/// Power and anisotropy by radial frequency (Ulichney, "Dithering with blue noise", Proc. IEEE 76(1),
/// 1988). Annulus j holds the frequencies with round(f / step) = j, step = 1/max(W, H), so each
/// frequency but DC is in exactly one; the last reaches the corner, f = 1/sqrt(2).
struct RadialCurve {
  std::vector<double> frequency;      ///< j * step, cycles/pixel, from j = 1
  std::vector<double> power;          ///< mean over the annulus; NaN where it holds no frequency
  std::vector<double> anisotropy_db;  ///< 10 log10(s^2 / mean^2); NaN where undefined (see below)
  std::vector<std::int64_t> count;    ///< frequencies in the annulus, conjugates included
};

/// s^2 is the sample variance over the independent half of the annulus: with n frequencies in n/2
/// conjugate pairs, sum (P - mean)^2 / (n - 2). A texture as isotropic as white noise reads
/// 10 log10(1/K) averaged over K textures. Undefined where n <= 2 or the annulus holds nothing but rounding
/// errors (mean below 1e-20); never below -150 dB, where rounding begins.
RadialCurve radial_power(const PowerSpectrum& power);

/// Upper edges, cycles/pixel, of the bands 0 < f <= .0625 < f <= .125 < ... <= .5.
inline constexpr std::array<double, 5> kBandEdges{0.0625, 0.125, 0.1875, 0.25, 0.5};

struct BandPower {
  std::array<double, 5> mean{};         ///< NaN where a small texture has no frequency in the band
  std::array<std::int64_t, 5> count{};  ///< frequencies in the band, conjugates included
};
BandPower band_power(const PowerSpectrum& power);

/// What a wrapped Gaussian blur of `sigma_px` (0.1..64) leaves, against what it leaves of white noise:
/// 10 log10(sum P G^2 / sum G^2) over k != 0, G the transform of the wrapped, sampled Gaussian.
double gauss_residual_db(const PowerSpectrum& power, double sigma_px);

inline constexpr std::array<double, 3> kResidualSigmas{1.0, 1.5, 2.0};

/// What is left of a volume's power where a renderer takes slice t in frame t, around and around, blurs each
/// frame (a Gaussian of 1.3435 pixels) and averages frames exponentially (alpha 0.1), against what is left of
/// white noise: 10 log10(sum P G^2 A^2 / sum G^2 A^2) over k != 0, G as above, A^2 = alpha^2 / (1 - 2 (1 - alpha)
/// cos w + (1 - alpha)^2) at the angular frequency w in time. Both constants are those that published
/// spatiotemporal masks are compared with (docs/spatiotemporal.md).
double filtered_residual_db(const PowerSpectrum& power);

/// Bins of the histogram that figures of merit are made from; fewer where a texture has fewer pixels.
inline constexpr int kHistogramBins = 256;

/// How a texture's values should be spread over their range low..high.
enum class Distribution {
  uniform,     ///< each value equally often, as in a mask of ranks
  triangular,  ///< the sum of two uniform ones (TPDF dither): most often the middle, never the ends
};
std::string_view name_of(Distribution distribution);  ///< "uniform", "triangular"

/// The figures by which textures are compared. For a volume all but the last are of its slices
/// (Projection::xy). NaN: undefined for this texture. All are of the ranks of the pixels, but for
/// the histogram, so that an encoding changes none of them.
struct FiguresOfMerit {
  Shape shape;
  std::int64_t textures = 1;
  BandPower bands;
  double peak = 0.0;                          ///< largest mean power of an annulus; see figures_of_merit()
  double peak_frequency = 0.0;                ///< cycles/pixel
  double anisotropy_db_mean = 0.0;            ///< over the annuli of at least 32 frequencies
  double anisotropy_db_max = 0.0;             ///< over the same
  std::array<double, 3> gauss_residual_db{};  ///< for kResidualSigmas
  double histogram_max_deviation = 0.0;       ///< from a flat histogram
  Distribution distribution = Distribution::uniform;  ///< what was asked for
  /// Largest difference between the share of values below a value and what a distribution other than uniform
  /// makes it (Kolmogorov and Smirnov), 0..1; NaN for uniform.
  double distribution_distance = std::numeric_limits<double>::quiet_NaN();
  /// Volumes only: mean power of the pixels' sequences at 0 cycles/frame, which no order of the slices
  /// changes,
  double temporal_power_at_0 = std::numeric_limits<double>::quiet_NaN();
  /// and at 0 < f <= 1/8 cycles/frame, which tells whether the order is a good one; NaN below 8 slices.
  double temporal_power_low = std::numeric_limits<double>::quiet_NaN();
  /// What a blur and an average over frames leave: filtered_residual_db().
  double filtered_residual_db = std::numeric_limits<double>::quiet_NaN();
};

/// The figures of one power spectrum, of a line, picture or volume. The peak is sought over annuli one
/// frequency step wide; those beyond 1/2 cycle/pixel, which the square cuts to arcs, are joined until they
/// hold as many frequencies as the last whole one, or noise there would win. Of one texture it is high by
/// about sqrt(2 / n), n frequencies in the annulus (docs/spectrum.md).
FiguresOfMerit figures_of_merit(const PowerSpectrum& power, double histogram_max_deviation);

/// The power of the ranks of `values`, and its figures. `low`..`high` is the range that the
/// histogram covers (256 bins, or N if less): 0..256 for 8 bit, 0..65536 for 16 bit, 0..1 for float.
/// `distribution` is what the values should have over that range.
struct Analysis {
  PowerSpectrum power;
  FiguresOfMerit figures;
};
Analysis analyse(std::span<const double> values, Shape shape, double low, double high,
                 const Execution& execution = {}, Distribution distribution = Distribution::uniform);

/// The centred power in grey, in decibels: `low_db` and less is 0, `high_db` and more 255; white noise is 0
/// dB.
Grid<std::uint8_t> log_picture(const PowerSpectrum& power, double low_db = -50.0, double high_db = 12.5);

/// Lines "axis,frequency,power,anisotropy_db,count", with a header: the radial curve (axis "space"), and for
/// a volume the curve in time after it (axis "time"). Undefined values are empty.
std::string curves_csv(const PowerSpectrum& power);

/// One JSON object: size ([width, height]), depth, textures, bands, peak, peak_frequency, anisotropy_db_mean,
/// anisotropy_db_max, gauss_residual_db, histogram_max_deviation, distribution; distribution_distance where
/// the distribution is not uniform; temporal_power_at_0, temporal_power_low and filtered_residual_db for volumes. Undefined figures
/// are null. docs/spectrum.md describes each.
std::string to_json(const FiguresOfMerit& figures);

// --- two textures ----------------------------------------------------------------------------------

/// What two textures of one shape have in common, of their ranks. NaN where one of them is constant.
struct CrossSpectrum {
  double correlation = 0.0;       ///< of the pixels at the same place, -1..1
  double peak_correlation = 0.0;  ///< the one furthest from 0 over all displacements on the torus
  /// Where: the second at p + (x, y, z) is what the first is at p. The nearest to no displacement.
  int peak_x = 0, peak_y = 0, peak_z = 0;
  /// What |peak_correlation| stays below if the two are independent: six standard deviations of the chance
  /// that their own spectra leave. 1 and more: they are too small to tell.
  double limit = 0.0;
  /// By band, |sum F1 conj(F2)|^2 / (sum |F1|^2 sum |F2|^2): 1 for equal textures, about 1/n for independent
  /// ones, n half the frequencies of the band. A displacement lowers it: it turns every frequency by another
  /// angle.
  std::array<double, 5> coherence{};

  bool can_tell() const { return limit < 1.0; }
  bool independent() const { return !(std::abs(peak_correlation) > limit); }
};

/// Memory: four complex halves of the shape. Cost: three transforms.
CrossSpectrum cross_spectrum(std::span<const double> first, std::span<const double> second, Shape shape,
                             const Execution& execution = {});

// --- checks --------------------------------------------------------------------------------------

enum class Check {
  blue,   ///< a blue-noise mask, or the average of several
  white,  ///< white noise
  stbn,   ///< a spatiotemporal volume: slices blue, and every pixel blue in time
};

struct CheckFailure {
  std::string figure;  ///< its JSON name, "bands[0]"
  double value;
  double low, high;  ///< the range it missed
};

/// The figures outside their thresholds (check.cpp states each with its reason); empty: passed.
/// Figures that this texture is too small to have are not judged.
std::vector<CheckFailure> check(const FiguresOfMerit& figures, Check kind);

/// One figure with its threshold, kept or missed. An end that does not matter is infinite.
struct JudgedFigure {
  std::string figure;
  double value;
  double low, high;
  bool passed;
};

/// The words of a figure by its JSON name, in ASCII: "power, 0 < f <= 0.0625" for "bands[0]".
std::string label_of(std::string_view figure);

/// "power, 0 < f <= 0.0625: 0.015, at most 0.002".
std::string describe(const JudgedFigure& figure);
std::string describe(const CheckFailure& failure);

/// Every figure that check() judges, in its order.
std::vector<JudgedFigure> judge(const FiguresOfMerit& figures, Check kind);

}  // namespace bn
