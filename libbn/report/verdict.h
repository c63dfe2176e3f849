// Whether a texture is what it should be, in words.

#pragma once

#include <string>
#include <vector>

#include "bn/spectrum.h"
#include "report/sources.h"

namespace bn::report {

struct Verdict {
  std::vector<JudgedFigure> judged;
  enum class Outcome { passed, failed, not_judged } outcome = Outcome::not_judged;
  std::string badge_html;
};

/// A volume is held against the thresholds of spatiotemporal masks, a picture against those of blue noise. A
/// picture that neither says it is a mask nor looks like one (its values are not evenly spread, its spectrum
/// is neither blue nor white) is not judged: a photograph fails at nothing by not being noise.
Verdict verdict_of(const Texture& texture, const FiguresOfMerit& figures);

/// The words of a figure, by its JSON name; HTML.
std::string label_of(const std::string& figure);

/// Every figure, with its threshold where it has one.
std::string merit_table(const FiguresOfMerit& figures, const Verdict& verdict);

/// A frequency as captions write it.
std::string frequency(double f);

}  // namespace bn::report
