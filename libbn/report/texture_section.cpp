// One texture: what it looks like, what is in it, whether it is what it should be.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/html.h"
#include "report/pictures.h"
#include "report/section.h"

namespace bn::report {
namespace {

constexpr int kMostShown = 512;  ///< pixels a side of the picture and the spectrum
constexpr int kTiled = 384;      ///< of the tiling
constexpr int kLevelSide = 64;   ///< of a thresholded picture
constexpr Extent kPhotograph{288, 192};
constexpr int kCorrelated = 16;  ///< distances of the autocorrelation
constexpr int kSlices = 8;

std::string size_of(Shape shape) {
  return fmt::format("{} × {}", shape.width, shape.height) +
         (shape.depth > 1 ? fmt::format(" × {}", shape.depth) : "");
}

std::string frequency(double f) { return fmt::format("{:.3f}", f); }

/// The words of a figure, by its JSON name.
std::string label_of(const std::string& figure) {
  static const std::array<std::pair<std::string_view, std::string_view>, 10> kLabels{{
      {"bands[0]", "power, 0 &lt; <i>f</i> ≤ .0625"},
      {"bands[1]", "power, .0625 &lt; <i>f</i> ≤ .125"},
      {"bands[2]", "power, .125 &lt; <i>f</i> ≤ .1875"},
      {"bands[3]", "power, .1875 &lt; <i>f</i> ≤ .25"},
      {"bands[4]", "power, .25 &lt; <i>f</i> ≤ .5"},
      {"anisotropy_db_mean", "anisotropy, mean, dB"},
      {"anisotropy_db_max", "anisotropy, largest, dB"},
      {"histogram_max_deviation", "histogram, largest deviation"},
      {"temporal_power_at_0", "power in time at 0 cycles/frame"},
      {"temporal_power_low", "power in time, 0 &lt; <i>f</i> ≤ .125 cycles/frame"},
  }};
  for (const auto& [name, label] : kLabels) {
    if (name == figure) return std::string(label);
  }
  return escaped(figure);
}

std::string allowed(double low, double high) {
  if (std::isinf(low) || low == 0.0) return std::isinf(high) ? "above 0" : "≤ " + number(high);
  return number(low) + " … " + number(high);
}

struct Verdict {
  std::vector<JudgedFigure> judged;
  bool passed = false;
  std::string badge_html;
};

Verdict verdict_of(const FiguresOfMerit& figures) {
  const bool volume = figures.shape.depth > 1;
  Verdict verdict;
  verdict.judged = judge(figures, volume ? Check::stbn : Check::blue);
  verdict.passed =
      std::all_of(verdict.judged.begin(), verdict.judged.end(), [](const auto& f) { return f.passed; });
  const char* name = volume ? "blue in space and time" : "blue noise";
  if (verdict.passed) {
    verdict.badge_html = badge(true, name);
  } else if (check(figures, Check::white).empty()) {
    verdict.badge_html = badge(false, "white noise");
  } else {
    verdict.badge_html = badge(false, fmt::format("not {}", name));
  }
  return verdict;
}

std::string merit_table(const FiguresOfMerit& figures, const Verdict& verdict) {
  std::string rows;
  for (const auto& [figure, value, low, high, passed] : verdict.judged) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        label_of(figure), number(value), allowed(low, high), badge(passed));
  }
  const auto plain = [&](std::string_view label, const std::string& value) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td></td><td></td></tr>\n", label, value);
  };
  plain(label_of("bands[4]"), number(figures.bands.mean[4]));
  plain("peak of the radial power",
        fmt::format("{} at {}", number(figures.peak), frequency(figures.peak_frequency)));
  for (std::size_t s = 0; s < kResidualSigmas.size(); ++s) {
    plain(fmt::format("left by a Gaussian blur of {:.1f} px, dB", kResidualSigmas[s]),
          number(figures.gauss_residual_db[s]));
  }
  return fmt::format(
      "<div class=\"wide\"><table class=\"merit\"><caption>Figures of merit; power is against white noise, "
      "which "
      "reads 1.</caption><thead><tr><th scope=\"col\">figure</th><th scope=\"col\">value</th><th "
      "scope=\"col\">allowed</th><th scope=\"col\"></th></tr></thead><tbody>{}</tbody></table></div>\n",
      rows);
}

/// Slice `z` as grey.
Grid<std::uint8_t> grey_of(const Texture& texture, int z) {
  Grid<std::uint8_t> grey({texture.shape.width, texture.shape.height});
  const std::size_t first = static_cast<std::size_t>(z) * grey.count();
  const double span =
      texture.samples.high > texture.samples.low ? texture.samples.high - texture.samples.low : 1.0;
  for (std::size_t i = 0; i < grey.count(); ++i) {
    const double share = (texture.samples.value[first + i] - texture.samples.low) / span;
    grey[i] = static_cast<std::uint8_t>(std::clamp(std::floor(share * 256.0), 0.0, 255.0));
  }
  return grey;
}

std::string pictures_of(const Texture& texture, const PowerSpectrum& plane) {
  const Grid<std::uint8_t> grey = grey_of(texture, 0);
  const int w = grey.width(), h = grey.height();
  const Extent shown{std::min(w, kMostShown), std::min(h, kMostShown)};
  const bool volume = texture.shape.depth > 1;
  std::string html;
  html += figure({.image = grey_image(window(grey, 0, 0, shown)),
                  .scale = scale_for(shown.width, 256),
                  .title = volume ? "The first slice." : "The texture.",
                  .caption = shown == grey.size() ? fmt::format("All {} × {} pixels.", w, h)
                                                  : fmt::format("The first {} × {} of {} × {} pixels.",
                                                                shown.width, shown.height, w, h)});

  const Extent tiled{std::min(3 * w, kTiled), std::min(3 * h, kTiled)};
  const bool whole_tiling = tiled.width == 3 * w && tiled.height == 3 * h;
  html += figure(
      {.image = grey_image(window(grey, whole_tiling ? 0 : w - tiled.width / 2,
                                  whole_tiling ? 0 : h - tiled.height / 2, tiled)),
       .scale = scale_for(tiled.width, kTiled),
       .title = "Tiled 3 × 3.",
       .caption = whole_tiling ? "A toroidal texture shows no seams."
                               : fmt::format("The {} × {} pixels where four copies meet; a toroidal texture "
                                             "shows no seams.",
                                             tiled.width, tiled.height)});

  const Image spectrum = spectrum_image(plane, kMostShown);
  html += figure(
      {.image = spectrum,
       .scale = scale_for(spectrum.size.width, 256),
       .title = "Spectrum.",
       .caption = fmt::format("Power in decibels, black −50 dB, white +12.5 dB, white noise 0 dB{}. Zero "
                              "frequency in the middle, ±½ cycle/pixel at the edges. Blue noise: a dark, "
                              "round hole.",
                              volume ? ", averaged over the slices" : "")});
  return html;
}

/// r(d) as picture: as much as is within kCorrelated pixels.
std::string correlation_picture(const std::vector<double>& r, Shape shape) {
  const int reach_x = std::min(kCorrelated, shape.width / 2),
            reach_y = std::min(kCorrelated, shape.height / 2);
  Grid<double> part({2 * reach_x + 1, 2 * reach_y + 1});
  double least = 0.0;
  for (int y = -reach_y; y <= reach_y; ++y) {
    for (int x = -reach_x; x <= reach_x; ++x) {
      const double value =
          r[static_cast<std::size_t>(wrap(y, shape.height)) * static_cast<std::size_t>(shape.width) +
            static_cast<std::size_t>(wrap(x, shape.width))];
      part(x + reach_x, y + reach_y) = value;
      least = std::min(least, value);
    }
  }
  constexpr double kFull = 0.2;
  return figure({.image = signed_image(part, kFull),
                 .scale = scale_for(part.width(), 256),
                 .title = "Autocorrelation.",
                 .caption = fmt::format(
                     "Distances up to {} pixels; blue −{}, orange +{} and more, the middle is 1. Its "
                     "least value is {}: neighbours differ.",
                     reach_x, kFull, kFull, number(least))});
}

std::string photograph_picture(const Texture& texture, const std::vector<double>& ranks) {
  Grid<double> value({texture.shape.width, texture.shape.height});
  for (std::size_t i = 0; i < value.count(); ++i)
    value[i] = (ranks[i] + 0.5) / static_cast<double>(value.count());
  return figure(
      {.image = dithered(photograph(kPhotograph), value),
       .scale = 1,
       .title = "Put to use.",
       .caption = fmt::format("A picture of {} × {} pixels in black and white only, thresholded with this "
                              "texture.",
                              kPhotograph.width, kPhotograph.height)});
}

/// The texture thresholded at n/16, with spectra.
std::string levels_strip(const std::vector<double>& slice, Shape shape, const Execution& execution) {
  std::string html;
  const Extent shown{std::min(shape.width, kLevelSide), std::min(shape.height, kLevelSide)};
  for (int n = 1; n < 16; ++n) {
    const auto bits = thresholded(slice, n / 16.0, execution);
    Grid<std::uint8_t> grey({shape.width, shape.height});
    for (std::size_t i = 0; i < grey.count(); ++i) grey[i] = bits[i] > 0.0 ? 255 : 0;
    const PowerSpectrum power = power_spectrum(bits, shape, execution);
    const double low = band_power(power).mean[0];
    html += fmt::format(
        "<div class=\"level\">{}{}</div>",
        thumbnail(grey_image(window(grey, 0, 0, shown)), 1, "thresholded", fmt::format("{}/16", n)),
        thumbnail(spectrum_image(power, kLevelSide), 1, "its spectrum", number(low)));
  }
  return fmt::format(
      "<div class=\"strip\"><h4>Thresholded at 1/16 … 15/16</h4><p>Below each its spectrum, and its power in "
      "0 &lt; "
      "<i>f</i> ≤ .0625 against white noise. Points must keep their distance at every grey.</p><div "
      "class=\"levels\">{}</div></div>\n",
      html);
}

std::string volume_strips(const Texture& texture, const PowerSpectrum& power) {
  const Shape shape = texture.shape;
  std::string html;
  const int count = std::min(kSlices, shape.depth);
  const Extent shown{std::min(shape.width, 128), std::min(shape.height, 128)};
  for (int i = 0; i < count; ++i) {
    const int z = static_cast<int>(std::int64_t{i} * shape.depth / count);
    html += thumbnail(grey_image(window(grey_of(texture, z), 0, 0, shown)), scale_for(shown.width, 128),
                      "slice", fmt::format("slice {}", z));
  }
  html = fmt::format(
      "<div class=\"strip\"><h4>Slices</h4><p>{} of {}.</p><div class=\"slices\">{}</div></div>\n", count,
      shape.depth, html);
  const Image xz = spectrum_image(project(power, Projection::xz), kMostShown);
  return figure({.image = xz,
                 .scale = scale_for(xz.size.width, 256),
                 .title = "Spectrum in x and time.",
                 .caption = "Averaged over y. Across: cycles/pixel; down: cycles/frame, ±½ at the edges; "
                            "scale as in the "
                            "spectrum. Blue in space and time: dark along both axes."}) +
         html;
}

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
  const auto counts = histogram(texture.samples.value, texture.samples.low,
                                std::max(texture.samples.high, texture.samples.low + 1e-300), bins);
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
  std::string facts;
  std::string line = fmt::format("{} pixels, {}", size_of(texture.shape), name_of(texture.type));
  if (texture.metadata) {
    line += ", " + escaped(texture.metadata->algorithm);
    if (texture.metadata->seed) line += fmt::format(", seed {}", *texture.metadata->seed);
  }
  if (texture.seconds) line += fmt::format(", made in {} s", number(*texture.seconds));
  facts = fmt::format("<p class=\"about\">{}.", line);
  if (!texture.also.empty()) {
    std::string also;
    for (const std::string& name : texture.also) also += (also.empty() ? "" : ", ") + escaped(name);
    facts += fmt::format(" Also as {}.", also);
  }
  facts += "</p>\n";
  if (texture.metadata && !texture.metadata->recipe.empty()) {
    facts += fmt::format("<details><summary>Recipe</summary><pre>{}</pre></details>\n",
                         escaped(texture.metadata->recipe));
  }
  return facts;
}

}  // namespace

Section texture_section(const Texture& texture, const Reference& reference, const std::string& file_name,
                        const Execution& execution) {
  const Shape shape = texture.shape;
  const bool volume = shape.depth > 1;
  const Analysis analysis =
      analyse(texture.samples.value, shape, texture.samples.low, texture.samples.high, execution);
  const PowerSpectrum plane = volume ? project(analysis.power, Projection::xy) : analysis.power;
  const RadialCurve radial = radial_power(plane);
  const FiguresOfMerit& figures = analysis.figures;
  const Verdict verdict = verdict_of(figures);
  const std::vector<double> r = autocorrelation(plane, execution);
  const Shape flat{shape.width, shape.height};
  const std::vector<double> slice(texture.samples.value.begin(),
                                  texture.samples.value.begin() + flat.count());

  Section section;
  section.failed = !verdict.passed;
  Plot power = power_plot(file_name + "-power", reference);
  power.curves.push_back({texture.name, Role::texture, 0, radial.frequency, radial.power});
  Plot anisotropy = anisotropy_plot(file_name + "-anisotropy", reference);
  anisotropy.curves.push_back({texture.name, Role::texture, 0, radial.frequency, radial.anisotropy_db});
  section.plots.push_back(std::move(power));
  section.plots.push_back(std::move(anisotropy));
  section.plots.push_back(correlation_plot(r, flat, file_name + "-autocorrelation"));
  section.plots.push_back(histogram_plot(texture, file_name + "-histogram"));
  if (volume) {
    const RadialCurve time = radial_power(project(analysis.power, Projection::z));
    Plot plot{PlotStyle::power, file_name + "-time", "frequency_cycles_per_frame", "power", {}};
    plot.curves.push_back({"white noise", Role::white, 0, {0.0, 0.5}, {1.0, 1.0}});
    plot.curves.push_back({texture.name, Role::texture, 0, time.frequency, time.power});
    section.plots.push_back(std::move(plot));
  }

  std::string& html = section.html;
  html += fmt::format("<h2>{} {}</h2>\n{}", escaped(texture.name), verdict.badge_html, about(texture));
  html += "<div class=\"gallery\">" + pictures_of(texture, plane);
  html += correlation_picture(r, flat);
  html += photograph_picture(texture, midranks(slice, execution));
  html += "</div>\n";
  if (volume) html += "<div class=\"gallery\">" + volume_strips(texture, analysis.power) + "</div>\n";
  html += levels_strip(slice, flat, execution);
  html += "<div class=\"plots\">";
  html += plot_figure(
      section.plots[0], 0, "Radial power",
      fmt::format("Mean over annuli. Lowest band {}, peak {} at {} cycles/pixel.",
                  number(figures.bands.mean[0]), number(figures.peak), frequency(figures.peak_frequency)));
  html += plot_figure(
      section.plots[1], 1, "Anisotropy",
      fmt::format("In dB; scatter about 0 dB is that of a single isotropic texture. Mean {} dB, largest "
                  "{} dB.",
                  number(figures.anisotropy_db_mean), number(figures.anisotropy_db_max)));
  html +=
      plot_figure(section.plots[2], 2, "Autocorrelation along the axes",
                  fmt::format("At one pixel {} along x, {} along y.", shape.width > 1 ? number(r[1]) : "–",
                              shape.height > 1 ? number(r[static_cast<std::size_t>(shape.width)]) : "–"));
  html += plot_figure(section.plots[3], 3, "Histogram",
                      fmt::format("Counts against an even spread. Largest deviation {}.",
                                  number(figures.histogram_max_deviation)));
  if (volume) {
    html += plot_figure(section.plots[4], 4, "Power in time",
                        fmt::format("Of the pixels' sequences, by cycles/frame; {} at 0.",
                                    number(figures.temporal_power_at_0)));
  }
  html += "</div>\n" + merit_table(figures, verdict);

  section.summary = fmt::format(
      "<td>{}</td><td>{}</td><td class=\"extra\">lowest band {}</td><td class=\"extra\">peak {}</td>",
      size_of(shape), verdict.badge_html, number(figures.bands.mean[0]), number(figures.peak));
  const Grid<std::uint8_t> grey = grey_of(texture, 0);
  const Extent shown{std::min(grey.width(), 256), std::min(grey.height(), 256)};
  const Image spectrum = spectrum_image(plane, 256);
  section.card = fmt::format(
      "<h3>{} {}</h3>{}{}<table class=\"facts\"><tbody>{}{}{}{}{}{}</tbody></table>", escaped(texture.name),
      verdict.badge_html,
      figure({.image = grey_image(window(grey, 0, 0, shown)),
              .scale = scale_for(shown.width, 256),
              .title = "",
              .caption = fmt::format("{} × {} pixels", shape.width, shape.height)}),
      figure({.image = spectrum,
              .scale = scale_for(spectrum.size.width, 256),
              .title = "",
              .caption = "Spectrum"}),
      fact(label_of("bands[0]"), number(figures.bands.mean[0])),
      fact(label_of("bands[1]"), number(figures.bands.mean[1])),
      fact(label_of("bands[3]"), number(figures.bands.mean[3])),
      fact("peak", fmt::format("{} at {}", number(figures.peak), frequency(figures.peak_frequency))),
      fact("anisotropy, mean, dB", number(figures.anisotropy_db_mean)),
      fact("left by a blur of 1.5 px, dB", number(figures.gauss_residual_db[1])));
  return section;
}

}  // namespace bn::report
