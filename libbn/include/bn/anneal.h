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
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "bn/retarget.h"

namespace bn {

/// Raised whenever the same problem and options would give other bytes than before.
inline constexpr int kAnnealVersion = 2;

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
  /// > 0: this many stages share tried_per_stage * stages proposals; what an early end saves goes to those
  /// that follow. 0: each has tried_per_stage for itself.
  int stages = 0;
  double at_stage(std::int64_t stage) const;
};

using CoolingSchedule = std::variant<ExponentialCooling, KirkpatrickCooling, LinearCooling, InverseCooling,
                                     HajekCooling, ConstantCooling, GreedyCooling>;

/// "exponential", "kirkpatrick", "linear", "inverse", "hajek", "constant", "greedy": all schedule names.
std::vector<std::string_view> schedule_names();
std::string_view name_of(const CoolingSchedule& schedule);

/// Throws invalid_input, naming the parameter and its range, unless all are in range.
void check_schedule(const CoolingSchedule& schedule);

/// Parameters of schedules that a user may fix; those left empty follow from start, end and budget. The names
/// are those of recipes and, with dashes, of flags.
struct ScheduleParameters {
  /// a of exponential (a step), inverse (a step) and kirkpatrick (a stage): above 0, at most 1; kirkpatrick
  /// below 1. The first two then end where it leads them, not at `end`.
  std::optional<double> factor = {};
  std::optional<double> slope = {};    ///< mu of linear, >= 0
  std::optional<double> hajek_c = {};  ///< c of hajek, above 0
  /// Of kirkpatrick: as many stages share the proposals, 1..1000000.
  std::optional<int> stages = {};
  std::optional<std::int64_t> accepted_per_stage = {};  ///< of kirkpatrick, >= 1
  std::optional<std::int64_t> tried_per_stage = {};  ///< of kirkpatrick, >= 1; without stages, of each alone
  std::optional<int> frozen_stages = {};             ///< of kirkpatrick, >= 1
};

/// The schedule called `name` that starts at `start`, ends at `end` and spends `proposals`, so that
/// schedules can be compared. Hajek's has one constant and cannot meet both: c = end * ln(proposals + 2),
/// so it starts at about 1.44 c whatever `start` is; constant stays at `end`. Kirkpatrick's has 100 stages
/// that share the proposals; a stage ends when as many swaps were accepted as 0.2 % of an equal share.
/// Errors: invalid_input (unknown name, start not above 0, end not in 0..start, 0 where the formula
/// cannot reach it, proposals not in 1..2^62, a parameter out of its range or of another schedule).
CoolingSchedule make_schedule(std::string_view name, double start, double end, std::int64_t proposals,
                              const ScheduleParameters& parameters = {});

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

/// Where the temperature starts.
struct StartTemperature {
  enum class Rule {
    automatic,   ///< from the problem: see automatic_temperatures()
    given,       ///< `value`, above 0
    acceptance,  ///< such that a share `value`, 0.001..0.999, of the worsening swaps within reach of the
                 ///< identity is accepted: the mean of exp(-rise / T) over a sample. 1 where no swap worsens
    everything,  ///< twice the largest cost, the most a swap can add: accepts each with a chance of at least
                 ///< 1/e. Not for a residual
  };
  Rule rule = Rule::automatic;
  double value = 0.0;
};

/// Several chains on one problem. They share nothing but the seed.
struct ChainOptions {
  enum class Coupling {
    independent,  ///< each cools by the schedule; the best result is kept
    tempering,    ///< parallel tempering: constant temperatures in geometric steps from start to end, the
                  ///< schedule unused; neighbours offer to exchange places. C. J. Geyer, "Markov chain Monte
                  ///< Carlo maximum likelihood", Computing Science and Statistics 23 (1991)
  };
  int count = 1;  ///< 1..256, tempering 2..256
  Coupling coupling = Coupling::independent;
};

/// One sample of a running annealing.
struct TracePoint {
  std::int64_t proposals = 0;  ///< made so far by the traced chain
  double seconds = 0.0;        ///< of wall time spent annealing
  double temperature = 0.0;
  std::int64_t energy = 0;       ///< of the traced chain, now
  std::int64_t best_energy = 0;  ///< of any chain, so far
  double accepted_share = 0.0;   ///< of the proposals since the point before
  /// Worsening swaps within reach, of one sweep since the point before. Counting slows a sweep, so one in
  /// 8192 at most is counted: all 0 at the points between, and throughout a run of fewer sweeps.
  std::array<std::int64_t, kWorseningClasses> worsening_tried{};
  std::array<std::int64_t, kWorseningClasses> worsening_accepted{};
};

/// Collects at most kCapacity points, evenly over a run. One annealing writes; any number of threads may
/// read size() and the points below it at any time, without locks.
class AnnealTrace {
 public:
  static constexpr std::size_t kCapacity = 1024;

  AnnealTrace() : points_(kCapacity) {}
  std::size_t size() const { return size_.load(std::memory_order_acquire); }
  const TracePoint& operator[](std::size_t i) const { return points_[i]; }
  /// For the annealing. Points beyond the capacity are dropped.
  void add(const TracePoint& point);

  /// A header line and one line a point: step, seconds, temperature, energy, best, lower_bound, accepted, and
  /// worse_<2^i>_tried, worse_<2^i>_accepted for each class.
  std::string csv(std::int64_t lower_bound = 0) const;

 private:
  std::vector<TracePoint> points_;
  std::atomic<std::size_t> size_{0};
};

/// Stopping and going on. A checkpoint is taken between rounds, so a resumed run makes the same bytes as
/// one that was never stopped.
struct Checkpointing {
  /// Called with an opaque checkpoint at most every `interval_s`, once when a stop was requested, and once
  /// when the run is over; from the calling thread. Of a motion set: from any thread, never from two at once.
  /// Write it crash-safely (bn/texture.h, write_text_file).
  std::function<void(std::string_view checkpoint)> save = {};
  /// Seconds between two, 0..3600; stretched up to 28 s where saving takes longer than a fiftieth of it. 0
  /// saves before every beat of the run, whatever it costs.
  double interval_s = 10.0;
  /// A checkpoint to go on from; empty to start afresh.
  std::string resume = {};
};

struct AnnealOptions {
  std::string schedule = "exponential";  ///< one of schedule_names()
  ScheduleParameters parameters = {};
  StartTemperature start = {};
  double end_temperature = 0.0;  ///< above 0, at most the start; 0: automatic
  /// Where set, used as it is in place of schedule, parameters, start and end.
  std::optional<CoolingSchedule> custom = {};
  /// Budget of each chain, 1..2^62. A proposal is one pair of seeds, within reach or not. The last 64th is
  /// spent at temperature 0, whatever the schedule.
  std::int64_t proposals = 1'000'000'000;
  /// Above 0, at most proposals: the run ends after the round in which it has made so many, cooled as for the
  /// whole budget: a run that was stopped, made again.
  std::int64_t stop_after = 0;
  std::uint64_t seed = 1;
  /// Largest distance per axis of two seeds that are swapped, 1..2 radius; 0 for 5/3 radius.
  int swap_distance_px = 0;
  ChainOptions chains = {};
  std::int64_t lower_bound = 0;  ///< known from the exact solver; goes into the result
  Checkpointing checkpoint = {};
};

struct AnnealResult {
  RetargetTile tile;           ///< the best placement seen; tile.lower_bound from the options
  Grid<std::int8_t> move_z;    ///< of a volume: R.z, the third axis of tile.move; else empty
  std::int64_t proposals = 0;  ///< made, by all chains
  std::int64_t accepted = 0;
  double start_temperature = 0.0;
  double end_temperature = 0.0;
  bool frozen = false;  ///< the schedule ended the run before the budget did
};

/// Throws what anneal_retarget() would throw of these options for any problem; ErrorInfo::where is the name
/// of the option in recipes.
void check_anneal_options(const AnnealOptions& options);

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

/// Where an annealing stands. Counts, temperature and energy are of the traced chain, the first.
struct AnnealState {
  std::int64_t proposals = 0;
  std::int64_t accepted = 0;
  double seconds = 0.0;      ///< of wall time spent annealing
  double temperature = 0.0;  ///< of the last sweep; before the first, of that one
  std::int64_t energy = 0;   ///< of move()
  std::int64_t best_energy = 0;
  /// Worsening swaps within reach in the last watched sweep, as in TracePoint.
  std::array<std::int64_t, kWorseningClasses> worsening_tried{};
  std::array<std::int64_t, kWorseningClasses> worsening_accepted{};
  bool done = false;
};

/// anneal_retarget() in parts, for those who watch and steer. Beats and sweeps in any mixture until
/// state().done make the bytes that anneal_retarget() makes in one go, at its speed where they are beats.
///
/// options.checkpoint.resume is honoured, `save` is not called. execution.progress is not called,
/// execution.stop not looked at: who wants to stop makes no further call. Threads: one caller at a time; no
/// locks inside. Errors: the constructor's are those of anneal_retarget(). `trace` must outlive the object.
class Annealing {
 public:
  Annealing(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution = {},
            AnnealTrace* trace = nullptr);
  ~Annealing();
  Annealing(const Annealing&) = delete;
  Annealing& operator=(const Annealing&) = delete;

  /// Goes on by a 512th of the budget, at most 1e8 proposals: a tenth of a second at common speeds. Nothing
  /// once done.
  void beat();
  /// Goes on by one sweep, about half as many proposals as pixels, of each chain (some may wait for others).
  /// It is watched, so state() has its worsenings. Nothing once done.
  void sweep();

  AnnealState state() const;
  /// As Checkpointing::save gets it; after a beat. Throws invalid_input between the sweeps of one.
  std::string checkpoint() const;
  Grid<Offset> move() const;         ///< the placement of the traced chain, now; a pass over the pixels
  Grid<std::int8_t> move_z() const;  ///< its third axis, of a volume; else empty
  /// With the best placement after a whole round, so far; likewise. A run of one chain whose stop_after is
  /// result().proposals ends with the same bytes; none has been made before the first round ends.
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

/// The budget (AnnealOptions::proposals) of the run or motion set that a checkpoint is of, so that a budget
/// once found by a clock can be kept. Throws invalid_input for bytes that are no whole checkpoint.
std::int64_t checkpoint_proposals(std::string_view checkpoint);

/// The temperatures an automatic start and end stand for. For sums over pixels: start 6 c, end 0.9 c, with c
/// the mean over pixels of the least cost within reach, but at least a tenth of the least cost above 0 that
/// two levels of a channel have. They grow with the unit of the levels: an image of 8 bits has those of the
/// same image in 16, in its own unit. Where levels are few and c meets its bound the run is nearly greedy,
/// which is best there: plateaus are crossed for nothing. For a residual: a start that accepts a fifth of the
/// worsening swaps, and a 4000th of it as end.
struct TemperatureRange {
  double start = 0.0;
  double end = 0.0;
};
TemperatureRange automatic_temperatures(const AnnealProblem& problem);

/// The proposals that `seconds` of wall time allow, by a trial run of at most a twentieth of them. A clock
/// decides, so record the number where bytes must come back.
std::int64_t proposals_for(double seconds, const AnnealProblem& problem, const AnnealOptions& options,
                           const Execution& execution = {});

// --- studies ---------------------------------------------------------------------------------------

struct AnnealStudyRun {
  std::string schedule;
  int radius = 0;
  std::int64_t proposals = 0;
  std::uint64_t seed = 0;
  double cpu_seconds = 0.0;  ///< one thread
  std::int64_t energy = 0;
};
/// A line a run under a line of names: schedule,radius,proposals,seed,seconds,energy.
std::string runs_csv(const std::vector<AnnealStudyRun>& runs);
/// The inverse. Errors: invalid_input, naming the line.
std::vector<AnnealStudyRun> runs_from_csv(std::string_view csv);

/// What study_anneal() crosses with each other.
struct AnnealStudyOptions {
  RetargetOptions retarget = {};  ///< its radius is not used
  std::vector<std::string> schedules;
  std::vector<std::int64_t> budgets;  ///< proposals
  std::vector<int> radii;
  int seeds = 1;  ///< 1..seeds
  StartTemperature start = {};
  double end_temperature = 0.0;
  std::vector<AnnealStudyRun> known = {};  ///< made before, of this problem: these are not made again
  /// Called with known and new runs after each group of seeds, and when a stop was requested.
  std::function<void(const std::vector<AnnealStudyRun>&)> save = {};
};

struct AnnealStudyExact {
  int radius = 0;
  double cpu_seconds = 0.0;  ///< one thread, median of five
  std::int64_t start_energy = 0;
  std::int64_t energy = 0;  ///< proven optimal
};
struct AnnealStudy {
  std::vector<AnnealStudyExact> exact;  ///< one a radius
  std::vector<AnnealStudyRun> runs;     ///< known ones first
};

/// Anneals `levels` under every combination and solves each radius exactly. Energies are reproducible, times
/// are those of this machine. Errors: as anneal_retarget() and solve_retarget().
AnnealStudy study_anneal(const Grid<std::int32_t>& levels, const AnnealStudyOptions& options,
                         const Execution& execution = {});

struct AnnealThroughput {
  std::string engine;  ///< an instruction set of the data-parallel sweep, or "swap by swap"
  int side = 0;
  int threads = 1;
  double temperature = 0.0;
  double proposals_per_second = 0.0;  ///< of wall time
};
/// At constant temperatures, in equilibrium, on square tiles of random 8 bit levels, radius 6; medians over
/// eleven stretches. Every engine at 256x256 and T = 30, 3 and 0.5 on one thread; 512x512 at T = 3 and 0.5 on
/// 1, 2, 4 .. execution.threads, taking turns, so that what else the machine does hits them alike.
std::vector<AnnealThroughput> study_anneal_throughput(const Execution& execution = {});

/// What watching and saving cost, as shares of a run's time.
struct AnnealCosts {
  /// Of a trace (readers take no lock): median over 101 ratios of processor times, each of two runs with
  /// a trace and two without, of 1e8 proposals.
  double trace = 0.0;
  double trace_low = 0.0, trace_high = 0.0;  ///< 95 % confidence interval of that median
  double save_seconds = 0.0;                 ///< one checkpoint, encoded and handed to `save`; median
  double checkpoints = 0.0;                  ///< save_seconds over the default interval
  std::size_t checkpoint_bytes = 0;
};
AnnealCosts study_anneal_costs(const AnnealProblem& problem,
                               const std::function<void(std::string_view)>& save,
                               const Execution& execution = {});

}  // namespace bn
