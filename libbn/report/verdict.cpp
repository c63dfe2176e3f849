#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "report/html.h"

namespace bn::report {
namespace {

bool all_passed(const std::vector<JudgedFigure>& judged) {
  return std::all_of(judged.begin(), judged.end(), [](const auto& f) { return f.passed; });
}

/// Whether the figures called `name...` passed; figures that are not judged do.
bool passed(const std::vector<JudgedFigure>& judged, std::string_view name) {
  return std::all_of(judged.begin(), judged.end(), [&](const auto& f) {
    return f.passed || !std::string_view(f.figure).starts_with(name);
  });
}

std::string allowed(double low, double high) {
  if (std::isinf(low) || low == 0.0) return std::isinf(high) ? "above 0" : "≤ " + number(high);
  return number(low) + " … " + number(high);
}

}  // namespace

Verdict verdict_of(const Texture& texture, const FiguresOfMerit& figures) {
  const bool volume = figures.shape.depth > 1;
  const char* name = volume ? "blue in space and time" : "blue noise";
  const bool white = check(figures, Check::white).empty();
  Verdict verdict{.judged = judge(figures, volume ? Check::stbn : Check::blue), .badge_html = {}};
  if (all_passed(verdict.judged)) {
    verdict.outcome = Verdict::Outcome::passed;
    verdict.badge_html = badge(true, name);
    return verdict;
  }
  const bool claims_to_be = volume || (texture.metadata && texture.metadata->kind == "mask");
  const bool looks_so = white || passed(verdict.judged, "histogram") || passed(verdict.judged, "bands");
  if (!claims_to_be && !looks_so) {
    verdict.badge_html = "<span class=\"badge plain\">not judged</span>";
    verdict.judged.clear();
    return verdict;
  }
  verdict.outcome = Verdict::Outcome::failed;
  verdict.badge_html = badge(false, white ? "white noise" : fmt::format("not {}", name));
  return verdict;
}

std::string label_of(const std::string& figure) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kLabels{{
      {"bands[0]", "power, 0 &lt; <i>f</i> ≤ .0625"},
      {"bands[1]", "power, .0625 &lt; <i>f</i> ≤ .125"},
      {"bands[2]", "power, .125 &lt; <i>f</i> ≤ .1875"},
      {"bands[3]", "power, .1875 &lt; <i>f</i> ≤ .25"},
      {"bands[4]", "power, .25 &lt; <i>f</i> ≤ .5"},
      {"anisotropy_db_mean", "anisotropy, mean, dB"},
      {"anisotropy_db_max", "anisotropy, largest, dB"},
      {"histogram_max_deviation", "histogram, largest deviation"},
      {"temporal_power_at_0", "power in time, 0 cycles/frame"},
      {"temporal_power_low", "power in time, 0 &lt; <i>f</i> ≤ .125"},
  }};
  for (const auto& [name, label] : kLabels) {
    if (name == figure) return std::string(label);
  }
  return escaped(figure);
}

std::string frequency(double f) { return std::isnan(f) ? "–" : fmt::format("{:.3f}", f); }

std::string merit_table(const FiguresOfMerit& figures, const Verdict& verdict) {
  std::string rows;
  const auto row = [&](const std::string& label, const std::string& value, const std::string& limits,
                       const std::string& mark) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n", label, value,
                        limits, mark);
  };
  const auto with_threshold = [&](const std::string& name, double value) {
    const auto judged = std::find_if(verdict.judged.begin(), verdict.judged.end(),
                                     [&](const JudgedFigure& f) { return f.figure == name; });
    const bool is = judged != verdict.judged.end();
    row(label_of(name), number(value), is ? allowed(judged->low, judged->high) : "",
        is ? badge(judged->passed) : "");
  };
  for (std::size_t b = 0; b < figures.bands.mean.size(); ++b) {
    with_threshold(fmt::format("bands[{}]", b), figures.bands.mean[b]);
  }
  if (figures.shape.depth > 1) {
    with_threshold("temporal_power_at_0", figures.temporal_power_at_0);
    with_threshold("temporal_power_low", figures.temporal_power_low);
  }
  with_threshold("anisotropy_db_mean", figures.anisotropy_db_mean);
  with_threshold("anisotropy_db_max", figures.anisotropy_db_max);
  with_threshold("histogram_max_deviation", figures.histogram_max_deviation);
  const bool constant = !(figures.peak > 0.0);
  row("peak of the radial power",
      fmt::format("{} at {}", number(figures.peak), frequency(figures.peak_frequency)),
      constant ? "above 0" : "", constant ? badge(false) : "");
  for (std::size_t s = 0; s < kResidualSigmas.size(); ++s) {
    row(fmt::format("left by a Gaussian blur of {:.1f} px, dB", kResidualSigmas[s]),
        number(figures.gauss_residual_db[s]), "", "");
  }
  return fmt::format(
      "<div class=\"wide\"><table class=\"merit\"><caption><b>Figures of merit.</b> Power is against white "
      "noise, "
      "which reads 1.{}</caption><thead><tr><th scope=\"col\">figure</th><th scope=\"col\">value</th><th "
      "scope=\"col\">allowed</th><th scope=\"col\"></th></tr></thead><tbody>{}</tbody></table></div>\n",
      verdict.outcome == Verdict::Outcome::not_judged
          ? " Not judged: this picture neither says that it is a mask nor looks like one."
          : "",
      rows);
}

}  // namespace bn::report
