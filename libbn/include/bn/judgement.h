// bn/judgement.h - floor 1: what the figures of a texture mean: how near it is to the best known, why it
// failed, in words. `bn spectrum` and the report both print what stands here, so that they agree.
//
// Determinism: as bn/spectrum.h. Errors, all functions: invalid_input (sizes that disagree, values that are
// not finite, an empty range), over_limit, cancelled. Thread safe.

#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bn/execution.h"
#include "bn/spectrum.h"

namespace bn {

// --- the grade -----------------------------------------------------------------------------------

/// One figure against the best known.
struct GradePart {
  std::string figure;  ///< its JSON name, "bands[0]"
  double value;
  double best;      ///< what the best known masks of this size stay below
  double ratio_db;  ///< 10 log10(value / best): 0 and less is as good; of an anisotropy value - best
  double score;     ///< 0..100
};

/// How a texture compares with the best known of its kind and size: 100 is as good, 0 no better than white
/// noise. A power P scores 100 (1 - log(P / best) / log(1 / best)), kept within 0..100: the share of the way
/// from white noise (1) to the best known, in decibels. The mean anisotropy scores 100 where a check allows
/// it and 0 at 10 dB beyond, which is a Bayer matrix. The grade is the least score; docs/spectrum.md has the
/// reference.
struct Grade {
  double score = std::numeric_limits<double>::quiet_NaN();  ///< NaN where nothing can be graded (too small;
                                                            ///< Check::white)
  std::string weakest = {};  ///< JSON name of the figure that decides; empty if nothing falls short of 100
  std::vector<GradePart> parts = {};
};
Grade grade(const FiguresOfMerit& figures, Check kind);

/// A texture that passes its check with less than this is called weak.
inline constexpr double kGoodGrade = 80.0;

/// What 19 of 20 of our own void-and-cluster masks (sigma 1.9) of about this size stay below in the four
/// lower bands; NaN where such a size has no frequency in a band.
std::array<double, 4> best_known_bands(Shape shape);

// --- likely causes ---------------------------------------------------------------------------------

/// What has probably been done to a texture.
enum class Cause {
  constant,          ///< all values are equal
  two_levels,        ///< thresholded: `number` is the share of the higher value
  gamma,             ///< value = even value ^ `number`
  srgb_encoded,      ///< through the curve of sRGB
  srgb_decoded,      ///< through its inverse
  part_of_range,     ///< evenly spread over a part of the range only: `number` is how large a part
  triangular,        ///< values of triangular distribution
  gaussian,          ///< values of normal distribution
  bytes_swapped,     ///< 16 bit samples with their bytes in the wrong order
  enlarged,          ///< every pixel repeated: `x` and `y` are how often
  smoothed,          ///< enlarged or blurred smoothly: `number` is about how much
  repeated,          ///< one tile again and again: `x`, `y`, `z` are the periods, 0 along an axis without one
  picture,           ///< most of its power at low frequencies: no noise. `number` is the power there
  alpha_multiplied,  ///< colours were multiplied by alpha
  alpha_divided,     ///< colours were divided by alpha and clamped
};
std::string_view name_of(Cause cause);

struct Finding {
  Cause cause;
  std::string text;  ///< one clause: "looks gamma-encoded, exponent .45 (1/2.2)"
  double number = 0.0;
  int x = 0, y = 0, z = 0;
};

/// One channel of a picture or volume. `low`..`high` is what its values can be, as for analyse().
struct Samples {
  std::span<const double> values;
  Shape shape;
  double low = 0.0, high = 1.0;
};

/// What has probably been done to a texture with these figures, most telling first; empty where nothing can
/// be told, and for good masks, white noise and Bayer matrices. Each finding states what was measured, and is
/// made only where the values follow it far more closely than chance would. Cost: a few passes; twice an
/// analysis where 16 bit bytes may be swapped.
std::vector<Finding> diagnose(const Samples& samples, const Analysis& analysis,
                              const Execution& execution = {});

/// What has probably been done to the colours by the last channel as alpha; of two or four channels of one
/// shape. One finding at most.
std::vector<Finding> diagnose_alpha(std::span<const Samples> channels);

/// What two channels or slices that are not independent have in common: "is channel 0 moved by (5, 3)"; empty
/// where they are independent or too small to tell.
std::string relation_of(const CrossSpectrum& cross, std::string_view first);

// --- the judgement ---------------------------------------------------------------------------------

struct Judgement {
  enum class Outcome {
    good,         ///< passes its check, and its grade is at least kGoodGrade
    weak,         ///< passes its check; the best known are much better
    failed,       ///< misses a threshold
    cannot_tell,  ///< too small for the check to say anything
  };
  Check kind = Check::blue;
  Outcome outcome = Outcome::cannot_tell;
  std::string headline;  ///< "blue noise", "weak blue noise", "white noise", "not blue noise", ...
  std::vector<JudgedFigure> judged;
  std::vector<std::string> not_judged;  ///< JSON names of figures that this texture is too small to have
  Grade grade;
  std::vector<Finding> findings;  ///< where it failed
  std::vector<std::string>
      reasons;  ///< clauses: the likely causes, then each figure that misses its threshold
  bool passed() const { return outcome == Outcome::good || outcome == Outcome::weak; }
};
std::string_view name_of(Judgement::Outcome outcome);  ///< "good", "weak", "failed", "cannot tell"

/// Checks, grades and, where it fails, diagnoses.
Judgement judge_texture(const Samples& samples, const Analysis& analysis, Check kind,
                        const Execution& execution = {});

}  // namespace bn
