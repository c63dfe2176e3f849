// bn/retarget.h - floor 2: the permutation that carries sorted seeds from one frame to the next.
//
// Source of the problem: E. Heitz and L. Belcour, "Distributing Monte Carlo errors as a blue noise
// in screen space by permuting pixel seeds between frames", Computer Graphics Forum 38(4), 2019.

#pragma once

#include <cstdint>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"

namespace bn {

/// Raised whenever the same problem would give other bytes than before. Written into every file.
inline constexpr int kExactRetargetVersion = 1;

/// Cost of a seed that sat on level a and lands on level b.
enum class Metric {
  l1,  ///< |a - b|
  l2,  ///< (a - b)^2
};

/// Which moves of at most `radius` are allowed.
enum class Reach {
  chebyshev,  ///< |x| <= radius and |y| <= radius
  euclidean,  ///< x^2 + y^2 <= radius^2
};

/// The grey levels that seeds are sorted by: in this frame those of `from`, in the next those of `to`.
/// With one grid both frames use the same mask, which the step moves. Both have one size, and each level is
/// 0..2^24-1, as the user's renderer reads them. Refers to the grids, which must outlive it.
struct MaskLevels {
  const Grid<std::int32_t>& from;
  const Grid<std::int32_t>& to;

  MaskLevels(const Grid<std::int32_t>& both) : from(both), to(both) {}  // NOLINT: implicit on purpose
  MaskLevels(const Grid<std::int32_t>& from_levels, const Grid<std::int32_t>& to_levels)
      : from(from_levels), to(to_levels) {}
  Extent size() const { return from.size(); }
};

/// The retarget problem for one motion. In tile space, with D the levels of this frame's mask, T those of
/// the next one's (T = D for one mask that moves), d the step, m the motion: find the bijection
/// u -> u + R(u) of the torus that minimises
///     E = sum over u of cost(D(u), T(u + R(u) + d))   with R(u) - m within reach.
/// R = m everywhere is the identity, whose energy is the start energy.
struct RetargetOptions {
  Offset step{0, 0};    ///< d, any integers (taken modulo the tile); (0, 0) makes the identity optimal
  Offset motion{0, 0};  ///< m, each -127..127 and |m| + radius <= 127, so that a move fits 8 bits
  int radius = 6;       ///< 1..32 pixels
  Reach reach = Reach::chebyshev;
  Metric metric = Metric::l1;
  /// false: no seed may cross the border of the tile it lands in: with q = u + d (taken modulo the tile),
  /// q + R(u) - m stays inside. For tiles used alone.
  bool wrap = true;
  /// Stop as soon as (energy - lower_bound) <= gap * lower_bound is proven. 0: prove the optimum.
  double gap = 0.0;
};

/// A retarget tile, in scatter form, with its proof.
struct RetargetTile {
  /// R(u): the seed at u moves to u + R(u). On a torus smaller than the reach several offsets name
  /// one pixel; the stored one is within reach, nearest to m, then lowest y, then lowest x.
  Grid<Offset> move;
  std::int64_t start_energy = 0;  ///< of the identity R = m
  std::int64_t energy = 0;        ///< of `move`
  std::int64_t lower_bound = 0;   ///< no permutation within reach has less; from a feasible dual
  bool optimal() const { return energy == lower_bound; }
};

/// The optimal retarget tile (or one within options.gap of it), with a proven lower bound.
/// Errors: invalid_input (an option outside its range, levels outside theirs, an empty grid, two sizes),
/// over_limit (memory, or energies that could exceed 2^62), cancelled.
/// Threads: one, the caller's. Same bytes on every machine and instruction set. Memory: at most 64 bytes for
/// each pixel of the tile and of a border of `radius` around it. Cost, one core: 64x64 3 ms, 512x512 1 s,
/// with its proof; docs/retarget.md has the table.
RetargetTile solve_retarget(const MaskLevels& levels, const RetargetOptions& options,
                            const Execution& execution = {});

/// One tile per motion in -range..range squared, row by row (index (m.y + range) * (2 range + 1) +
/// m.x + range), solved in parallel; options.motion is ignored. range 0..8; 4 gives the 81 variants.
/// Each equals solve_retarget()'s for its motion; errors as there. Threads: execution.threads; same bytes
/// for any number. Memory: a solve_retarget() on each thread, and 8 bytes a pixel for each tile.
std::vector<RetargetTile> solve_motion_set(const MaskLevels& levels, const RetargetOptions& options,
                                           int range, const Execution& execution = {});

/// The energy of any permutation under `options`, recomputed from its definition.
std::int64_t retarget_energy(const MaskLevels& levels, const Grid<Offset>& move,
                             const RetargetOptions& options);

/// Throws verification_failed, naming the first offending pixel, unless u -> u + move(u) is a
/// bijection of the torus and every move(u) - motion is within reach (and inside, without wrap).
void check_permutation(const Grid<Offset>& move, const RetargetOptions& options);

/// The gather form: the seed that arrives at u came from u + G(u). The inverse of the scatter form;
/// applying it twice gives the original back.
Grid<Offset> invert_moves(const Grid<Offset>& move);

/// A dither step and how many frames pass before its multiples repeat on the torus.
struct AutoStep {
  Offset step;
  std::int64_t orbit_length;
};

/// The step `auto` stands for: near (width/g, height/g^2), g = 1.32471795724474602596 the plastic
/// number, with the longest orbit; of equals the nearest, then lowest y, then lowest x.
AutoStep auto_step(Extent size);

/// How many frames t = 0, 1, ... visit different offsets t * step on the torus.
std::int64_t orbit_length(Extent size, Offset step);

}  // namespace bn
