// The judgement: thresholds, grade and likely causes, put into one answer.

#include "bn/judgement.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bn {
namespace {

/// The figures that a check would look at, whatever the size.
std::vector<std::string> wanted_figures(Check kind) {
  std::vector<std::string> names{"bands[0]", "bands[1]", "bands[2]", "bands[3]"};
  if (kind == Check::white) names.push_back("bands[4]");
  names.insert(names.end(), {"anisotropy_db_mean", "anisotropy_db_max"});
  if (kind == Check::stbn)
    names.insert(names.end(), {"temporal_power_at_0", "temporal_power_low", "filtered_residual_db"});
  return names;
}

std::string_view kind_in_words(Check kind) {
  switch (kind) {
    case Check::white:
      return "white noise";
    case Check::stbn:
      return "blue in space and time";
    case Check::blue:
      break;
  }
  return "blue noise";
}

bool is_white(const FiguresOfMerit& figures) {
  const auto judged = judge(figures, Check::white);
  const bool any_band =
      std::any_of(judged.begin(), judged.end(), [](const auto& f) { return f.figure.starts_with("bands"); });
  return any_band && std::all_of(judged.begin(), judged.end(), [](const auto& f) { return f.passed; });
}

void put_into_words(const FiguresOfMerit& figures, Judgement& result) {
  const std::string_view name = kind_in_words(result.kind);
  switch (result.outcome) {
    case Judgement::Outcome::good:
      result.headline = name;
      break;
    case Judgement::Outcome::weak:
      result.headline = fmt::format("weakly {}", name);
      if (result.kind == Check::blue) result.headline = "weak blue noise";
      break;
    case Judgement::Outcome::failed:
      result.headline = result.kind != Check::white && is_white(figures) ? std::string("white noise")
                                                                         : fmt::format("not {}", name);
      break;
    case Judgement::Outcome::cannot_tell:
      result.headline = "too small to judge";
      break;
  }
}

}  // namespace

std::string_view name_of(Judgement::Outcome outcome) {
  switch (outcome) {
    case Judgement::Outcome::good:
      return "good";
    case Judgement::Outcome::weak:
      return "weak";
    case Judgement::Outcome::failed:
      return "failed";
    case Judgement::Outcome::cannot_tell:
      break;
  }
  return "cannot tell";
}

Judgement judge_texture(const Samples& samples, const Analysis& analysis, Check kind,
                        const Execution& execution) {
  const FiguresOfMerit& figures = analysis.figures;
  Judgement result;
  result.kind = kind;
  result.judged = judge(figures, kind);
  result.grade = grade(figures, kind);
  const auto has = [&](const std::string& name) {
    return std::any_of(result.judged.begin(), result.judged.end(),
                       [&](const auto& f) { return f.figure == name; });
  };
  bool spectrum_judged = false;
  for (const std::string& name : wanted_figures(kind)) {
    if (has(name)) {
      spectrum_judged = true;
    } else {
      result.not_judged.push_back(name);
    }
  }
  const bool passed =
      std::all_of(result.judged.begin(), result.judged.end(), [](const auto& f) { return f.passed; });
  if (!passed) {
    result.outcome = Judgement::Outcome::failed;
    if (!samples.values.empty()) result.findings = diagnose(samples, analysis, execution);
    for (const Finding& finding : result.findings) result.reasons.push_back(finding.text);
    for (const JudgedFigure& figure : result.judged) {
      if (!figure.passed) result.reasons.push_back(describe(figure));
    }
  } else if (!spectrum_judged) {
    result.outcome = Judgement::Outcome::cannot_tell;
    result.reasons.push_back(
        fmt::format("{} x {} pixels have no frequency that this check looks at; only the "
                    "histogram was judged",
                    figures.shape.width, figures.shape.height));
  } else if (result.grade.score < kGoodGrade) {
    result.outcome = Judgement::Outcome::weak;
    for (const GradePart& part : result.grade.parts) {
      if (part.figure == result.grade.weakest) {
        result.reasons.push_back(fmt::format("{}: {:.3g}, {:.1f} dB above the best known ({:.2g})",
                                             label_of(part.figure), part.value, part.ratio_db, part.best));
      }
    }
  } else {
    result.outcome = Judgement::Outcome::good;
  }
  put_into_words(figures, result);
  return result;
}

}  // namespace bn
