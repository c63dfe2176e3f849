// The run of an annealing: chains advance in beats; between beats they meet, exchange places, write the trace
// and take checkpoints. One driver serves one chain, independent restarts and parallel tempering.
//
// A beat is a number of rounds that depends on the problem and the budget alone, a round some sweeps at one
// temperature. Whatever threads, clocks and readers do, the same rounds happen in the same order per chain.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bn/random.h"
#include "core/progress.h"
#include "core/refuse.h"
#include "core/reproducible_math.h"
#include "retarget/anneal_checkpoint.h"
#include "retarget/anneal_engine.h"
#include "retarget/anneal_options.h"

namespace bn {
using namespace retarget;
namespace {

using Clock = std::chrono::steady_clock;

/// Stream of random numbers for exchanges between chains.
constexpr std::uint32_t kExchangeStream = 0x5D000000u;
constexpr std::int64_t kTracePoints = 512;
/// A watched sweep takes some 20 times as long as another; one in this many costs a run 0.25 %.
constexpr std::int64_t kSweepsPerWatchedOne = 8192;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One chain and how far it is.
struct Chain {
  std::unique_ptr<AnnealEngine> engine;
  Cooling cooling;
  std::int64_t round = 0;
  std::int64_t proposals = 0;
  std::int64_t accepted = 0;
  std::int64_t best_energy = 0;
  WorseningCounts watched = {};
  bool watch = false;
  std::int64_t target = 0;  ///< proposals at which the beat ends
  // The round in hand: the sweeps made, what they did, and where they were made.
  int sweep = 0;
  RoundCounts counts = {};
  bool quench = false;
  double temperature = 0.0;

  bool done(std::int64_t end) const { return proposals >= end || cooling.frozen(); }
  bool arrived(std::int64_t end) const { return sweep == 0 && (proposals >= target || done(end)); }
};

class Run {
 public:
  Run(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution,
      AnnealTrace* trace)
      : options_(options),
        execution_(execution),
        trace_(trace),
        instance_(problem, options.swap_distance_px),
        fingerprint_(fingerprint_of(problem, options)) {
    const auto chains = static_cast<std::uint64_t>(options.chains.count);
    check_memory(
        execution,
        chains * static_cast<std::uint64_t>(instance_.size.area()) * (24 + 16 * instance_.weight.size()),
        "annealing");
    temperatures_ = temperatures_of(instance_, options);
    end_ = options.stop_after > 0 ? options.stop_after : options.proposals;
    const std::int64_t quench = options.proposals / kQuenchShare;
    cooled_ = options.proposals - quench;
    const std::int64_t sweep = std::max<std::int64_t>(1, instance_.size.area() / 2);
    sweeps_ = static_cast<int>(std::clamp<std::int64_t>(options.proposals / (4096 * sweep), 1, 64));
    // Short enough to stop, to save and to exchange in time; a residual's swaps are slow.
    const bool residual = instance_.residual_sigma_px > 0.0;
    const std::int64_t longest = residual ? 200'000 : tempering() ? 400'000 : 100'000'000;
    // Long enough to be worth waking other threads.
    const std::int64_t shortest = options.chains.count == 1 ? 1 : residual ? 2'000 : 200'000;
    beat_ = std::clamp<std::int64_t>(options.proposals / kTracePoints, shortest, longest);

    for (int c = 0; c < options.chains.count; ++c) {
      Chain& chain = chains_.emplace_back(
          Chain{make_engine(instance_, options.seed, static_cast<std::uint32_t>(c)), Cooling(schedule(c))});
      chain.best_energy = chain.engine->energy();
      chain.engine->keep();
    }
    start_energy_ = chains_.front().engine->energy();
    if (!options.checkpoint.resume.empty()) resume();
    trace_point();
  }

  AnnealResult run() {
    auto saved = Clock::now();
    double save_cost_s = 0.0;
    ProgressMeter progress(execution_, static_cast<std::uint64_t>(end_));
    std::uint64_t reported = 0;
    while (!done()) {
      if (execution_.stop.stop_requested()) {
        save();
        throw_if_stopped(execution_);
      }
      const double asked = options_.checkpoint.interval_s;
      const double interval = asked == 0.0 ? 0.0 : std::max(asked, std::min(28.0, 50.0 * save_cost_s));
      if (options_.checkpoint.save && seconds_since(saved) >= interval) {
        const auto before = Clock::now();
        save();
        save_cost_s = seconds_since(before);
        saved = Clock::now();
      }
      beat();
      const auto made = static_cast<std::uint64_t>(std::min(chains_.front().proposals, end_));
      progress.advance(made - reported);
      reported = made;
    }
    save();
    progress.finish();
    return result();
  }

  bool done() const {
    return instance_.displacements.empty() ||
           std::all_of(chains_.begin(), chains_.end(),
                       [&](const Chain& c) { return c.sweep == 0 && c.done(end_); });
  }

  /// To the end of the beat.
  void beat() {
    const auto start = Clock::now();
    if (!in_beat_) begin_beat();
    const Execution inside{.threads = chains_.size() == 1 ? execution_.threads : 1};
    parallel_for({.threads = execution_.threads}, static_cast<std::int64_t>(chains_.size()),
                 [&](std::int64_t c) {
                   Chain& chain = chains_[static_cast<std::size_t>(c)];
                   while (!chain.arrived(end_)) advance(chain, sweeps_, inside);
                 });
    seconds_ += seconds_since(start);
    end_beat();
  }

  /// One sweep of each chain that has not come to the end of the beat, watched.
  void sweep() {
    const auto start = Clock::now();
    if (!in_beat_) begin_beat();
    bool arrived = true;
    for (Chain& chain : chains_) {
      if (chain.arrived(end_)) continue;
      chain.watched = {.sweeps = 1};
      chain.watch = true;
      advance(chain, 1, execution_);
      arrived = arrived && chain.arrived(end_);
    }
    seconds_ += seconds_since(start);
    if (arrived) end_beat();
  }

  AnnealState state() const {
    const Chain& chain = chains_.front();
    AnnealState state{.proposals = chain.proposals + chain.counts.proposals,
                      .accepted = chain.accepted + chain.counts.accepted,
                      .seconds = seconds_,
                      .temperature = chain.temperature,
                      .energy = chain.engine->energy(),
                      .best_energy = best_energy(),
                      .worsening_tried = chain.watched.tried,
                      .worsening_accepted = chain.watched.accepted,
                      .done = done()};
    // Until the first sweep, where it will be made.
    if (state.proposals == 0 && !state.done) state.temperature = chain.cooling.temperature();
    return state;
  }

  Placement move() const { return instance_.moves_of(chains_.front().engine->displacements()); }

  /// Of chain c; chains of tempering hold the temperature of their place on the ladder.
  CoolingSchedule schedule(int c) const {
    if (tempering()) return ConstantCooling{ladder(c)};
    return schedule_of(options_, temperatures_, cooled_);
  }

  std::string checkpoint() const {
    if (in_beat_) refuse("checkpoint", "asked for between sweeps", "after a beat", "finish the beat first");
    RunRecord record{.proposals = options_.proposals, .beats = beats_, .chains = {}};
    for (const Chain& chain : chains_) {
      record.chains.push_back({.cooling = chain.cooling.progress(),
                               .round = chain.round,
                               .proposals = chain.proposals,
                               .accepted = chain.accepted,
                               .best_energy = chain.best_energy,
                               .now = chain.engine->displacements(),
                               .best = chain.engine->kept()});
    }
    return encode_checkpoint(fingerprint_, record);
  }

  AnnealResult result() const {
    const Chain* best = &chains_.front();
    AnnealResult result;
    for (const Chain& chain : chains_) {
      if (chain.best_energy < best->best_energy) best = &chain;
      result.proposals += chain.proposals;
      result.accepted += chain.accepted;
      result.frozen = result.frozen || chain.cooling.frozen();
    }
    Placement move = instance_.moves_of(best->engine->kept());
    instance_.check_moves(move);
    result.tile.move = std::move(move.xy);
    result.move_z = std::move(move.z);
    result.tile.start_energy = start_energy_;
    result.tile.energy = best->best_energy;
    result.tile.lower_bound = options_.lower_bound;
    const TemperatureRange range = temperatures();
    result.start_temperature = range.start;
    result.end_temperature = range.end;
    return result;
  }

 private:
  bool tempering() const { return options_.chains.coupling == ChainOptions::Coupling::tempering; }

  /// The temperatures of the run, also where a parameter led the schedule elsewhere than to the end asked
  /// for.
  TemperatureRange temperatures() const {
    const ScheduleParameters& p = options_.parameters;
    const bool led = p.factor || p.slope || p.hajek_c;
    if (!led || tempering() || options_.custom || options_.schedule == "kirkpatrick") return temperatures_;
    Cooling cooling(schedule(0));
    TemperatureRange range;
    range.start = cooling.temperature();
    cooling.advance(cooled_, 0, 0);
    range.end = cooling.temperature();
    return range;
  }

  /// Geometric, chain 0 the coldest.
  double ladder(int place) const {
    const double share = static_cast<double>(place) / (options_.chains.count - 1);
    return temperatures_.end *
           reproducible_exp(share * reproducible_log(temperatures_.start / temperatures_.end));
  }

  void begin_beat() {
    for (Chain& chain : chains_) {
      chain.target = std::min(options_.proposals, chain.proposals + beat_);
      chain.watched = {.sweeps = 1};
      chain.watch = trace_ != nullptr && &chain == &chains_.front() &&
                    sweeps_done() - last_watched_ >= kSweepsPerWatchedOne;
    }
    if (chains_.front().watch) last_watched_ = sweeps_done();
    in_beat_ = true;
  }

  void end_beat() {
    if (tempering()) exchange();
    ++beats_;
    in_beat_ = false;
    trace_point();
  }

  std::int64_t sweeps_done() const { return chains_.front().round * sweeps_; }

  /// Up to `sweeps` sweeps, not beyond the round. Whole rounds cool, count and may be the best.
  void advance(Chain& chain, int sweeps, const Execution& inside) {
    if (chain.sweep == 0) {
      chain.quench = chain.proposals >= cooled_;
      chain.temperature = chain.quench ? 0.0 : chain.cooling.temperature();
    }
    const int end = std::min(sweeps_, chain.sweep + sweeps);
    WorseningCounts* worsenings = std::exchange(chain.watch, false) ? &chain.watched : nullptr;
    chain.counts +=
        chain.engine->sweeps(chain.round, chain.sweep, end, chain.temperature, inside, worsenings);
    chain.sweep = end;
    if (end < sweeps_) return;

    const RoundCounts counts = std::exchange(chain.counts, {});
    chain.sweep = 0;
    ++chain.round;
    chain.proposals += counts.proposals;
    chain.accepted += counts.accepted;
    if (!chain.quench) chain.cooling.advance(counts.proposals, counts.accepted, counts.changed);
    if (chain.engine->energy() >= chain.best_energy) return;
    chain.best_energy = chain.engine->energy();
    chain.engine->keep();
  }

  /// Neighbours on the ladder exchange places with Metropolis' chance: even pairs in even beats, odd ones in
  /// odd beats. The placements move, the engines stay, so that their random numbers do.
  void exchange() {
    for (std::size_t c = static_cast<std::size_t>(beats_ & 1); c + 1 < chains_.size(); c += 2) {
      Chain &cold = chains_[c], &hot = chains_[c + 1];
      const double gain = static_cast<double>(cold.engine->energy() - hot.engine->energy());
      const double exponent =
          gain * (1.0 / ladder(static_cast<int>(c)) - 1.0 / ladder(static_cast<int>(c) + 1));
      const auto bits = random_bits(options_.seed, kExchangeStream + static_cast<std::uint32_t>(c),
                                    static_cast<std::uint64_t>(beats_)) >>
                        11;
      const double u = (static_cast<double>(bits) + 0.5) * 0x1p-53;
      if (exponent < 0.0 && u >= reproducible_exp(exponent)) continue;
      const auto was_cold = cold.engine->displacements();
      cold.engine->place(hot.engine->displacements());
      hot.engine->place(was_cold);
    }
  }

  std::int64_t best_energy() const {
    std::int64_t best = chains_.front().best_energy;
    for (const Chain& chain : chains_) best = std::min(best, chain.best_energy);
    return best;
  }

  void trace_point() {
    if (trace_ == nullptr) return;
    const Chain& chain = chains_.front();
    const auto notch = static_cast<std::int64_t>(static_cast<double>(chain.proposals) /
                                                 static_cast<double>(options_.proposals) * kTracePoints);
    if (notch == last_notch_) return;
    last_notch_ = notch;
    const std::int64_t made = chain.proposals - traced_proposals_,
                       accepted = chain.accepted - traced_accepted_;
    traced_proposals_ = chain.proposals;
    traced_accepted_ = chain.accepted;
    trace_->add(
        {.proposals = chain.proposals,
         .seconds = seconds_,
         .temperature = chain.proposals >= cooled_ ? 0.0 : chain.cooling.temperature(),
         .energy = chain.engine->energy(),
         .best_energy = best_energy(),
         .accepted_share = made == 0 ? 0.0 : static_cast<double>(accepted) / static_cast<double>(made),
         .worsening_tried = chain.watched.tried,
         .worsening_accepted = chain.watched.accepted});
  }

  void save() const {
    if (options_.checkpoint.save) options_.checkpoint.save(checkpoint());
  }

  void resume() {
    const RunRecord record =
        decode_checkpoint(options_.checkpoint.resume, fingerprint_, chains_.size(), instance_);
    beats_ = record.beats;
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      const ChainRecord& from = record.chains[c];
      Chain& chain = chains_[c];
      chain.engine->place(from.best);
      chain.engine->keep();
      chain.best_energy = chain.engine->energy();
      chain.engine->place(from.now);
      chain.cooling.resume(from.cooling);
      chain.round = from.round;
      chain.proposals = from.proposals;
      chain.accepted = from.accepted;
    }
  }

  const AnnealOptions& options_;
  const Execution& execution_;
  AnnealTrace* trace_;
  AnnealInstance instance_;
  std::uint64_t fingerprint_;
  TemperatureRange temperatures_;
  std::int64_t end_ = 0;     ///< proposals of a chain at which it is done
  std::int64_t cooled_ = 0;  ///< proposals before the last ones at temperature 0
  int sweeps_ = 1;           ///< of a round
  std::int64_t beat_ = 1;    ///< proposals of a beat
  std::vector<Chain> chains_;
  std::int64_t start_energy_ = 0;
  std::int64_t beats_ = 0;
  bool in_beat_ = false;
  double seconds_ = 0.0;  ///< spent annealing
  std::int64_t last_watched_ = 0, last_notch_ = -1, traced_proposals_ = 0, traced_accepted_ = 0;
};

}  // namespace

AnnealResult anneal_retarget(const AnnealProblem& problem, const AnnealOptions& options,
                             const Execution& execution, AnnealTrace* trace) {
  check_anneal_options(options);
  thread_count(execution);
  return Run(problem, options, execution, trace).run();
}

/// The run, and what it refers to.
struct Annealing::Held {
  AnnealOptions options;
  Execution execution;
  Run run;
  Held(const AnnealProblem& problem, const AnnealOptions& given, const Execution& how, AnnealTrace* trace)
      : options(given), execution(how), run(problem, options, execution, trace) {}
};

Annealing::Annealing(const AnnealProblem& problem, const AnnealOptions& options, const Execution& execution,
                     AnnealTrace* trace) {
  check_anneal_options(options);
  thread_count(execution);
  held_ = std::make_unique<Held>(problem, options, execution, trace);
}
Annealing::~Annealing() = default;

void Annealing::beat() {
  if (!held_->run.done()) held_->run.beat();
}
void Annealing::sweep() {
  if (!held_->run.done()) held_->run.sweep();
}
AnnealState Annealing::state() const { return held_->run.state(); }
std::string Annealing::checkpoint() const { return held_->run.checkpoint(); }
Grid<Offset> Annealing::move() const { return held_->run.move().xy; }
Grid<std::int8_t> Annealing::move_z() const { return held_->run.move().z; }
AnnealResult Annealing::result() const { return held_->run.result(); }
CoolingSchedule Annealing::schedule() const { return held_->run.schedule(0); }

}  // namespace bn
