#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "report/html.h"

namespace bn::report {
namespace {

std::string allowed(double low, double high) {
  if (std::isinf(low) || low == 0.0) return std::isinf(high) ? "above 0" : "≤ " + number(high);
  return number(low) + " … " + number(high);
}

/// A picture that nobody calls a mask.
bool is_a_picture(const Texture& texture, const Judgement& judgement) {
  if (texture.shape.depth > 1 || (texture.metadata && (texture.metadata->kind == "mask" ||
                                                       texture.metadata->kind == "spatiotemporal-mask"))) {
    return false;
  }
  return std::any_of(judgement.findings.begin(), judgement.findings.end(),
                     [](const Finding& finding) { return finding.cause == Cause::picture; });
}

}  // namespace

Verdict verdict_of(const Texture& texture, const Analysis& analysis, const Execution& execution) {
  const auto& [values, low, high] = texture.samples;
  Verdict verdict;
  Judgement& judgement = verdict.judgement;
  const Check check = natural_check(texture.shape, texture.metadata);
  judgement =
      judge_texture({values, texture.shape, low, std::max(high, low + 1e-300)}, analysis, check, execution);
  verdict.reasons = judgement.reasons;
  if (texture.shape.depth > 1 && check == Check::blue) {
    verdict.reasons.emplace_back(
        "judged by its slices: the preset filtered is for the blurred and averaged picture, not for one "
        "pixel's series");
  }
  std::string words = judgement.headline;
  if (is_a_picture(texture, judgement)) {
    verdict.reasons = {"not judged: it does not say that it is a mask, and it " +
                       judgement.findings.front().text};
    judgement.judged.clear();
    judgement.grade = {};
    verdict.badge_html = badge_of("plain", "not judged");
    return verdict;
  }
  for (const std::string& relation : texture.relations) verdict.reasons.push_back(relation);
  if (!texture.relations.empty() && judgement.passed()) {
    verdict.outcome = Verdict::Outcome::failed;
    words = "not independent";
  } else if (judgement.outcome == Judgement::Outcome::failed) {
    verdict.outcome = Verdict::Outcome::failed;
  } else if (judgement.outcome == Judgement::Outcome::weak) {
    verdict.outcome = Verdict::Outcome::weak;
  } else if (judgement.outcome == Judgement::Outcome::good) {
    verdict.outcome = Verdict::Outcome::good;
  }
  const std::string_view look = verdict.outcome == Verdict::Outcome::good     ? "pass"
                                : verdict.outcome == Verdict::Outcome::weak   ? "weak"
                                : verdict.outcome == Verdict::Outcome::failed ? "fail"
                                                                              : "plain";
  verdict.badge_html = badge_of(look, words);
  return verdict;
}

std::string score_text(double score) { return std::isnan(score) ? "–" : fmt::format("{:.0f}", score); }

std::string label_of(const std::string& figure) {
  std::string label;
  std::string_view plain = figure;
  const std::string words = bn::label_of(plain);
  for (std::string_view rest = words; !rest.empty();) {
    if (rest.starts_with(" < f <= ")) {
      label += " &lt; <i>f</i> ≤ ";
      rest.remove_prefix(8);
    } else {
      label += escaped(rest.substr(0, 1));
      rest.remove_prefix(1);
    }
  }
  return label;
}

std::string frequency(double f) { return std::isnan(f) ? "–" : fmt::format("{:.3f}", f); }

std::string reasons_html(const Verdict& verdict) {
  if (verdict.reasons.empty()) return {};
  std::string items;
  for (const std::string& reason : verdict.reasons) items += "<li>" + escaped(reason) + "</li>";
  return "<ul class=\"reasons\">" + items + "</ul>\n";
}

std::string merit_table(const FiguresOfMerit& figures, const Verdict& verdict, const SliceBands& slices) {
  const Judgement& judgement = verdict.judgement;
  const bool volume = !slices.of_slice.empty();
  std::string rows;
  const auto row = [&](const std::string& label, const std::string& value, const std::string& limits,
                       const std::string& best, const std::string& score, const std::string& mark,
                       const std::string& worst = "") {
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}</tr>\n",
        label, value, limits, best, score, mark, volume ? fmt::format("<td>{}</td>", worst) : "");
  };
  const auto with_threshold = [&](const std::string& name, double value, const std::string& worst = "") {
    std::string limits, best, score, mark;
    for (const JudgedFigure& judged : judgement.judged) {
      if (judged.figure == name) limits = allowed(judged.low, judged.high), mark = badge(judged.passed);
    }
    for (const GradePart& part : judgement.grade.parts) {
      if (part.figure != name) continue;
      if (name != "anisotropy_db_mean") best = number(part.best);
      score = score_text(part.score);
    }
    row(label_of(name), number(value), limits, best, score, mark, worst);
  };
  for (std::size_t b = 0; b < figures.bands.mean.size(); ++b) {
    with_threshold(fmt::format("bands[{}]", b), figures.bands.mean[b], volume ? slices.greatest(b) : "");
  }
  if (figures.shape.depth > 1) {
    with_threshold("temporal_power_at_0", figures.temporal_power_at_0);
    with_threshold("temporal_power_low", figures.temporal_power_low);
    with_threshold("filtered_residual_db", figures.filtered_residual_db);
  }
  with_threshold("anisotropy_db_mean", figures.anisotropy_db_mean);
  with_threshold("anisotropy_db_max", figures.anisotropy_db_max);
  with_threshold("histogram_max_deviation", figures.histogram_max_deviation);
  const bool constant = !(figures.peak > 0.0);
  row("peak of the radial power",
      fmt::format("{} at {}", number(figures.peak), frequency(figures.peak_frequency)),
      constant ? "above 0" : "", "", "", constant ? badge(false) : "");
  for (std::size_t s = 0; s < kResidualSigmas.size(); ++s) {
    row(fmt::format("left by a Gaussian blur of {:.1f} px, dB", kResidualSigmas[s]),
        number(figures.gauss_residual_db[s]), "", "", "", "");
  }
  return fmt::format(
      "<div class=\"wide\"><table class=\"merit\"><caption><b>Figures of merit.</b> Power is against white "
      "noise, "
      "which reads 1. Score: 100 is as good as the best known of this size, 0 no better than white noise; "
      "the least "
      "is the grade.</caption><thead><tr><th scope=\"col\">figure</th><th scope=\"col\">value</th><th "
      "scope=\"col\">allowed</th><th scope=\"col\">best known</th><th scope=\"col\">score</th><th "
      "scope=\"col\">verdict</th>{}</tr></thead><tbody>{}</tbody></table></div>\n",
      volume ? "<th scope=\"col\">worst slice</th>" : "", rows);
}

}  // namespace bn::report

bn::Check bn::natural_check(Shape shape, const std::optional<Metadata>& metadata) {
  const bool for_a_filter = metadata && metadata->kind == "spatiotemporal-mask" &&
                            metadata->facts.get<std::string>("preset") == "filtered";
  return shape.depth > 1 && !for_a_filter ? Check::stbn : Check::blue;
}
