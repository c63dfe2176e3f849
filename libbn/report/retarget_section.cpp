// One retarget set: the moves, what they cost, and what is left of the dither after many of them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bn/error.h"
#include "bn/retarget.h"
#include "report/html.h"
#include "report/pictures.h"
#include "report/retarget_figures.h"
#include "report/section.h"

namespace bn::report {
namespace {

constexpr int kSpectrumShown = 256;  ///< pixels a side: four pictures fill a row

/// How far pixels go, beyond the motion, as the reach measures it.
Plot moves_plot(const RetargetSet& set, const RetargetSet::Tile& tile, std::string file_name) {
  const int radius = *set.metadata.facts.get<int>("radius");
  std::vector<std::int64_t> counts(static_cast<std::size_t>(radius) + 1);
  for (const Offset r : tile.move) {
    const int x = std::abs(r.x - tile.record.motion.x), y = std::abs(r.y - tile.record.motion.y);
    const int length = set.metadata.facts.get<std::string>("reach") == "euclidean"
                           ? static_cast<int>(std::lround(std::hypot(x, y)))
                           : std::max(x, y);
    ++counts[static_cast<std::size_t>(std::min(length, radius))];
  }
  Curve curve{"pixels", Role::texture, 0, {}, {}};
  for (int length = 0; length <= radius; ++length) {
    curve.x.push_back(length);
    curve.y.push_back(100.0 * static_cast<double>(counts[static_cast<std::size_t>(length)]) /
                      static_cast<double>(tile.move.count()));
  }
  return {PlotStyle::moves, std::move(file_name), "length_pixels", "share_percent", {std::move(curve)}};
}

/// Energy and bound of every motion as a table, coloured by energy.
std::string heat_map(const RetargetSet& set, int slice) {
  std::vector<RetargetSet::Tile> tiles;  // of that slice
  std::copy_if(set.tiles.begin(), set.tiles.end(), std::back_inserter(tiles),
               [&](const RetargetSet::Tile& tile) { return tile.slice == slice; });
  if (tiles.size() < 2) return {};
  const auto by_energy = [](const auto& a, const auto& b) { return a.record.energy < b.record.energy; };
  const auto [least, most] = std::minmax_element(tiles.begin(), tiles.end(), by_energy);
  const std::int64_t low = least->record.energy, high = most->record.energy;
  bool all_optimal = true;
  int range = 0;
  for (const auto& tile : tiles) {
    all_optimal &= tile.record.energy == tile.record.lower_bound;
    range = std::max({range, std::abs(tile.record.motion.x), std::abs(tile.record.motion.y)});
  }
  std::string rows = "<tr><td></td>";
  for (int x = -range; x <= range; ++x) rows += fmt::format("<th scope=\"col\">{}</th>", number(x));
  rows += "</tr>\n";
  for (int y = -range; y <= range; ++y) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", number(y));
    for (int x = -range; x <= range; ++x) {
      const auto tile = std::find_if(tiles.begin(), tiles.end(), [&](const auto& t) {
        return t.record.motion == Offset{x, y};
      });
      if (tile == tiles.end()) {
        rows += "<td></td>";
        continue;
      }
      const TileRecord& record = tile->record;
      const double share =
          high > low ? static_cast<double>(record.energy - low) / static_cast<double>(high - low) : 0.0;
      rows += fmt::format(
          "<td style=\"--heat:{:.0f}%\" title=\"motion {}, {}: energy {}, bound {}\">{}{}</td>",
          100.0 * share, x, y, whole(record.energy), whole(record.lower_bound), whole(record.energy),
          record.energy == record.lower_bound
              ? ""
              : fmt::format("<br><small>{}</small>", whole(record.lower_bound)));
    }
    rows += "</tr>\n";
  }
  return fmt::format(
      "<figure class=\"heatmap\"><figcaption><b>Energy by motion</b> {}Across in x, down in y; from {} to "
      "{}. "
      "{}</figcaption><div class=\"wide\"><table class=\"heat\"><tbody>{}</tbody></table></div></figure>\n",
      set.slices > 1 ? fmt::format("From slice {}. ", slice) : "", whole(low), whole(high),
      all_optimal ? "Every lower bound equals its energy: all proven optimal."
                  : "The small figure is the lower bound where it is not the energy itself.",
      rows);
}

std::string energies_csv(const RetargetSet& set) {
  const bool stack = set.slices > 1;
  std::string csv =
      fmt::format("{}motion_x,motion_y,start_energy,energy,lower_bound\n", stack ? "slice," : "");
  for (const auto& [record, move, slice] : set.tiles) {
    if (stack) csv += fmt::format("{},", slice);
    csv += fmt::format("{},{},{},{},{}\n", record.motion.x, record.motion.y, record.start_energy,
                       record.energy, record.lower_bound);
  }
  return csv;
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

double share_of_start(const TileRecord& record) {
  return record.start_energy > 0
             ? static_cast<double>(record.energy) / static_cast<double>(record.start_energy)
             : std::nan("");
}

/// The section while it is put together.
struct Draft {
  Section section;
  std::string gallery, dithers, main_plot, plots;

  std::string add_plot(Plot plot, std::string_view title, const std::string& caption) {
    section.plots.push_back(std::move(plot));
    return plot_figure(section.plots.back(), section.plots.size() - 1, title, caption);
  }
};

/// Which of a stack's tiles it is, as a sentence.
std::string frame_words(const RetargetSet& set, const RetargetSet::Tile& tile) {
  if (set.slices == 1) return {};
  return fmt::format("From slice {} to {}, the frame of most energy. ", tile.slice,
                     (tile.slice + 1) % set.slices);
}

std::string spectrum_figure(const PowerSpectrum& power, std::string title, std::string caption) {
  const Image picture = spectrum_image(power, kSpectrumShown);
  return figure({.image = picture,
                 .scale = scale_for(picture.size.width, 256),
                 .title = std::move(title),
                 .caption = std::move(caption)});
}

/// The moves as hues, their legend, how long they are.
void add_moves(const RetargetSet& set, const RetargetSet::Tile& tile, const std::string& file_name,
               Draft& draft) {
  const int radius = *set.metadata.facts.get<int>("radius");
  double mean_length = 0.0;
  for (const Offset r : tile.move) {
    mean_length += std::hypot(r.x - tile.record.motion.x, r.y - tile.record.motion.y);
  }
  mean_length /= static_cast<double>(tile.move.count());
  draft.gallery +=
      figure({.image = moves_image(tile.move, tile.record.motion, radius),
              .scale = scale_for(tile.move.width(), 256),
              .title = "The moves.",
              .caption = fmt::format("{}Direction as hue, length as strength; on average {} pixels.",
                                     frame_words(set, tile), number(mean_length))});
  draft.gallery +=
      figure({.image = moves_legend(160),
              .scale = 1,
              .title = "Their legend.",
              .caption = fmt::format("A move to the right is pink, down blue, left green, up yellow; "
                                     "grey stays. The rim is {} pixels.",
                                     radius)});
  draft.plots += draft.add_plot(
      moves_plot(set, tile, file_name + "-moves"), "Lengths of the moves",
      fmt::format("Share of the pixels, by {} length, motion taken out.",
                  set.metadata.facts.get<std::string>("reach") == "euclidean" ? "Euclidean" : "Chebyshev"));
}

/// What a retarget gets wrong, and its spectrum.
void add_residual(const RetargetSet& set, const RetargetSet::Tile& tile, const std::string& file_name,
                  const Execution& execution, Draft& draft) {
  const Grid<double> residual = residual_of(set, tile);
  double largest = 0.0, sum = 0.0;
  for (const double v : residual) {
    largest = std::max(largest, std::abs(v));
    sum += std::abs(v);
  }
  draft.gallery +=
      figure({.image = signed_image(residual, largest),
              .scale = scale_for(residual.width(), 256),
              .title = "The residual.",
              .caption = fmt::format(
                  "Level left minus level reached: blue below, orange above; full colour is {}, the mean "
                  "size {} levels.",
                  number(largest), number(sum / static_cast<double>(residual.count())))});
  const std::vector<double> values(residual.begin(), residual.end());
  const PowerSpectrum power = power_spectrum(values, residual.shape(), execution);
  draft.gallery +=
      spectrum_figure(power, "Its spectrum.", "Decibels, black −50, white +12.5, white noise 0.");
  const RadialCurve curve = radial_power(power);
  Plot plot{PlotStyle::residual, file_name + "-residual", "frequency_cycles_per_pixel", "power", {}};
  plot.curves.push_back({"white noise", Role::white, 0, {0.0, 0.7071}, {1.0, 1.0}});
  plot.curves.push_back({"residual", Role::texture, 0, curve.frequency, curve.power});
  draft.plots += draft.add_plot(std::move(plot), "Power of the residual",
                                fmt::format("What a retarget gets wrong; {} in 0 &lt; <i>f</i> ≤ 0.0625.",
                                            number(band_power(power).mean[0])));
}

/// Energies of a stack, frame by frame, against the proven optimum.
void add_frames(const RetargetSet& set, const RetargetSet::Tile& tile, const std::string& file_name,
                Draft& draft) {
  Plot plot{PlotStyle::energies, file_name + "-frames", "slice", "energy", {}};
  Curve bound{"proven lower bound", Role::reference, 0, {}, {}}, energy{"energy", Role::texture, 0, {}, {}};
  for (const RetargetSet::Tile* one : tiles_of(set, tile.record.motion)) {
    for (Curve* curve : {&bound, &energy}) curve->x.push_back(one->slice);
    bound.y.push_back(static_cast<double>(one->record.lower_bound));
    energy.y.push_back(static_cast<double>(one->record.energy));
  }
  const bool optimal = bound.y == energy.y;
  if (!optimal) plot.curves.push_back(std::move(bound));
  plot.curves.push_back(std::move(energy));
  draft.plots += draft.add_plot(std::move(plot), "Energy by frame",
                                fmt::format("From each slice to the next one, the last to the first{}.",
                                            optimal ? "; each is the proven optimum" : ""));
}

/// What is left of the dither after retargets in a row.
void add_dithers(const RetargetSet& set, const RetargetSet::Tile& tile, const Reference& reference,
                 const std::string& file_name, const Execution& execution, Draft& draft) {
  Plot plot = power_plot(file_name + "-dither", reference);
  const auto screens = repeated(set, tile.record.motion);
  for (std::size_t i = 0; i < screens.size(); ++i) {
    const PowerSpectrum power = analyse(screens[i], tile.move.shape(), 0.0, 1.0, execution).power;
    const RadialCurve curve = radial_power(power);
    const int repeats = i == 0 ? 0 : kRepeats[i - 1];
    const std::string lowest = number(band_power(power).mean[0]);
    plot.curves.push_back({i == 0 ? "the mask" : fmt::format("after {}", repeats), Role::texture,
                           static_cast<int>(i), curve.frequency, curve.power});
    draft.dithers +=
        spectrum_figure(power, i == 0 ? "The dither." : fmt::format("After {}.", repeats),
                        i == 0 ? fmt::format("Its spectrum before any retarget; lowest band {}.", lowest)
                               : fmt::format("Its spectrum {} retarget{} later; lowest band {}.", repeats,
                                             repeats == 1 ? "" : "s", lowest));
  }
  draft.main_plot = draft.add_plot(std::move(plot), "The dither after retargets in a row",
                                   "Radial power, without a new sort in between.");
}

std::string facts_table(const RetargetSet& set, const RetargetSet::Tile& tile, const Audit& checked) {
  const Metadata& metadata = set.metadata;
  const TileRecord& record = tile.record;
  const auto count = static_cast<int>(set.tiles.size());
  const double gap = record.lower_bound > 0 ? static_cast<double>(record.energy - record.lower_bound) /
                                                  static_cast<double>(record.lower_bound)
                                            : 0.0;
  const double share = share_of_start(record);
  const auto of_all = [&](int part) { return fmt::format("{} of {} {}", part, count, badge(part == count)); };
  std::string facts;
  facts +=
      fact("mask", set.mask_name.empty() ? escaped(metadata.facts.get<std::string>("source").value_or("–"))
                                         : escaped(set.mask_name));
  if (const auto to = metadata.facts.get<std::string>("to")) facts += fact("next frame's mask", escaped(*to));
  const Offset step = *metadata.facts.get<Offset>("step");
  if (set.slices > 1 || set.to) {
    facts += fact("step", fmt::format("({}, {}), and each frame has a mask of its own", step.x, step.y));
  } else {
    facts += fact("step, orbit",
                  fmt::format("({}, {}), {} frames", step.x, step.y, orbit_length(tile.move.size(), step)));
  }
  facts += fact("radius, reach, metric, border",
                fmt::format("{} px, {}, {}, {}", *metadata.facts.get<int>("radius"),
                            escaped(metadata.facts.get<std::string>("reach").value_or("chebyshev")),
                            escaped(metadata.facts.get<std::string>("metric").value_or("l1")),
                            metadata.facts.get<bool>("wrap").value_or(true) ? "wraps" : "closed"));
  facts += fact("energy of the tile shown",
                fmt::format("{} ({} of the {} without moves)", whole(record.energy),
                            std::isnan(share) ? "–" : percent(share), whole(record.start_energy)));
  facts += fact("proven lower bound", fmt::format("{} (gap {})", whole(record.lower_bound), percent(gap)));
  if (set.slices > 1) {
    const auto frames = tiles_of(set, record.motion);
    const auto least = *std::min_element(frames.begin(), frames.end(), [](const auto* a, const auto* b) {
      return a->record.energy < b->record.energy;
    });
    facts += fact("energy by frame", fmt::format("{} (from slice {}) … {} (from slice {}), over {} frames",
                                                 whole(least->record.energy), least->slice,
                                                 whole(record.energy), tile.slice, std::ssize(frames)));
  }
  facts += fact("proven optimal", fmt::format("{} of {}", checked.optimal, count));
  facts += fact("permutations within reach", of_all(checked.permutations));
  facts += fact("energies as recorded",
                checked.recomputed ? of_all(checked.energies) : "not recomputed: " + checked.why_not);
  if (set.seconds) facts += fact("time of the job", number(*set.seconds) + " s");
  if (!checked.fault.empty()) facts += fact("fault", escaped(checked.fault));
  return fmt::format(
      "<div class=\"wide\"><table class=\"facts\"><caption><b>Figures.</b> Everything but the bounds and the "
      "time is "
      "recomputed.</caption><tbody>{}</tbody></table></div>\n",
      facts);
}

std::vector<Cell> overview_of(const RetargetSet& set, const TileRecord& record, const std::string& verdict,
                              bool sound) {
  const double share = share_of_start(record), none = 1e300;
  const Extent size = set.tiles.front().move.size();
  return {{verdict, sound ? record.energy == record.lower_bound ? 0.0 : 1.0 : 2.0},
          {whole(record.energy), static_cast<double>(record.energy)},
          {std::isnan(share) ? "–" : percent(share), std::isnan(share) ? none : share},
          {whole(record.lower_bound), static_cast<double>(record.lower_bound)},
          {whole(std::ssize(set.tiles)), static_cast<double>(set.tiles.size())},
          {set.seconds ? number(*set.seconds) : "–", set.seconds.value_or(none)},
          {fmt::format("{} × {}", size.width, size.height), static_cast<double>(size.area())}};
}

}  // namespace

Section retarget_section(const RetargetSet& set, const Reference& reference, const std::string& file_name,
                         const Execution& execution) {
  const RetargetSet::Tile& tile = main_tile(set);
  const Audit checked = audit(set);
  const auto count = static_cast<int>(set.tiles.size());
  const Extent size = tile.move.size();
  const bool sound = checked.permutations == count && (!checked.recomputed || checked.energies == count);
  const std::string verdict = !sound                     ? badge(false, "not as recorded")
                              : checked.optimal == count ? badge(true, "proven optimal")
                                                         : badge(true, "as recorded");
  Draft draft;
  add_moves(set, tile, file_name, draft);
  if (set.slices > 1) add_frames(set, tile, file_name, draft);
  if (set.levels) {
    add_residual(set, tile, file_name, execution, draft);
    add_dithers(set, tile, reference, file_name, execution, draft);
  }

  Section& section = draft.section;
  section.group = Group::retarget_set;
  section.failed = !sound;
  std::string& html = section.html;
  html += fmt::format("<h2>{} {}</h2>\n", escaped(set.name), verdict);
  std::string files;
  for (const std::string& name : set.files) files += (files.empty() ? "" : ", ") + escaped(name);
  html += fmt::format("<p class=\"about\">{} tile{} of {} × {} pixels{}, {}{}.</p>\n", count,
                      count == 1 ? "" : "s", size.width, size.height,
                      set.slices > 1 ? fmt::format(", {} slices", set.slices) : "", files,
                      set.seconds ? fmt::format(", made in {} s", number(*set.seconds)) : "");
  html += "<div class=\"gallery\">" + draft.gallery + "</div>\n";
  if (!draft.dithers.empty()) html += "<div class=\"gallery\">" + draft.dithers + "</div>\n";
  html +=
      fmt::format("<div class=\"top\">{}<div>{}</div></div>\n<div class=\"plots\">{}{}</div>\n",
                  facts_table(set, tile, checked), draft.main_plot, heat_map(set, tile.slice), draft.plots);
  if (!set.metadata.recipe.empty()) {
    html += fmt::format("<details><summary>Recipe</summary><pre>{}</pre></details>\n",
                        escaped(set.metadata.recipe));
  }
  section.tables.emplace_back(file_name + "-energies", energies_csv(set));
  section.overview = overview_of(set, tile.record, verdict, sound);
  return section;
}

}  // namespace bn::report
