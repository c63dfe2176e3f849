// Composition: one section for each retarget set, and for each mask that no set uses.
//
//   name and figures
//   [ mask D        ] [ |D(u) - D(u+d)|  ] [ |D(u) - D(u+R+d)| ]  [              ]
//   [ R as hues     ] [ R as arrows      ] [ energy of motions ]  [    atlas     ]
//
// Textures are enlarged by whole numbers, nearest pixel; one too large for its panel shows its upper
// left corner (a tile) or every k-th pixel (an atlas), and the caption says so.

#include "bake/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bake/canvas.h"
#include "bake/inputs.h"
#include "bake/kinds/retarget_source.h"
#include "bake/label_font.h"

namespace bn::baking {
namespace {

constexpr int kMargin = 56, kGap = 40;
constexpr int kPanel = 256;
constexpr int kCaption = 64;                   // below a panel: two lines and air
constexpr int kAtlas = 2 * kPanel + kCaption;  // spans both rows
constexpr int kHeader = 84;                    // above the panels of a section
constexpr int kBetween = 40;                   // between sections
constexpr int kWidth = 2 * kMargin + 3 * (kPanel + kGap) + kAtlas;
constexpr int kBothRows = kHeader + 2 * (kPanel + kCaption), kOneRow = kHeader + kPanel + kCaption;
constexpr int kMaxSections = 32;

constexpr Colour kBackground{22, 24, 28}, kEmpty{30, 33, 38};
constexpr Colour kTitle{245, 245, 240}, kText{214, 217, 222}, kFaint{139, 146, 156}, kRule{52, 56, 63};

constexpr int kResidualGain = 16;  // what is left after retargeting is too dark to see otherwise

using Levels32 = Grid<std::int32_t>;

/// What is known of a set, read back from its files.
struct SetView {
  const JobRecord* job;
  const RetargetEntry* entry;
  Levels levels;
  std::string source;                 ///< what it is made of
  std::optional<Grid<Offset>> tile;   ///< R_0, scatter
  std::optional<Grid<Offset>> atlas;  ///< all motions as stored
};

Colour grey(double share) {
  const auto value = static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
  return {value, value, value};
}

std::string energy_text(std::int64_t energy, double pixels) {
  return fmt::format("E {}, mean {:.2f}", energy, static_cast<double>(energy) / pixels);
}

template <class Map>
Grid<Colour> coloured(Extent size, Map map) {
  Grid<Colour> result(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) result(x, y) = map(x, y);
  }
  return result;
}

Grid<Colour> cropped(const Grid<Colour>& picture, int side) {
  const Extent size{std::min(picture.width(), side), std::min(picture.height(), side)};
  return coloured(size, [&](int x, int y) { return picture(x, y); });
}

class Sheet {
 public:
  explicit Sheet(int height) : canvas_({kWidth, height}, kBackground) {}

  Image image() const { return canvas_.image(); }

  void set(const SetView& view) {
    const Levels32& levels = view.levels.value;
    const Extent size = levels.size();
    const RetargetEntry& entry = *view.entry;
    const Offset step = view.job->facts.get<Offset>("step").value_or(Offset{});
    const std::int64_t optimal = std::count_if(view.job->tiles.begin(), view.job->tiles.end(),
                                               [](auto& tile) { return tile.energy == tile.lower_bound; });
    const std::size_t motions = view.job->tiles.size();
    header(
        entry.name,
        fmt::format(
            "{} x {}   step ({}, {}), repeats after {} frames   radius {} {}, {}{}   {} motion{}, {} proven "
            "optimal",
            size.width, size.height, step.x, step.y,
            view.job->facts.get<std::int64_t>("orbit_length").value_or(0), entry.problem.radius,
            name_of(entry.problem.reach), name_of(entry.problem.metric),
            entry.problem.wrap ? "" : ", no wrap", motions, motions == 1 ? "" : "s",
            optimal == static_cast<std::int64_t>(motions) ? "all" : fmt::format("{}", optimal)));
    const TileRecord plain = view.job->tiles.at(motion_index({0, 0}, entry.motion));
    const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
    const double span = std::max<double>(*high - *low, 1.0), pixels = static_cast<double>(levels.count());

    panel(0, 0, "source D", view.source,
          coloured(size, [&](int x, int y) { return grey((levels(x, y) - *low) / span); }));
    panel(1, 0, "|D(u)-D(u+d)|", energy_text(plain.start_energy, pixels),
          residual(levels, Grid<Offset>(size), step, 1.0 / span));
    if (view.tile) {
      panel(2, 0, fmt::format("|D(u)-D(u+R+d)| x{}", kResidualGain), energy_text(plain.energy, pixels),
            residual(levels, *view.tile, step, kResidualGain / span));
      const double longest = entry.problem.radius;
      panel(0, 1, "R, hue = direction", fmt::format("lower bound {}", plain.lower_bound),
            coloured(size, [&](int x, int y) { return move_colour((*view.tile)(x, y), longest); }));
      hue_key(kMargin + kPanel - 32, row_top(1) + kPanel + 16);
      arrows(*view.tile, longest);
    }
    if (entry.motion > 0) heat_map(view);
    if (view.atlas) atlas(*view.atlas, entry);
    top_ += kBothRows;
    rule();
  }

  void mask(const MaskEntry& entry, const Levels& source) {
    const Levels32& levels = source.value;
    const Extent size = levels.size();
    header(entry.name, fmt::format("{} x {}   void-and-cluster, sigma {}, seed {}", size.width, size.height,
                                   entry.void_and_cluster.sigma_px, entry.void_and_cluster.seed));
    const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
    const double span = std::max<double>(*high - *low, 1.0);
    panel(0, 0, "mask", fmt::format("{} levels", source.distinct),
          coloured(size, [&](int x, int y) { return grey((levels(x, y) - *low) / span); }));
    int column = 1;
    for (const int part : {2, 8}) {
      panel(column++, 0, fmt::format("below 1/{}", part), "", coloured(size, [&](int x, int y) {
              return grey((levels(x, y) - *low) / span * part < 1.0 ? 1.0 : 0.06);
            }));
    }
    top_ += kOneRow;
    rule();
  }

  void left_out(int sections) {
    canvas_.text(kMargin, top_, fmt::format("and {} more", sections), 2, kFaint);
  }

 private:
  static int column_left(int column) { return kMargin + column * (kPanel + kGap); }
  int row_top(int row) const { return top_ + kHeader + row * (kPanel + kCaption); }

  void header(const std::string& name, const std::string& figures) {
    canvas_.text(kMargin, top_, name, 4, kTitle);
    canvas_.text(kMargin, top_ + 50, figures, 2, kFaint);
  }

  void rule() {
    if (top_ + kBetween < canvas_.size().height)
      canvas_.fill(kMargin, top_, {kWidth - 2 * kMargin, 1}, kRule);
    top_ += kBetween;
  }

  /// `text` at the largest scale (2 or 1) at which it fits the width.
  void fitted_text(int x, int y, const std::string& text, int width, Colour colour) {
    const int scale = 2 * text_width(text) <= width ? 2 : 1;
    canvas_.text(x, y + (scale == 1 ? 5 : 0), text, scale, colour);
  }

  void caption(int left, int top, const std::string& label, const std::string& figures, int width = kPanel) {
    fitted_text(left, top + 10, label, width, kText);
    fitted_text(left, top + 33, figures, width, kFaint);
  }

  void panel(int column, int row, const std::string& label, const std::string& figures,
             const Grid<Colour>& picture) {
    const int left = column_left(column), top = row_top(row);
    const Grid<Colour> part = cropped(picture, kPanel);
    const int scale = kPanel / std::max(part.width(), part.height());
    canvas_.fill(left, top, {kPanel, kPanel}, kEmpty);
    canvas_.picture(left + (kPanel - part.width() * scale) / 2, top + (kPanel - part.height() * scale) / 2,
                    part, scale);
    caption(left, top + kPanel, label,
            part.size() == picture.size() ? figures : figures + ", upper left corner");
  }

  static Grid<Colour> residual(const Levels32& levels, const Grid<Offset>& move, Offset step, double gain) {
    return coloured(levels.size(), [&](int x, int y) {
      const Offset r = move(x, y);
      const std::int32_t there = levels.torus(std::int64_t{x} + r.x + step.x, std::int64_t{y} + r.y + step.y);
      return scale_colour(std::abs(levels(x, y) - there) * gain);
    });
  }

  /// A disc of all directions, to read the hues by.
  void hue_key(int left, int top) {
    constexpr int kRadius = 15;
    for (int y = -kRadius; y <= kRadius; ++y) {
      for (int x = -kRadius; x <= kRadius; ++x) {
        if (x * x + y * y > kRadius * kRadius) continue;
        canvas_.fill(left + kRadius + x, top + kRadius + y, {1, 1}, move_colour({x, y}, kRadius));
      }
    }
  }

  void arrows(const Grid<Offset>& tile, double longest) {
    const int left = column_left(1), top = row_top(1);
    const int cells = std::min({16, tile.width(), tile.height()}), cell = kPanel / cells;
    const int inset = (kPanel - cells * cell) / 2;
    canvas_.fill(left, top, {kPanel, kPanel}, kEmpty);
    for (int y = 0; y < cells; ++y) {
      for (int x = 0; x < cells; ++x) {
        const Offset r = tile(x, y);
        const double cx = left + inset + (x + 0.5) * cell, cy = top + inset + (y + 0.5) * cell;
        const double reach = 0.45 * cell / longest;
        canvas_.arrow(cx - r.x * reach, cy - r.y * reach, cx + r.x * reach, cy + r.y * reach,
                      move_colour(r, longest));
      }
    }
    caption(left, top + kPanel, "R as arrows", fmt::format("{} x {}, upper left", cells, cells));
  }

  void heat_map(const SetView& view) {
    const int left = column_left(2), top = row_top(1), range = view.entry->motion, side = 2 * range + 1;
    const auto& tiles = view.job->tiles;
    const auto [low, high] =
        std::minmax_element(tiles.begin(), tiles.end(), [](auto& a, auto& b) { return a.energy < b.energy; });
    const double span = std::max<double>(static_cast<double>(high->energy - low->energy), 1.0);
    const int cell = kPanel / side, inset = (kPanel - cell * side) / 2;
    canvas_.fill(left, top, {kPanel, kPanel}, kEmpty);
    for (const TileRecord& tile : tiles) {
      const double share = static_cast<double>(tile.energy - low->energy) / span;
      const int x = left + inset + (tile.motion.x + range) * cell,
                y = top + inset + (tile.motion.y + range) * cell;
      canvas_.fill(x, y, {cell - 1, cell - 1}, scale_colour(share));
      const double percent = 100.0 * static_cast<double>(tile.energy) /
                             static_cast<double>(std::max<std::int64_t>(tile.start_energy, 1));
      const std::string label = fmt::format("{:.2f}", percent);
      if (text_width(label) + 2 > cell) continue;
      canvas_.text(x + (cell - 1 - text_width(label)) / 2, y + (cell - 7) / 2, label, 1,
                   share > 0.6 ? kBackground : kTitle);
    }
    caption(left, top + kPanel, "% of start, by motion", fmt::format("E {}..{}", low->energy, high->energy));
  }

  void atlas(const Grid<Offset>& moves, const RetargetEntry& entry) {
    const int left = column_left(3), top = row_top(0);
    const int longest_side = std::max(moves.width(), moves.height());
    const int every = (longest_side + kAtlas - 1) / kAtlas, scale = std::max(1, kAtlas / longest_side);
    // Scaled so that the motions, not the moves about them, span the colours.
    const double longest = entry.motion + 0.5 * entry.problem.radius;
    const auto picture =
        coloured(moves.size(), [&](int x, int y) { return move_colour(moves(x, y), longest); });
    canvas_.fill(left, top, {kAtlas, kAtlas}, kEmpty);
    const int shown_width = (moves.width() + every - 1) / every * scale,
              shown_height = (moves.height() + every - 1) / every * scale;
    canvas_.picture(left + (kAtlas - shown_width) / 2, top + (kAtlas - shown_height) / 2, picture, scale,
                    every);
    const int side = 2 * entry.motion + 1;
    caption(left, top + kAtlas,
            fmt::format("atlas: motions -{} to {} in x and y", entry.motion, entry.motion),
            fmt::format("{} x {} tiles, {} x {} pixels{}", side, side, moves.width(), moves.height(),
                        every == 1 ? ""
                                   : fmt::format(", every {}{} shown", every,
                                                 every == 2   ? "nd"
                                                 : every == 3 ? "rd"
                                                              : "th")),
            kAtlas);
  }

  Canvas canvas_;
  int top_ = kMargin;
};

/// Reads what the sheet shows of a set from its own files.
SetView view_of(const Recipe& recipe, const RetargetEntry& entry, const JobRecord& job,
                const std::filesystem::path& out_dir, const Execution& execution) {
  const std::filesystem::path source = input_paths(recipe, entry, out_dir).front();
  SetView view{.job = &job,
               .entry = &entry,
               .levels = source_of(read_input(source, execution), channels_of(entry)).levels[0],
               .source = "",
               .tile = std::nullopt,
               .atlas = std::nullopt};
  const auto mask = std::dynamic_pointer_cast<const MaskEntry>(find_entry(recipe, "mask", entry.mask));
  view.source =
      mask ? fmt::format("sigma {}, seed {}", mask->void_and_cluster.sigma_px, mask->void_and_cluster.seed)
           : fmt::format("{} levels", view.levels.distinct);
  const Extent size = view.levels.value.size();
  for (const RetargetOutput& output : entry.outputs) {
    const bool is_tile = output.kind == RetargetOutput::Kind::tile;
    const bool shows_plain_tile = !view.tile && (!is_tile || output.motion == Offset{});
    const bool shows_atlas = !view.atlas && !is_tile && entry.motion > 0;
    if (!shows_plain_tile && !shows_atlas) continue;
    const Image image = read_image(out_dir / output.path, execution).image;
    if (shows_plain_tile) {
      const int index = is_tile ? 0 : static_cast<int>(motion_index({0, 0}, entry.motion));
      const Grid<Offset> stored = decode_moves(atlas_tile(image, size, index));
      view.tile = output.form == MoveForm::scatter ? stored : invert_moves(stored);
    }
    if (shows_atlas) view.atlas = decode_moves(image);
  }
  return view;
}

}  // namespace

Metadata contact_sheet_metadata() {
  Metadata metadata;
  metadata.algorithm = kContactSheetKind;
  metadata.algorithm_version = kContactSheetVersion;
  metadata.kind = kContactSheetKind;
  return metadata;
}

Image draw_contact_sheet(const Recipe& recipe, const std::filesystem::path& out_dir,
                         const std::vector<JobRecord>& jobs, const Execution& execution) {
  std::vector<const RetargetEntry*> sets;
  std::vector<const MaskEntry*> lone_masks;
  for (const auto& entry : recipe.entries) {
    if (const auto* set = dynamic_cast<const RetargetEntry*>(entry.get())) sets.push_back(set);
  }
  for (const auto& entry : recipe.entries) {
    const auto* mask = dynamic_cast<const MaskEntry*>(entry.get());
    const bool used =
        mask && std::any_of(sets.begin(), sets.end(), [&](auto* set) { return set->mask == mask->name; });
    if (mask && !used) lone_masks.push_back(mask);
  }
  const int wanted = static_cast<int>(sets.size() + lone_masks.size());
  const int shown = std::min(wanted, kMaxSections);
  const int shown_sets = std::min(static_cast<int>(sets.size()), shown), masks = shown - shown_sets;

  Sheet sheet(kMargin + shown_sets * (kBothRows + kBetween) + masks * (kOneRow + kBetween) +
              (wanted > shown ? kMargin : 0));
  for (int i = 0; i < shown_sets; ++i) {
    throw_if_stopped(execution);
    const RetargetEntry& set = *sets[static_cast<std::size_t>(i)];
    const auto job = std::find_if(jobs.begin(), jobs.end(), [&](auto& made) {
      return made.kind == "retarget" && made.name == set.name;
    });
    if (job != jobs.end()) sheet.set(view_of(recipe, set, *job, out_dir, execution));
  }
  for (int i = 0; i < masks; ++i) {
    throw_if_stopped(execution);
    const MaskEntry& mask = *lone_masks[static_cast<std::size_t>(i)];
    sheet.mask(mask, source_of(read_input(out_dir / mask.path_of(0), execution), {0}).levels[0]);
  }
  if (wanted > shown) sheet.left_out(wanted - shown);
  return sheet.image();
}

}  // namespace bn::baking
