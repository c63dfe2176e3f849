// Whether a texture is what it should be, in words.

#pragma once

#include <string>
#include <vector>

#include "bn/judgement.h"
#include "report/slice_bands.h"
#include "report/sources.h"

namespace bn::report {

struct Verdict {
  Judgement judgement;
  enum class Outcome { good, weak, failed, not_judged } outcome = Outcome::not_judged;
  std::vector<std::string> reasons;  ///< plain text; of every outcome but good
  std::string badge_html;            ///< with the grade
};

/// A volume is held against the thresholds of spatiotemporal masks, a picture against those of blue noise, as
/// bn spectrum does. A picture that does not say it is a mask and has far more power at low frequencies than
/// white noise is not judged: a photograph fails at nothing by not being noise.
Verdict verdict_of(const Texture& texture, const Analysis& analysis, const Execution& execution);

/// "99" or "–".
std::string score_text(double score);

/// The words of a figure, by its JSON name; HTML.
std::string label_of(const std::string& figure);

/// Every figure, with its threshold, the best known and its score where it has them; the worst slice of a
/// volume.
std::string merit_table(const FiguresOfMerit& figures, const Verdict& verdict, const SliceBands& slices);

/// The reasons as a list; nothing where there are none.
std::string reasons_html(const Verdict& verdict);

/// A frequency as captions write it.
std::string frequency(double f);

}  // namespace bn::report
