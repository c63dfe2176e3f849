// The parts of the page, each made by itself so that they can be made at once.

#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/plot.h"
#include "report/sources.h"

namespace bn::report {

/// A cell of a table that can be sorted.
struct Cell {
  std::string html;
  double order = 0.0;  ///< less comes first
};

/// What the sections of a page are; each group has a table of its own at the top.
enum class Group { texture, retarget_set, other };
/// Headings of the group's table, behind the name; HTML.
std::vector<std::string_view> overview_columns(Group group);

struct Section {
  Group group = Group::other;
  std::string html;  ///< holds plot_slot(i) where plots[i] belongs
  std::vector<Plot> plots;
  std::vector<std::pair<std::string, std::string>>
      tables;  ///< CSV that is no plot: file name without extension, text
  /// Its row in the table of its group at the top, under overview_columns().
  std::vector<Cell> overview;
  std::string card;         ///< for --compare: the pictures and the main figures
  double grade = 0.0;       ///< of a texture
  bool failed = false;      ///< misses a threshold
  bool weak = false;        ///< passes, far from the best known
  bool not_judged = false;  ///< a picture that is no mask
};

/// A mark that no text of a file can hold, since escaped() lets no control character pass.
std::string plot_slot(std::size_t index);

/// The place of a plot, with its key. `caption` is HTML.
std::string plot_figure(const Plot& plot, std::size_t index, std::string_view title,
                        std::string_view caption);

/// What good looks like: the averaged power of ten void-and-cluster masks of 128 x 128, sigma 1.9.
struct Reference {
  RadialCurve radial;
  std::vector<double> anisotropy_db;  ///< of one of them: the mean of s²/mean² over the masks, in dB
};
Reference make_reference(const Execution& execution);

/// Power and anisotropy of textures with white noise and the reference behind them.
Plot power_plot(std::string file_name, const Reference& reference);
Plot anisotropy_plot(std::string file_name, const Reference& reference);

/// `file_name`: what its CSV files begin with.
Section texture_section(const Texture& texture, const Reference& reference, const std::string& file_name,
                        const Execution& execution);
Section retarget_section(const RetargetSet& set, const Reference& reference, const std::string& file_name,
                         const Execution& execution);

}  // namespace bn::report
