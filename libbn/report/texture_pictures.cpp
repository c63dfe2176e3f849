#include "report/texture_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.h"
#include "report/pictures.h"

namespace bn::report {
namespace {

constexpr int kMostShown = 512;      ///< pixels a side of the picture
constexpr int kSpectrumShown = 256;  ///< of the spectrum: as large as the texture beside it
constexpr int kShownWide = 256;      ///< page pixels, about
constexpr int kTiled = 384;
constexpr int kLevelSide = 64;
constexpr Extent kPhotograph{288, 256};  ///< as high as the pictures beside it
constexpr int kCorrelated = 16;          ///< distances of the autocorrelation
constexpr int kSlices = 8;

/// Slice `z` as grey.
Grid<std::uint8_t> grey_of(const Texture& texture, int z) {
  Grid<std::uint8_t> grey({texture.shape.width, texture.shape.height});
  const auto& [values, low, high] = texture.samples;
  const std::size_t first = static_cast<std::size_t>(z) * grey.count();
  const double span = high > low ? high - low : 1.0;
  for (std::size_t i = 0; i < grey.count(); ++i) {
    grey[i] = static_cast<std::uint8_t>(
        std::clamp(std::floor((values[first + i] - low) / span * 256.0), 0.0, 255.0));
  }
  return grey;
}

std::string spectrum_figure(const Image& spectrum, std::string_view title, std::string caption) {
  return figure({.image = spectrum,
                 .scale = scale_for(spectrum.size.width, kShownWide),
                 .title = std::string(title),
                 .caption = std::move(caption)});
}

/// r(d) as picture: as much as is within kCorrelated pixels.
std::string correlation_figure(const std::vector<double>& r, Shape shape) {
  const int reach_x = std::min(kCorrelated, shape.width / 2);
  const int reach_y = std::min(kCorrelated, shape.height / 2);
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
  return figure(
      {.image = signed_image(part, kFull),
       .scale = scale_for(part.width(), kShownWide),
       .title = "Autocorrelation.",
       .caption = fmt::format("Up to {} pixels; blue −{}, orange +{} and more, the middle is 1. Least "
                              "value {}: neighbours differ.",
                              std::max(reach_x, reach_y), kFull, kFull, number(least))});
}

/// Values in 0..1 by rank, slice by slice.
Grid<double> evenly_spread(const Texture& texture, int z, const Execution& execution) {
  Grid<double> value({texture.shape.width, texture.shape.height});
  const auto begin = texture.samples.value.begin() +
                     static_cast<std::ptrdiff_t>(z) * static_cast<std::ptrdiff_t>(value.count());
  const std::vector<double> slice(begin, begin + static_cast<std::ptrdiff_t>(value.count()));
  const auto ranks = midranks(slice, execution);
  for (std::size_t i = 0; i < value.count(); ++i) {
    value[i] = (ranks[i] + 0.5) / static_cast<double>(value.count());
  }
  return value;
}

std::string photograph_figure(const TextureView& view, const Execution& execution) {
  return figure(
      {.image = grey_image(dithered(photograph(kPhotograph), evenly_spread(view.texture, 0, execution))),
       .scale = 1,
       .title = "Put to use.",
       .caption = fmt::format("{} × {} pixels in black and white only, thresholded with this texture.",
                              kPhotograph.width, kPhotograph.height)});
}

}  // namespace

std::string size_of(Shape shape) {
  return fmt::format("{} × {}", shape.width, shape.height) +
         (shape.depth > 1 ? fmt::format(" × {}", shape.depth) : "");
}

std::string gallery(const TextureView& view, const Execution& execution) {
  const Grid<std::uint8_t> grey = grey_of(view.texture, 0);
  const int w = grey.width(), h = grey.height();
  const Extent shown{std::min(w, kMostShown), std::min(h, kMostShown)};
  const bool volume = view.texture.shape.depth > 1;
  std::string caption = shown == grey.size() ? fmt::format("All {} × {} pixels.", w, h)
                                             : fmt::format("The first {} × {} of {} × {} pixels.",
                                                           shown.width, shown.height, w, h);
  if (shown.width > kShownWide) caption += " Cut here; a click shows them all.";
  std::string html = figure({.image = grey_image(window(grey, 0, 0, shown)),
                             .scale = scale_for(shown.width, kShownWide),
                             .title = volume ? "The first slice." : "The texture.",
                             .caption = caption,
                             .shown = kShownWide});
  html +=
      spectrum_figure(spectrum_image(view.plane, kSpectrumShown), "Spectrum.",
                      fmt::format("Decibels, black −50, white +12.5, white noise 0{}. Zero frequency in the "
                                  "middle, ±½ cycle/pixel at the edges. Blue noise: a dark, round hole.",
                                  volume ? "; mean of the slices" : ""));
  if (volume) {
    html += spectrum_figure(made_square(spectrum_image(project(view.power, Projection::xz), kSpectrumShown)),
                            "Spectrum in x and time.",
                            "Averaged over y. Across: cycles/pixel; down: cycles/frame, ±½ at the edges. "
                            "Blue in time: a dark band "
                            "across the middle.");
  }
  html += correlation_figure(view.correlation, {view.texture.shape.width, view.texture.shape.height});
  if (!volume) html += photograph_figure(view, execution);
  return "<div class=\"gallery\">" + html + "</div>\n";
}

std::string tiling(const TextureView& view) {
  const Grid<std::uint8_t> grey = grey_of(view.texture, 0);
  const int w = grey.width(), h = grey.height();
  const Extent tiled{std::min(3 * w, kTiled), std::min(3 * h, kTiled)};
  const bool whole = tiled.width == 3 * w && tiled.height == 3 * h;
  return figure(
      {.image =
           grey_image(window(grey, whole ? 0 : w - tiled.width / 2, whole ? 0 : h - tiled.height / 2, tiled)),
       .scale = scale_for(tiled.width, kTiled),
       .title = "Tiled 3 × 3.",
       .caption = whole ? "A toroidal texture shows no seams."
                        : fmt::format(
                              "The {} × {} pixels where four copies meet; a toroidal texture shows no seams.",
                              tiled.width, tiled.height)});
}

std::string levels(const TextureView& view, const Execution& execution) {
  const Shape flat{view.texture.shape.width, view.texture.shape.height};
  const Extent shown{std::min(flat.width, kLevelSide), std::min(flat.height, kLevelSide)};
  std::string html;
  for (int n = 1; n < 16; ++n) {
    const auto bits = thresholded(view.slice, n / 16.0, execution);
    Grid<std::uint8_t> picture(Extent{flat.width, flat.height});
    for (std::size_t i = 0; i < picture.count(); ++i) picture[i] = bits[i] > 0.0 ? 255 : 0;
    html += "<div class=\"level\">" +
            thumbnail(grey_image(window(picture, 0, 0, shown)), 1, "thresholded", fmt::format("{}/16", n));
    // A picture without a point, or full of them, has no spectrum: nothing would be the best figure of all.
    if (std::all_of(bits.begin(), bits.end(), [&](double bit) { return bit == bits[0]; })) {
      html += bits[0] > 0.0 ? "<p class=\"none\">all set</p></div>" : "<p class=\"none\">no point</p></div>";
      continue;
    }
    const PowerSpectrum power = power_spectrum(bits, flat, execution);
    html +=
        thumbnail(spectrum_image(power, kLevelSide), 1, "its spectrum", number(band_power(power).mean[0])) +
        "</div>";
  }
  return fmt::format(
      "<div class=\"strip\"><h4>Thresholded at 1/16 … 15/16</h4><p>Points must keep their distance at every "
      "grey. "
      "Below each its spectrum, and its power in 0 &lt; <i>f</i> ≤ 0.0625 against white noise.</p><div "
      "class=\"levels\">{}</div></div>\n",
      html);
}

std::string volume_strips(const TextureView& view, const Execution& execution) {
  const Shape shape = view.texture.shape;
  const int count = std::min(kSlices, shape.depth);
  const Extent shown{std::min(shape.width, 128), std::min(shape.height, 128)};
  std::string slices;
  for (int i = 0; i < count; ++i) {
    const int z = static_cast<int>(std::int64_t{i} * shape.depth / count);
    slices += thumbnail(grey_image(window(grey_of(view.texture, z), 0, 0, shown)),
                        scale_for(shown.width, 128), "slice", fmt::format("slice {}", z));
  }
  std::string html = fmt::format(
      "<div class=\"strip\"><h4>Slices</h4><p>{} of {}.</p><div class=\"slices\">{}</div></div>\n", count,
      shape.depth, slices);

  // The mean of the first 1, 4 and 16 dithered frames.
  const Grid<double> photo = photograph(kPhotograph);
  std::vector<int> white(photo.count());
  std::string frames;
  for (int z = 0; z < std::min(16, shape.depth); ++z) {
    const Grid<std::uint8_t> bits = dithered(photo, evenly_spread(view.texture, z, execution));
    for (std::size_t i = 0; i < white.size(); ++i) white[i] += bits[i];
    const int n = z + 1;
    if (n != 1 && n != 4 && n != 16) continue;
    Grid<std::uint8_t> mean(photo.size());
    for (std::size_t i = 0; i < white.size(); ++i) mean[i] = static_cast<std::uint8_t>(white[i] / n);
    frames +=
        figure({.image = grey_image(mean),
                .scale = 1,
                .title = n == 1 ? "Put to use." : fmt::format("{} frames.", n),
                .caption = n == 1 ? "A picture in black and white only, thresholded with the first slice."
                                  : fmt::format("The mean of {} frames, each thresholded with a slice of its "
                                                "own.",
                                                n)});
  }
  return html + "<div class=\"gallery\">" + frames + "</div>\n";
}

std::string card_pictures(const TextureView& view) {
  // Two in a card, of a third of the page or of a narrow one.
  constexpr int kInCard = 150;
  const Grid<std::uint8_t> grey = grey_of(view.texture, 0);
  const Extent shown{std::min(grey.width(), kInCard), std::min(grey.height(), kInCard)};
  const Image spectrum = spectrum_image(view.plane, kInCard);
  return "<div class=\"pictures\">" +
         figure({.image = grey_image(window(grey, 0, 0, shown)),
                 .scale = scale_for(shown.width, kInCard),
                 .title = "",
                 .caption = size_of(view.texture.shape) + " pixels"}) +
         figure({.image = spectrum,
                 .scale = scale_for(spectrum.size.width, kInCard),
                 .title = "",
                 .caption = "Spectrum"}) +
         "</div>";
}

}  // namespace bn::report
