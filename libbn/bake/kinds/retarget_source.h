// The image that retarget tiles are made for, and what an entry minimises on it.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bn/kinds.h"

namespace bn::baking {

struct Source {
  std::string hash;
  int channel = 0;             ///< the first one
  bool is_mask = false;        ///< its metadata say that this toolkit made it as a mask
  std::vector<Levels> levels;  ///< of each channel; the exact solver reads the first

  const Grid<std::int32_t>& first() const { return levels.front().value; }
  Extent size() const { return first().size(); }
};

/// The channels that an entry's energy is of.
std::vector<int> channels_of(const RetargetEntry& entry);
/// Errors: invalid_input, naming the file (no such channel, NaN).
Source source_of(const Input& input, const std::vector<int>& channels);

/// The entry's dither step, `auto` resolved.
Offset step_of(const RetargetEntry& entry, const Source& source);

/// What a user should know of this source under these options: a constant image, no permutation ...
std::vector<std::string> source_notes(const Source& source, const RetargetOptions& options);

/// The largest motion range of a tile whose variants all differ on its torus.
int largest_motion(Extent size);
/// Number of the motion (x, y) among those of range `range`, row by row.
std::size_t motion_index(Offset motion, int range);

/// The problem that bn/anneal.h solves for the entry.
AnnealProblem anneal_problem(const RetargetEntry& entry, const Source& source);
/// The energy that the entry minimises, recomputed for any tile.
std::int64_t energy_of(const RetargetEntry& entry, const Source& source, const Grid<Offset>& move,
                       const RetargetOptions& options);
/// Proven lower bounds of every motion -motion..motion, row by row: of each channel by the exact solver, to
/// within `gap`; 0 for a residual.
std::vector<std::int64_t> anneal_bounds(const AnnealProblem& problem, int motion, double gap,
                                        const Execution& execution);
/// Anneals every motion; goes on from the entry's checkpoint file and keeps it.
std::vector<RetargetTile> anneal_tiles(const RetargetEntry& entry, const Source& source,
                                       const Execution& execution);
/// The entry with the budget that its seconds allow, from the checkpoint if there is one.
RetargetEntry with_budget_found(const RetargetEntry& entry, const Source& source, const Execution& execution);

}  // namespace bn::baking
