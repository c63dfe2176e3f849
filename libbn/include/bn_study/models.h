// bn_study/models.h - floor 4 (study): the temporal algorithm without a renderer, for comparisons.
//
// Headers of bn_study are for the tools and tests of this repository. They are not installed and promise
// nothing about the next version.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bn/render.h"

namespace bn {

// --- the flat model ----------------------------------------------------------------------------

/// The algorithm alone, without a renderer: every pixel's value is sample(seed, 0)^2.
struct FlatModel {
  Extent screen{256, 256};  ///< any
  int block = 8;
  bool jitter = false;   ///< of the block grid
  bool retarget = true;  ///< with the plain tile
  int frames = 8;        ///< frames after the first
  std::uint64_t seed = 1;
};

/// For frame 0 (white noise) to `frames`, against white noise that is treated alike, in dB.
struct FlatRun {
  std::vector<double> power_db;             ///< of a frame's values at 0 < f <= 0.1 cycles per pixel
  std::vector<double> averaged_db;          ///< mean square error of the exponential average over frames, 0.1
  std::vector<double> averaged_blurred_db;  ///< and of that after a blur of 1.5 pixels
};
FlatRun run_flat_model(const FlatModel& model, const TemporalTextures& textures);

/// Masks on the flat picture: what they leave in a frame and in the average over frames.
struct StackRow {
  std::string masks;
  int radius = 6;         ///< of the tiles, all proven
  int block = 8;          ///< of the sort
  double energy = 0.0;    ///< of a tile, the mean
  double floor_db = 0.0;  ///< power_db of the masks' own levels, which sorting cannot get below
  std::vector<double> db, averaged_db, averaged_blurred_db;  ///< at `frames`, as in FlatRun
};
/// The mask of `moved`, a stack of masks that know nothing of each other, and the presets' stacks, at equal
/// radius and block: the mean of eight sets of seeds, side by side by execution.threads.
std::vector<StackRow> study_stacks(const TemporalTextures& moved, std::span<const int> frames,
                                   const Execution& execution = {});

/// A poster of three by two light and dark cells on a wall, under a pan, without a renderer: what edges and
/// motion do to the algorithm, with the true picture known exactly.
struct PosterModel {
  enum class Edge {
    colour,  ///< a seed's value is scaled by the reflectance
    surface  ///< and is another number of the seed on each side, as where other light arrives
  };
  Extent screen{256, 192};
  double pan_px = 0.0;  ///< to the right, pixels a frame
  Edge edge = Edge::colour;
  bool reproject = false;      ///< with the tile for the pan, rounded and clamped; else the plain one
  bool sort_by_light = false;  ///< without the reflectance
  int block = 8;
  int frames = 16;  ///< after the first
  std::uint64_t seed = 1;
};

struct PosterRun {
  /// Power of the error around the poster at 0 < f <= 0.1 cycles per pixel against white noise, dB, by frame.
  std::vector<double> power_db;
  double crossing = 0.0;  ///< share of the seeds there that retarget carries over an edge
};

PosterRun run_poster_model(const PosterModel& model, const TemporalTextures& textures);

/// A retarget tile as the published annealers leave it: swaps of two seeds within reach that do not raise the
/// energy, from the identity down to `energy`. For comparisons. Errors: over_limit (not reached).
Grid<Offset> swapped_tile(const Grid<std::int32_t>& levels, Offset step, int radius, std::int64_t energy,
                          std::uint64_t seed);

}  // namespace bn
