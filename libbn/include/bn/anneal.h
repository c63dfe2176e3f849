// bn/anneal.h - floor 1 (anneal): simulated annealing, whatever it is that is annealed.
//
// Cooling schedules, the options of a run, its trace and its checkpoints. A room that anneals something gives
// the driver of this room an engine (libbn/anneal/engine.h); bn/retarget_anneal.h is the one that exists.
//
// Five units of time stand inside each other: a proposal, a sweep, a round, a slice and a run. The glossary
// (docs/glossary.md) says what each of them is.
//
// Source of the method: S. Kirkpatrick, C. D. Gelatt, M. P. Vecchi, "Optimization by simulated annealing",
// Science 220 (1983); acceptance rule: N. Metropolis et al., J. Chem. Phys. 21 (1953).

#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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

  /// A header line and one line a point: proposals, seconds, temperature, energy, best, lower_bound, accepted,
  /// and worse_<2^i>_tried, worse_<2^i>_accepted for each class up to the largest that was tried.
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
  /// saves before every slice of the run, whatever it costs.
  double interval_s = 10.0;
  /// A checkpoint to go on from; empty to start afresh.
  std::string resume = {};
};

struct AnnealOptions {
  std::string schedule = "exponential";  ///< one of schedule_names()
  ScheduleParameters parameters = {};
  StartTemperature start = {};
  double end_temperature = 0.0;  ///< above 0, at most the start; 0: automatic
  /// Budget of each chain, 1..2^62. A proposal is one pair of seeds, within reach or not. The last 64th is
  /// spent at temperature 0, whatever the schedule.
  std::int64_t proposals = 1'000'000'000;
  /// 0, or 1..proposals: the run ends after the round in which it has made so many, but cools as if for all
  /// of `proposals`. So a run that was interrupted can be reproduced.
  std::int64_t stop_after = 0;
  std::uint64_t seed = 1;
  /// Largest distance per axis of two seeds that are swapped. Of a retarget tile 1..2 radius; 0 for 5/3
  /// radius.
  int swap_distance_px = 0;
  ChainOptions chains = {};
  Checkpointing checkpoint = {};
};

/// Throws invalid_input for options that no problem allows. ErrorInfo::where is the name of the option in
/// recipes.
void check_anneal_options(const AnnealOptions& options);

/// Where an annealing stands. Counts, temperature and energy are of the traced chain, the first.
struct AnnealState {
  std::int64_t proposals = 0;
  std::int64_t accepted = 0;
  double seconds = 0.0;      ///< of wall time spent annealing
  double temperature = 0.0;  ///< of the last sweep; before the first, of that one
  std::int64_t energy = 0;   ///< of the placement now
  std::int64_t best_energy = 0;
  /// Worsening swaps within reach in the last watched sweep, as in TracePoint.
  std::array<std::int64_t, kWorseningClasses> worsening_tried{};
  std::array<std::int64_t, kWorseningClasses> worsening_accepted{};
  bool done = false;
};

/// The temperatures of a run: where it starts and where it ends.
struct TemperatureRange {
  double start = 0.0;
  double end = 0.0;
};

/// The budget (AnnealOptions::proposals) of the run or motion set that a checkpoint is of, so that a budget
/// once found by a clock can be kept. Throws invalid_input for bytes that are no whole checkpoint.
std::int64_t checkpoint_proposals(std::string_view checkpoint);

}  // namespace bn
