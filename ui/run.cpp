#include "ui/run.h"

#include <pthread.h>

#include <new>
#include <utility>

#include "bn/error.h"

namespace bn::ui {
namespace {

/// Seconds that a stated speed is measured over.
constexpr double kSpeedWindow_s = 0.5;
/// A placement is made at most after so many times what the last one cost.
constexpr double kPlacementRarity = 100.0;

}  // namespace

Run::Run(RunSetup setup, bool paused) : setup_(std::move(setup)), wants_running_(!paused) {
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

Run::~Run() = default;

void Run::start() {
  const std::scoped_lock lock(mutex_);
  wants_running_ = true;
  wanted_sweeps_ = 0;
  wished_.notify_one();
}

void Run::pause() {
  const std::scoped_lock lock(mutex_);
  wants_running_ = false;
}

void Run::sweep() {
  const std::scoped_lock lock(mutex_);
  wants_running_ = false;
  ++wanted_sweeps_;
  wished_.notify_one();
}

void Run::stop() { thread_.request_stop(); }

bool Run::has_ended() const {
  const std::scoped_lock lock(mutex_);
  return standing_.phase >= Phase::finished;
}

Standing Run::standing() const {
  const std::scoped_lock lock(mutex_);
  return standing_;
}

std::shared_ptr<const Placement> Run::placement() {
  const std::scoped_lock lock(mutex_);
  wants_placement_ = true;
  return placement_;
}

std::shared_ptr<const AnnealResult> Run::result() const {
  const std::scoped_lock lock(mutex_);
  return result_;
}

void Run::work(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "bn-run");  // for those who watch it, or give it a core of its own
  std::optional<ErrorInfo> error;
  try {
    anneal(stop);
  } catch (const Error& e) {
    error = e.info();
  } catch (const std::bad_alloc&) {
    error = ErrorInfo{.code = ErrorCode::over_limit,
                      .what = "out of memory",
                      .where = "annealing",
                      .limit = "",
                      .remedy = "use a smaller image, or fewer chains"};
  }
  if (!error) return;
  const std::scoped_lock lock(mutex_);
  standing_.error = std::move(error);
  standing_.phase = Phase::failed;
}

void Run::anneal(const std::stop_token& stop) {
  Annealing annealing(setup_.problem, setup_.options, {.threads = setup_.threads, .stop = stop}, &trace_);
  {
    const AnnealResult nothing_yet = annealing.result();
    const std::scoped_lock lock(mutex_);
    standing_.start_energy = nothing_yet.tile.start_energy;
    standing_.temperatures = {nothing_yet.start_temperature, nothing_yet.end_temperature};
    standing_.phase = Phase::running;
  }
  publish(annealing.state());
  while (!annealing.state().done) {
    const Next what = next(stop, annealing);
    if (what == Next::nothing) break;
    what == Next::sweep ? annealing.sweep() : annealing.advance();
    publish(annealing.state());
    publish_placement(annealing);
  }
  const bool finished = annealing.state().done;
  auto result = std::make_shared<const AnnealResult>(annealing.result());
  auto best = std::make_shared<const Placement>(
      Placement{result->tile.move, result->tile.energy, annealing.state().proposals});
  const std::scoped_lock lock(mutex_);
  placement_ = std::move(best);
  result_ = std::move(result);
  standing_.seconds_left.reset();
  standing_.phase = finished ? Phase::finished : Phase::stopped;
}

Run::Next Run::next(const std::stop_token& stop, const Annealing& annealing) {
  std::unique_lock lock(mutex_);
  if (stop.stop_requested()) return Next::nothing;
  if (wants_running_) {
    standing_.phase = Phase::running;
    return Next::slice;
  }
  if (wanted_sweeps_ == 0) {
    // What the window shows of a paused run is the run, not what it was some time ago.
    lock.unlock();
    const AnnealState state = annealing.state();
    auto now = std::make_shared<const Placement>(Placement{annealing.move(), state.energy, state.proposals});
    auto best = std::make_shared<const AnnealResult>(annealing.result());
    lock.lock();
    placement_ = std::move(now);
    result_ = std::move(best);
    standing_.phase = Phase::paused;
    standing_.seconds_left.reset();
    wished_.wait(lock, stop, [&] { return wants_running_ || wanted_sweeps_ > 0; });
    result_.reset();
    if (stop.stop_requested()) return Next::nothing;
    standing_.phase = Phase::running;
  }
  if (wants_running_) return Next::slice;
  --wanted_sweeps_;
  return Next::sweep;
}

void Run::publish(const AnnealState& state) {
  const double seconds = state.seconds - speed_from_s_;
  const auto made = static_cast<double>(state.proposals - speed_from_proposals_);
  const std::scoped_lock lock(mutex_);
  standing_.state = state;
  // The first figure comes early, the later ones at a pace that can be read.
  if (seconds > kSpeedWindow_s || (standing_.proposals_per_second == 0.0 && seconds > 0.05)) {
    standing_.proposals_per_second = made / seconds;
    speed_from_s_ = state.seconds;
    speed_from_proposals_ = state.proposals;
  }
  if (standing_.proposals_per_second > 0.0) {
    standing_.seconds_left =
        static_cast<double>(setup_.options.proposals - state.proposals) / standing_.proposals_per_second;
  }
}

void Run::publish_placement(const Annealing& annealing) {
  {
    const std::scoped_lock lock(mutex_);
    if (!wants_placement_) return;
  }
  const auto before = Clock::now();
  if (std::chrono::duration<double>(before - placed_).count() < kPlacementRarity * placement_cost_s_) return;
  const AnnealState state = annealing.state();
  auto now = std::make_shared<const Placement>(Placement{annealing.move(), state.energy, state.proposals});
  placed_ = Clock::now();
  placement_cost_s_ = std::chrono::duration<double>(placed_ - before).count();
  const std::scoped_lock lock(mutex_);
  placement_ = std::move(now);
  wants_placement_ = false;
}

}  // namespace bn::ui
