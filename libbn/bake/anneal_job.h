// Annealed retarget sets: what an entry and its source ask of bn/anneal.h, and what stands in files.

#pragma once

#include <vector>

#include "bake/job.h"

namespace bn {

/// What the entry's tiles minimise; the motion is (0, 0).
AnnealProblem anneal_problem(const RetargetEntry& entry, const Source& source);

/// What an entry's tiles have little of, annealed or not, recomputed; `options` say which motion.
std::int64_t energy_of(const RetargetEntry& entry, const Source& source, const Grid<Offset>& move,
                       const RetargetOptions& options);

/// For each motion of range `motion`, what no permutation's energy is below: of a sum over channels the sum
/// of the channels' bounds, each within `gap` of its optimum; of a filtered residual 0.
std::vector<std::int64_t> anneal_bounds(const AnnealProblem& problem, int motion, double gap,
                                        const Execution& execution);

/// Every motion of the entry, row by row, with bounds. Goes on from the entry's checkpoint if there is one;
/// the caller removes it once the files stand.
std::vector<RetargetTile> anneal_tiles(const RetargetEntry& entry, const Source& source,
                                       const Execution& execution);

/// The entry with a budget by the clock turned into proposals: those of its checkpoint if there is one, else
/// those that a trial run finds.
RetargetEntry with_budget_found(const RetargetEntry& entry, const Source& source, const Execution& execution);

}  // namespace bn
