// One texture: what it looks like, what is in it, whether it is what it should be.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.h"
#include "report/section.h"
#include "report/slice_bands.h"
#include "report/texture_pictures.h"
#include "report/verdict.h"

namespace bn::report {
namespace {

constexpr int kCorrelated = 16;  ///< distances of the autocorrelation

Plot correlation_plot(const std::vector<double>& r, Shape shape, std::string file_name) {
  Plot plot{PlotStyle::autocorrelation, std::move(file_name), "distance_pixels", "autocorrelation", {}};
  plot.curves.push_back({"white noise", Role::white, 0, {1.0, kCorrelated}, {0.0, 0.0}});
  Curve x{"along x", Role::texture, 0, {}, {}}, y{"along y", Role::texture, 1, {}, {}};
  for (int d = 1; d <= kCorrelated; ++d) {
    if (d < shape.width) {
      x.x.push_back(d);
      x.y.push_back(r[static_cast<std::size_t>(d)]);
    }
    if (d < shape.height) {
      y.x.push_back(d);
      y.y.push_back(r[static_cast<std::size_t>(d) * static_cast<std::size_t>(shape.width)]);
    }
  }
  for (Curve* curve : {&x, &y}) {
    if (!curve->x.empty()) plot.curves.push_back(std::move(*curve));
  }
  return plot;
}

Plot histogram_plot(const Texture& texture, std::string file_name) {
  const int bins = static_cast<int>(std::min<std::int64_t>(kHistogramBins, texture.shape.count()));
  const auto& [values, low, high] = texture.samples;
  const auto counts = histogram(values, low, std::max(high, low + 1e-300), bins);
  Plot plot{PlotStyle::histogram, std::move(file_name), "value", "count_against_even", {}};
  plot.curves.push_back({"evenly spread", Role::white, 0, {0.0, 1.0}, {1.0, 1.0}});
  Curve curve{"this texture", Role::texture, 0, {}, {}};
  for (int b = 0; b < bins; ++b) {
    curve.x.push_back((b + 0.5) / bins);
    curve.y.push_back(static_cast<double>(counts[static_cast<std::size_t>(b)]) * bins /
                      static_cast<double>(texture.shape.count()));
  }
  plot.curves.push_back(std::move(curve));
  return plot;
}

std::string about(const Texture& texture) {
  std::string line = fmt::format("{} pixels, {}", size_of(texture.shape), name_of(texture.type));
  if (texture.metadata) {
    if (!texture.metadata->algorithm.empty()) line += ", " + escaped(texture.metadata->algorithm);
    if (texture.metadata->facts.get<std::int64_t>("seed"))
      line += fmt::format(", seed {}", *texture.metadata->facts.get<std::int64_t>("seed"));
  }
  if (texture.seconds) line += fmt::format(", made in {} s", number(*texture.seconds));
  if (!texture.independence.empty())
    line += ". " + texture.independence.substr(0, texture.independence.size() - 1);
  std::string html = fmt::format("<p class=\"about\">{}.", line);
  if (!texture.also.empty()) {
    std::string also;
    for (const std::string& name : texture.also) also += (also.empty() ? "" : ", ") + escaped(name);
    html += fmt::format(" Also as {}.", also);
  }
  html += "</p>\n";
  if (texture.metadata && !texture.metadata->recipe.empty()) {
    html += fmt::format("<details><summary>Recipe</summary><pre>{}</pre></details>\n",
                        escaped(texture.metadata->recipe));
  }
  return html;
}

std::string card(const TextureView& view, const FiguresOfMerit& figures, const Verdict& verdict) {
  std::string facts = fact("grade, of 100", score_text(verdict.judgement.grade.score));
  for (std::size_t b = 0; b < figures.bands.mean.size(); ++b) {
    facts += fact(label_of(fmt::format("bands[{}]", b)), number(figures.bands.mean[b]));
  }
  facts += fact("peak", fmt::format("{} at {}", number(figures.peak), frequency(figures.peak_frequency))) +
           fact(label_of("anisotropy_db_mean"), number(figures.anisotropy_db_mean)) +
           fact("left by a blur of 1.5 px, dB", number(figures.gauss_residual_db[1])) +
           fact(label_of("histogram_max_deviation"), number(figures.histogram_max_deviation));
  return fmt::format("<h3>{} {}</h3>{}<table class=\"facts\"><tbody>{}</tbody></table>",
                     escaped(view.texture.name), verdict.badge_html, card_pictures(view), facts);
}

/// Figures that are undefined stand last, however the table is sorted.
Cell cell(double value, std::string html, bool least_first = true) {
  return {std::move(html), std::isnan(value) ? 1e300 : least_first ? value : -value};
}

std::vector<Cell> overview_of(const FiguresOfMerit& figures, const Verdict& verdict) {
  const double score = verdict.judgement.grade.score;
  std::vector<Cell> cells{{verdict.badge_html, static_cast<double>(verdict.outcome)},
                          cell(score, score_text(score), false)};
  for (std::size_t b = 0; b < 4; ++b) {
    cells.push_back(cell(figures.bands.mean[b], number(figures.bands.mean[b])));
  }
  cells.push_back(cell(figures.peak, number(figures.peak)));
  cells.push_back(cell(figures.anisotropy_db_mean, number(figures.anisotropy_db_mean)));
  cells.push_back(cell(figures.histogram_max_deviation, number(figures.histogram_max_deviation)));
  cells.push_back(cell(static_cast<double>(figures.shape.count()), size_of(figures.shape)));
  return cells;
}

}  // namespace

Section texture_section(const Texture& texture, const Reference& reference, const std::string& file_name,
                        const Execution& execution) {
  const Shape shape = texture.shape, flat{shape.width, shape.height};
  const bool volume = shape.depth > 1;
  const auto& [values, low, high] = texture.samples;
  const Analysis analysis = analyse(values, shape, low, std::max(high, low + 1e-300), execution);
  const PowerSpectrum plane = volume ? project(analysis.power, Projection::xy) : analysis.power;
  const FiguresOfMerit& figures = analysis.figures;
  const Verdict verdict = verdict_of(texture, analysis, execution);
  const std::vector<double> r = autocorrelation(plane, execution);
  const std::vector<double> slice(values.begin(), values.begin() + flat.count());
  const TextureView view{texture, analysis.power, plane, r, slice};

  Section section;
  section.group = Group::texture;
  section.grade = verdict.judgement.grade.score;
  section.weak = verdict.outcome == Verdict::Outcome::weak;
  section.failed = verdict.outcome == Verdict::Outcome::failed;
  section.not_judged = verdict.outcome == Verdict::Outcome::not_judged;
  const auto add_plot = [&](Plot plot, std::string_view title, const std::string& caption) {
    plot.wide = true;  // two in a row
    section.plots.push_back(std::move(plot));
    return plot_figure(section.plots.back(), section.plots.size() - 1, title, caption);
  };
  const RadialCurve radial = radial_power(plane);
  Plot power = power_plot(file_name + "-power", reference);
  power.curves.push_back({texture.name, Role::texture, 0, radial.frequency, radial.power});
  Plot anisotropy = anisotropy_plot(file_name + "-anisotropy", reference);
  anisotropy.curves.push_back({texture.name, Role::texture, 0, radial.frequency, radial.anisotropy_db});
  // The first two are those that --compare puts over each other.
  std::string main_plots = add_plot(
      std::move(power), "Radial power",
      fmt::format("Mean over annuli. Lowest band {}, peak {} at {} cycles/pixel.",
                  number(figures.bands.mean[0]), number(figures.peak), frequency(figures.peak_frequency)));
  std::string plots =
      add_plot(std::move(anisotropy), "Anisotropy",
               fmt::format("In dB; one isotropic texture scatters about 0. Mean {}, largest {}.",
                           number(figures.anisotropy_db_mean), number(figures.anisotropy_db_max)));
  plots +=
      add_plot(correlation_plot(r, flat, file_name + "-autocorrelation"), "Autocorrelation along the axes",
               fmt::format("At one pixel {} along x, {} along y.", shape.width > 1 ? number(r[1]) : "–",
                           shape.height > 1 ? number(r[static_cast<std::size_t>(shape.width)]) : "–"));
  plots += add_plot(histogram_plot(texture, file_name + "-histogram"), "Histogram",
                    fmt::format("Counts against an even spread. Largest deviation {}.",
                                number(figures.histogram_max_deviation)));
  SliceBands slices;
  if (volume) {
    slices = slice_bands(values, shape, execution);
    main_plots += add_plot(slices.plot(file_name + "-slices"), "Power by slice", slices.words());
    RadialCurve time = radial_power(project(analysis.power, Projection::z));
    time.frequency.insert(time.frequency.begin(), 0.0);
    time.power.insert(time.power.begin(), figures.temporal_power_at_0);
    Plot plot{PlotStyle::power_in_time, file_name + "-time", "frequency_cycles_per_frame", "power", {}};
    plot.curves.push_back({"white noise", Role::white, 0, {0.0, 0.5}, {1.0, 1.0}});
    plot.curves.push_back({texture.name, Role::texture, 0, time.frequency, time.power});
    main_plots += add_plot(
        std::move(plot), "Power in time",
        fmt::format("Of the pixels' sequences; {} at 0 cycles/frame.", number(figures.temporal_power_at_0)));
  }

  const std::string grade =
      std::isnan(section.grade) ? "" : badge_of("plain", "grade " + score_text(section.grade));
  section.html = fmt::format("<h2>{} {} {}</h2>\n{}{}", escaped(texture.name), verdict.badge_html, grade,
                             reasons_html(verdict), about(texture)) +
                 gallery(view, execution) + "<div class=\"pair\">" + tiling(view) +
                 merit_table(figures, verdict, slices) + "</div>\n" + levels(view, execution) +
                 (volume ? volume_strips(view, execution) : "") + "<div class=\"plots two\">" + main_plots +
                 plots + "</div>\n";
  section.overview = overview_of(figures, verdict);
  section.card = card(view, figures, verdict);
  return section;
}

}  // namespace bn::report
