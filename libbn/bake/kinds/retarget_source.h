// The image that retarget tiles are made for, and what an entry minimises on it.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bn/kinds.h"

namespace bn::baking {

struct Source {
  std::string hash;
  int channel = 0;              ///< the first one
  bool is_mask = false;         ///< its metadata say that this toolkit made it as a mask
  std::vector<Levels> levels;   ///< of each channel; the exact solver reads the first
  std::string to_hash = {};     ///< of the next frame's mask, where it is another
  std::vector<Levels> to = {};  ///< its levels, likewise; else empty

  const Grid<std::int32_t>& first() const { return levels.front().value; }
  Extent size() const { return first().size(); }
  int depth() const { return first().depth(); }
  /// Whether the next frame's mask is this one, moved by the step.
  bool moves() const { return to.empty() && depth() == 1; }
};

/// The channels that an entry's energy is of.
std::vector<int> channels_of(const RetargetEntry& entry);
/// The source, and the next frame's mask if there is a second input. Errors: invalid_input, naming the file
/// (no such channel, NaN, two masks of different shapes).
Source source_of(const std::vector<Input>& inputs, const std::vector<int>& channels);

/// The levels that seeds leave and land on in one frame.
struct FrameMasks {
  Grid<std::int32_t> from, to;
  operator MaskLevels() const { return {from, to}; }
};
/// Of slice z, whose next frame is the same slice of another mask; or the next slice, after the last the
/// first; or the picture itself, moved. `channel` counts the entry's.
FrameMasks frame_masks(const Source& source, int z, std::size_t channel = 0);

/// The entry's dither step, `auto` resolved: between two masks nothing has to move.
Offset step_of(const RetargetEntry& entry, const Source& source);

/// What a user should know of this source under these options: a constant image, no permutation ...
std::vector<std::string> source_notes(const Source& source, const RetargetOptions& options);

/// The largest motion range of a tile whose variants all differ on its torus.
int largest_motion(Extent size);
/// Number of the motion (x, y) among those of range `range`, row by row.
std::size_t motion_index(Offset motion, int range);

/// The problem that bn/retarget_anneal.h solves for the entry: of the whole volume, or of slice 0.
AnnealProblem anneal_problem(const RetargetEntry& entry, const Source& source);

/// A tile, or what a volume's seeds do.
struct MadeTile {
  RetargetTile tile;
  Grid<std::int8_t> move_z = {};  ///< of a volume; else empty
};
/// The energy that the entry minimises, recomputed for any moves of slice z (of a volume: 0).
std::int64_t energy_of(const RetargetEntry& entry, const Source& source, int z, const Grid<Offset>& move,
                       const Grid<std::int8_t>& move_z, const RetargetOptions& options);
/// As files hold the moves of slice z, in the form that the output asks for; and back.
Image encode_tile(const RetargetEntry& entry, std::size_t output, const MadeTile& tile, const Source& source);
MadeTile decode_tile(const RetargetEntry& entry, std::size_t output, const Image& image);
/// Proven lower bounds of every motion -motion..motion, row by row: of each channel by the exact solver, to
/// within `gap`; 0 for a residual.
std::vector<std::int64_t> anneal_bounds(const AnnealProblem& problem, int motion, double gap,
                                        const Execution& execution);
/// Anneals every motion; goes on from the entry's checkpoint file and keeps it.
std::vector<MadeTile> anneal_tiles(const RetargetEntry& entry, const Source& source,
                                   const Execution& execution);
/// Solves every slice and motion, slice by slice, each row by row.
std::vector<MadeTile> solve_tiles(const RetargetEntry& entry, const Source& source,
                                  const Execution& execution);
/// The entry with the budget that its seconds allow, from the checkpoint if there is one.
RetargetEntry with_budget_found(const RetargetEntry& entry, const Source& source, const Execution& execution);

}  // namespace bn::baking
