#include "anneal/run.h"

#include <algorithm>

#include "anneal/checkpoint.h"
#include "anneal/temperature.h"
#include "core/progress.h"
#include "core/refuse.h"

namespace bn::anneal {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

RoundPlan plan_of(const Task& task, const AnnealOptions& options) {
  RoundPlan plan;
  plan.end = options.stop_after > 0 ? options.stop_after : options.proposals;
  plan.cooled = options.proposals - options.proposals / kQuenchShare;
  const std::int64_t sweep = std::max<std::int64_t>(1, task.proposals_per_sweep);
  plan.sweeps = static_cast<int>(std::clamp<std::int64_t>(options.proposals / (4096 * sweep), 1, 64));
  return plan;
}

}  // namespace

Run::Run(const Task& task, const AnnealOptions& options, const Execution& execution, AnnealTrace* trace)
    : task_(task),
      options_(options),
      execution_(execution),
      plan_(plan_of(task, options)),
      trace_(trace, options.proposals) {
  // Short enough to stop, to save and to exchange in time.
  const std::int64_t longest = task.slow ? 200'000 : tempering() ? 400'000 : 100'000'000;
  // Long enough to be worth waking other threads.
  const std::int64_t shortest = options.chains.count == 1 ? 1 : task.slow ? 2'000 : 200'000;
  slice_proposals_ = std::clamp<std::int64_t>(options.proposals / kTracePoints, shortest, longest);

  for (int c = 0; c < options.chains.count; ++c) {
    Chain& chain =
        chains_.emplace_back(Chain{task_.make_engine(static_cast<std::uint32_t>(c)), Cooling(schedule(c))});
    chain.best_energy = chain.engine->energy();
    chain.engine->keep();
  }
  start_energy_ = chains_.front().engine->energy();
  if (!options.checkpoint.resume.empty()) resume();
  record_trace();
}

RunResult Run::to_end() {
  auto saved = Clock::now();
  double save_cost_s = 0.0;
  ProgressMeter progress(execution_, static_cast<std::uint64_t>(plan_.end));
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
    advance();
    const auto made = static_cast<std::uint64_t>(std::min(chains_.front().proposals, plan_.end));
    progress.advance(made - reported);
    reported = made;
  }
  save();
  progress.finish();
  return result();
}

bool Run::done() const {
  return task_.inert || std::all_of(chains_.begin(), chains_.end(),
                                    [&](const Chain& c) { return c.sweep == 0 && c.done(plan_); });
}

void Run::advance() {
  const auto start = Clock::now();
  if (!in_slice_) begin_slice();
  const Execution inside{.threads = chains_.size() == 1 ? execution_.threads : 1};
  parallel_for({.threads = execution_.threads}, static_cast<std::int64_t>(chains_.size()),
               [&](std::int64_t c) {
                 Chain& chain = chains_[static_cast<std::size_t>(c)];
                 while (!chain.arrived(plan_)) chain.advance(plan_.sweeps, plan_, inside);
               });
  seconds_ += seconds_since(start);
  end_slice();
}

void Run::sweep() {
  const auto start = Clock::now();
  if (!in_slice_) begin_slice();
  bool arrived = true;
  for (Chain& chain : chains_) {
    if (chain.arrived(plan_)) continue;
    chain.watched = {.sweeps = 1};
    chain.watch = true;
    chain.advance(1, plan_, execution_);
    arrived = arrived && chain.arrived(plan_);
  }
  seconds_ += seconds_since(start);
  if (arrived) end_slice();
}

void Run::begin_slice() {
  for (Chain& chain : chains_) {
    chain.target = std::min(options_.proposals, chain.proposals + slice_proposals_);
    chain.watched = {.sweeps = 1};
    chain.watch = false;
  }
  Chain& traced = chains_.front();
  traced.watch = trace_.watches(traced.round * plan_.sweeps);
  in_slice_ = true;
}

void Run::end_slice() {
  if (tempering()) exchange_neighbours(chains_, ladder(), options_.seed, slices_);
  ++slices_;
  in_slice_ = false;
  record_trace();
}

AnnealState Run::state() const {
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

CoolingSchedule Run::schedule(int chain) const {
  if (tempering()) return ConstantCooling{ladder().at(chain)};
  return make_schedule(options_.schedule, task_.temperatures.start, task_.temperatures.end, plan_.cooled,
                       options_.parameters);
}

RunResult Run::result() const {
  const Chain* best = &chains_.front();
  RunResult result;
  for (const Chain& chain : chains_) {
    if (chain.best_energy < best->best_energy) best = &chain;
    result.proposals += chain.proposals;
    result.accepted += chain.accepted;
    result.frozen = result.frozen || chain.cooling.frozen();
  }
  result.state = best->engine->save_kept();
  result.start_energy = start_energy_;
  result.energy = best->best_energy;
  result.temperatures = temperatures();
  return result;
}

/// Of the run, also where a parameter led the schedule elsewhere than to the end asked for.
TemperatureRange Run::temperatures() const {
  const ScheduleParameters& p = options_.parameters;
  const bool led = p.factor || p.slope || p.hajek_c;
  if (!led || tempering() || options_.schedule == "kirkpatrick") return task_.temperatures;
  Cooling cooling(schedule(0));
  TemperatureRange range;
  range.start = cooling.temperature();
  cooling.advance(plan_.cooled, 0, 0);
  range.end = cooling.temperature();
  return range;
}

std::int64_t Run::best_energy() const {
  std::int64_t best = chains_.front().best_energy;
  for (const Chain& chain : chains_) best = std::min(best, chain.best_energy);
  return best;
}

void Run::record_trace() {
  const Chain& chain = chains_.front();
  const double temperature = chain.proposals >= plan_.cooled ? 0.0 : chain.cooling.temperature();
  trace_.record(chain, seconds_, temperature, best_energy());
}

std::string Run::checkpoint() const {
  if (in_slice_) refuse("checkpoint", "asked for between sweeps", "after a slice", "finish the slice first");
  RunRecord record{.proposals = options_.proposals, .slices = slices_, .chains = {}};
  for (const Chain& chain : chains_) {
    record.chains.push_back({.cooling = chain.cooling.progress(),
                             .round = chain.round,
                             .proposals = chain.proposals,
                             .accepted = chain.accepted,
                             .best_energy = chain.best_energy,
                             .now = chain.engine->save(),
                             .best = chain.engine->save_kept()});
  }
  return encode_checkpoint(task_.fingerprint, record);
}

void Run::save() const {
  if (options_.checkpoint.save) options_.checkpoint.save(checkpoint());
}

void Run::resume() {
  const RunRecord record = decode_checkpoint(options_.checkpoint.resume, task_.fingerprint, chains_.size(),
                                             chains_.front().engine->state_bytes());
  slices_ = record.slices;
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    const ChainRecord& from = record.chains[c];
    Chain& chain = chains_[c];
    chain.engine->check_state(from.best);
    chain.engine->check_state(from.now);
    chain.engine->load(from.best);
    chain.engine->keep();
    chain.best_energy = chain.engine->energy();
    chain.engine->load(from.now);
    chain.cooling.resume(from.cooling);
    chain.round = from.round;
    chain.proposals = from.proposals;
    chain.accepted = from.accepted;
  }
}

}  // namespace bn::anneal
