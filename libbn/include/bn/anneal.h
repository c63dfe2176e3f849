// bn/anneal.h - floor 1 (retarget): simulated annealing of retarget tiles.
//
// The exact solver (bn/retarget.h) proves the optimum of one channel's L1 or L2 energy. Annealing handles
// energies it cannot: several channels at once, and residuals seen through a filter. On the energies that
// both handle, the exact optimum says how good annealing is; docs/annealing.md shows it.
//
// Source of the method: S. Kirkpatrick, C. D. Gelatt, M. P. Vecchi, "Optimization by simulated annealing",
// Science 220 (1983); acceptance rule: N. Metropolis et al., J. Chem. Phys. 21 (1953).

#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bn/core.h"
#include "bn/retarget.h"

namespace bn {

/// Raised whenever the same problem and options would give other bytes than before.
inline constexpr int kAnnealVersion = 1;

// --- cooling schedules ---------------------------------------------------------------------------
//
// Temperatures are in the unit of the energy. A step k is one proposal, counted from 0. Every temperature
// is computed by IEEE operations in a written order (reproducible_exp, reproducible_log), so it has the
// same bits on every machine.

/// T = temperature, a limit to compare with: the Metropolis chain of one Boltzmann distribution.
struct ConstantCooling {
  double temperature = 1.0;  ///< >= 0; infinity accepts every move within reach
  double at(double) const { return temperature; }
};

/// T = 0, the other limit: accepts what does not raise the energy.
struct GreedyCooling {
  double at(double) const { return 0.0; }
};

/// T = c / ln(k + 2). Converges in probability to the global minima iff c >= d*, the depth of the deepest
/// local minimum that is not global: B. Hajek, "Cooling schedules for optimal annealing", Mathematics of
/// Operations Research 13 (1988). (One source prints T0 log(1 + k), which heats.)
struct HajekCooling {
  double c = 1.0;  ///< > 0
  double at(double step) const;
};

/// T = max(start - slope * k, end).
struct LinearCooling {
  double start = 1.0;  ///< > 0
  double slope = 0.0;  ///< >= 0
  double end = 0.0;    ///< 0..start
  double at(double step) const;
};

/// T = start * factor^k; Kirkpatrick et al. 1983 with stages of one step.
struct ExponentialCooling {
  double start = 1.0;   ///< > 0
  double factor = 1.0;  ///< above 0, at most 1
  double at(double step) const;
};

/// T = start / (1 + factor * k). H. Szu, R. Hartley, "Fast simulated annealing", Phys. Lett. A 122 (1987);
/// theirs has factor 1 and long jumps, ours is the schedule alone.
struct InverseCooling {
  double start = 1.0;   ///< > 0
  double factor = 0.0;  ///< >= 0
  double at(double step) const;
};

/// T = start * factor^s in stage s. A stage ends after `accepted_per_stage` accepted swaps (quasi-
/// equilibrium) or `tried_per_stage` proposals, and the run when `frozen_stages` stages in a row ended
/// without a single swap that changed the energy. Kirkpatrick et al. 1983, who used 10 accepted swaps per
/// degree of freedom, a cap of 100 tried ones, and 3 stages.
struct KirkpatrickCooling {
  double start = 1.0;                   ///< > 0
  double factor = 0.95;                 ///< above 0, below 1
  std::int64_t accepted_per_stage = 1;  ///< >= 1
  std::int64_t tried_per_stage = 1;     ///< >= 1
  int frozen_stages = 3;                ///< >= 1
  double end = 0.0;                     ///< >= 0; no stage is colder than this
  double at_stage(std::int64_t stage) const;
};

using CoolingSchedule = std::variant<ExponentialCooling, KirkpatrickCooling, LinearCooling, InverseCooling,
                                     HajekCooling, ConstantCooling, GreedyCooling>;

/// "exponential", "kirkpatrick", "linear", "inverse", "hajek", "constant", "greedy": all schedule names.
std::vector<std::string_view> schedule_names();
std::string_view name_of(const CoolingSchedule& schedule);

/// Throws invalid_input, naming the parameter and its range, unless all are in range.
void check_schedule(const CoolingSchedule& schedule);

/// The schedule called `name` that starts at `start`, ends at `end` and spends `proposals`, so that
/// schedules can be compared. Hajek's has one constant and cannot meet both: c = end * ln(proposals + 2),
/// so it starts at about 1.44 c whatever `start` is; constant stays at `end`. Kirkpatrick's has 100 stages,
/// each of at most its share of the proposals or 1.5 accepted swaps a pixel; proposals saved while hot
/// are spent at the end temperature.
/// Errors: invalid_input (unknown name, start not above 0, end not in 0..start, 0 where the formula
/// cannot reach it, proposals not in 1..2^62).
CoolingSchedule make_schedule(std::string_view name, double start, double end, std::int64_t proposals,
                              std::int64_t pixels);

/// Classes of worsenings in traces: class i holds rises of the energy by 2^i .. 2^(i+1) - 1, the last one
/// all larger ones too.
inline constexpr int kWorseningClasses = 24;

// --- the problem -----------------------------------------------------------------------------------

/// One image channel that moves with the seeds.
struct AnnealChannel {
  Grid<std::int32_t> levels;  ///< each 0..2^24-1; all channels of one size
  int weight = 1;             ///< 1..1000, of this channel in the sum
};

/// What to minimise over the permutations that bn/retarget.h describes:
///     E = sum over channels c of weight_c * sum over u of cost(D_c(u), D_c(u + R(u) + d)),
/// or, with residual_sigma_px > 0, the energy of what is left of the difference after a blur,
///     E = sum over c of weight_c * sum over w of (sum over v of g(w - v) * e_c(v))^2,
/// e_c(w) the level that arrived at w less the level that belongs there, g a Gaussian with integer weights
/// (cut at 3 sigma; each axis sums to about 2^b, b <= 8 the largest for which energies stay below 2^62). No
/// assignment solver can handle that one: a seed's cost depends on where the others went.
struct AnnealProblem {
  std::vector<AnnealChannel> channels;  ///< 1..16
  RetargetOptions retarget;             ///< metric must be l2 for a residual; gap is not used
  double residual_sigma_px = 0.0;       ///< 0, or 0.3..8 pixels
};

/// The energy of any permutation, recomputed from its definition. Errors: as anneal_retarget().
std::int64_t anneal_energy(const AnnealProblem& problem, const Grid<Offset>& move);

}  // namespace bn
