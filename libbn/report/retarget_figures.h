// What is recomputed of a retarget set: permutations, energies, residuals, the dither after many retargets.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "bn/retarget.h"
#include "report/sources.h"

namespace bn::report {

/// Retargets in a row, after each of which the dither is looked at.
inline constexpr std::array<int, 3> kRepeats{1, 8, 64};

RetargetOptions options_of(const Metadata& metadata, Offset motion);

/// The tile shown: of no motion if there is one, of a stack the one with the most energy.
const RetargetSet::Tile& main_tile(const RetargetSet& set);

/// The tiles of one motion by their slices.
std::vector<const RetargetSet::Tile*> tiles_of(const RetargetSet& set, Offset motion);

/// What recomputing every tile says.
struct Audit {
  int permutations = 0;  ///< bijections within reach
  int energies = 0;      ///< that are as recorded
  int optimal = 0;       ///< energy == bound
  bool recomputed = false;
  std::string why_not;  ///< where energies are not recomputed
  std::string fault;
};
Audit audit(const RetargetSet& set);

/// D(u) - T(u + R(u) + d): by how much a seed's new place differs from its old one. The set has levels.
Grid<double> residual_of(const RetargetSet& set, const RetargetSet::Tile& tile);

/// The dither on the screen at the start and after each of kRepeats frames, by the tiles of one motion: in
/// frame 0 every seed sits on its level D(p); frame t moves the seed at p by R(p + t d), of a stack's tile
/// t. Of a set between two masks after one frame only. The set has levels.
std::vector<std::vector<double>> repeated(const RetargetSet& set, Offset motion);

}  // namespace bn::report
