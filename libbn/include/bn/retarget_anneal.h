// bn/retarget_anneal.h - floor 2 (retarget): retarget tiles by simulated annealing.
//
// The exact solver (bn/retarget.h) proves the optimum of one channel's L1 or L2 energy. Annealing handles
// energies it cannot: several channels at once, and residuals seen through a filter. On the energies that
// both handle, the exact optimum says how good annealing is; docs/annealing.md shows it.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bn/anneal.h"
#include "bn/execution.h"
#include "bn/grid.h"
#include "bn/retarget.h"

namespace bn {

// --- the problem -----------------------------------------------------------------------------------

/// One image channel that moves with the seeds.
struct AnnealChannel {
  Grid<std::int32_t> levels;  ///< D_c, each 0..2^24-1; all channels of one size
  int weight = 1;             ///< 1..1000, of this channel in the sum
  Grid<std::int32_t> to =
      {};  ///< T_c, the levels of the next frame's mask; empty: `levels`, which the step moves

  MaskLevels masks() const { return to.count() == 0 ? MaskLevels(levels) : MaskLevels(levels, to); }
};

/// What to minimise over the permutations that bn/retarget.h describes:
///     E = sum over channels c of weight_c * sum over u of cost(D_c(u), T_c(u + R(u) + d)),
/// or, with residual_sigma_px > 0, the energy of what is left of the difference after a blur,
///     E = sum over c of weight_c * sum over w of (sum over v of g(w - v) * e_c(v))^2,
/// e_c(w) the level that arrived at w less the level that belongs there, g a Gaussian with integer weights
/// (cut at 3 sigma; each axis sums to about 2^b, b <= 8 the largest for which energies stay below 2^62). No
/// assignment solver can handle that one: a seed's cost depends on where the others went.
struct AnnealProblem {
  std::vector<AnnealChannel> channels;  ///< 1..16
  RetargetOptions retarget;             ///< metric must be l2 for a residual; gap is not used
  double residual_sigma_px = 0.0;       ///< 0, or 0.3..8 pixels
  /// Above 1: a volume. Levels are a stack of so many slices of equal height, each below the one before; u,
  /// R, d and the torus have a third axis, z, counting slices; the radius holds on it too. 1..16384, divides
  /// the levels' height. Not with a residual. The motion moves slices in x and y alone.
  int depth = 1;
  int step_z = 0;  ///< d.z, any integer
};

/// The energy of any permutation, recomputed from its definition. Of a volume move_z is R.z, stacked as the
/// levels are; else it is empty. Errors: as anneal_retarget().
std::int64_t anneal_energy(const AnnealProblem& problem, const Grid<Offset>& move,
                           const Grid<std::int8_t>& move_z = {});

/// check_permutation() (bn/retarget.h) for flat tiles and for volumes.
void check_anneal_permutation(const AnnealProblem& problem, const Grid<Offset>& move,
                              const Grid<std::int8_t>& move_z = {});

// --- the run ---------------------------------------------------------------------------------------

struct AnnealResult {
  RetargetTile tile;           ///< the best placement seen; tile.lower_bound is 0: annealing proves nothing
  Grid<std::int8_t> move_z;    ///< of a volume: R.z, the third axis of tile.move; else empty
  std::int64_t proposals = 0;  ///< made, by all chains
  std::int64_t accepted = 0;
  double start_temperature = 0.0;
  double end_temperature = 0.0;
  bool frozen = false;  ///< the schedule ended the run before the budget did
};

/// Anneals from the identity R = m.
///
/// Energies that are sums over pixels run on vectors, a residual swap by swap. Same bytes for any number
/// of threads and any instruction set, with or without a trace, resumed or not.
///
/// With radius 1 whole rows moved by one cannot be reached by swaps; such permutations are never good ones.
/// Errors: invalid_input (an option outside its range, a checkpoint of another problem or damaged),
/// over_limit (memory; energies that could pass 2^62), cancelled. Threads: over chains and, in tiles of 128
/// rows and more, over bands of rows; execution.threads. Cost and quality: docs/annealing.md. Memory: about
/// 20 bytes a pixel and chain for 8 bit levels, 40 for wider ones.
AnnealResult anneal_retarget(const AnnealProblem& problem, const AnnealOptions& options,
                             const Execution& execution = {}, AnnealTrace* trace = nullptr);

/// anneal_retarget() in parts, for programs that watch and steer. Calls of advance() and sweep() in any
/// mixture until state().done make the bytes that anneal_retarget() makes in one go; advance() is as fast.
///
/// options.checkpoint.resume is honoured; `save` is not called. execution.progress is not called and
/// execution.stop is not looked at: to stop, simply do not call again. Threads: one caller at a time; no
/// locks inside. Errors: the constructor's are those of anneal_retarget(). `trace` must outlive the object.
class Annealing {
 public:
  Annealing(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution = {},
            AnnealTrace* trace = nullptr);
  ~Annealing();
  Annealing(const Annealing&) = delete;
  Annealing& operator=(const Annealing&) = delete;

  /// Goes on by one slice: a 512th of the budget, at most 1e8 proposals, which takes a tenth of a second at
  /// common speeds. Does nothing once the run is done.
  void advance();
  /// Goes on by one sweep, about half as many proposals as pixels, of each chain (some may wait for others).
  /// It is watched, so state() has its worsenings. Does nothing once the run is done.
  void sweep();

  AnnealState state() const;
  /// The bytes that Checkpointing::save gets. Throws invalid_input in the middle of a slice, after a sweep()
  /// that did not end one.
  std::string checkpoint() const;
  Grid<Offset> move() const;         ///< the placement of the traced chain, now; a pass over the pixels
  Grid<std::int8_t> move_z() const;  ///< its third axis, of a volume; else empty
  /// The best permutation found so far, looked for at the end of each round. Costs one pass over the pixels.
  /// A run of one chain whose stop_after is result().proposals ends with the same bytes. Before the end of
  /// the first round it is the identity.
  AnnealResult result() const;
  /// What the options came to: of the traced chain, over all proposals but the last 64th.
  CoolingSchedule schedule() const;

 private:
  struct Held;
  std::unique_ptr<Held> held_;
};

/// The variants of one motion set: index (m.y + range) * (2 range + 1) + m.x + range, range 0..8; the motion
/// of the argument is ignored. Every tile equals anneal_retarget() with that motion. A checkpoint is of the
/// whole set: a resumed set keeps the variants that were finished and goes on with the others where they
/// were. Threads: over variants.
std::vector<AnnealResult> anneal_motion_set(const AnnealProblem& problem, const AnnealOptions& options,
                                            int range, const Execution& execution = {});

/// The temperatures an automatic start and end stand for. For sums over pixels: start 6 c, end 0.9 c, with c
/// the mean over pixels of the least cost within reach, but at least a tenth of the least cost above 0 that
/// two levels of a channel have. They grow with the unit of the levels: an image of 8 bits has those of the
/// same image in 16, in its own unit. Where levels are few and c meets its bound the run is nearly greedy,
/// which is best there: plateaus are crossed for nothing. For a residual: a start that accepts a fifth of the
/// worsening swaps, and a 4000th of it as end.
TemperatureRange automatic_temperatures(const AnnealProblem& problem);

/// The proposals that `seconds` of wall time allow, by a trial run of at most a twentieth of them. A clock
/// decides, so record the number where bytes must come back.
std::int64_t proposals_for(double seconds, const AnnealProblem& problem, const AnnealOptions& options,
                           const Execution& execution = {});

}  // namespace bn
