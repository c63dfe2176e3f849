// Protects: the driver anneals any state that an engine holds, finds a known optimum, ends with the same
// bytes whatever the threads and wherever it was stopped, and refuses checkpoints and states that are none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "anneal/checkpoint.h"
#include "anneal/metropolis.h"
#include "anneal/run.h"
#include "bn/error.h"
#include "bn/random.h"

namespace bn {
using namespace anneal;
namespace {

/// A ring of numbers whose neighbours want to be alike: the energy is the sum of their squared differences. A
/// proposal swaps two of them. The optimum goes up on one side and down on the other.
class Ring final : public Engine {
 public:
  Ring(int count, std::uint64_t seed, std::uint32_t chain) : seed_(seed), chain_(chain) {
    for (int i = 0; i < count; ++i) values_.push_back(static_cast<char>(i * 7 % count));
  }

  RoundCounts sweeps(std::int64_t round, int first, int end, double temperature, const Execution&,
                     WorseningCounts* worsenings) override {
    RoundCounts counts;
    const auto count = static_cast<std::uint32_t>(values_.size());
    for (int sweep = first; sweep < end; ++sweep) {
      for (std::uint32_t i = 0; i < count / 2; ++i) {
        const auto draw =
            philox({static_cast<std::uint32_t>(round), static_cast<std::uint32_t>(sweep), chain_, i},
                   {static_cast<std::uint32_t>(seed_), 0});
        const std::size_t p = random_below(draw[0], count), q = random_below(draw[1], count);
        ++counts.proposals;
        const std::int64_t before = energy();
        std::swap(values_[p], values_[q]);
        const std::int64_t change = energy() - before;
        const bool taken = change <= metropolis_threshold(draw[2], single_temperature(temperature));
        if (worsenings != nullptr) worsenings->count(change, taken);
        if (!taken) std::swap(values_[p], values_[q]);
        counts.accepted += taken;
        counts.changed += taken && change != 0;
      }
    }
    return counts;
  }
  std::int64_t energy() const override {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const int step = values_[i] - values_[(i + 1) % values_.size()];
      sum += step * step;
    }
    return sum;
  }
  void keep() override { kept_ = values_; }
  std::string save() const override { return values_; }
  std::string save_kept() const override { return kept_; }
  std::size_t state_bytes() const override { return values_.size(); }
  void load(std::string_view state) override { values_ = state; }
  void check_state(std::string_view state) const override {
    std::string sorted(state), own = values_;
    std::sort(sorted.begin(), sorted.end());
    std::sort(own.begin(), own.end());
    if (sorted != own)
      throw Error({.code = ErrorCode::invalid_input,
                   .what = "other numbers",
                   .where = "",
                   .limit = "",
                   .remedy = ""});
  }

 private:
  std::uint64_t seed_;
  std::uint32_t chain_;
  std::string values_;
  std::string kept_;
};

constexpr int kCount = 16;
/// Steps of 1 at both ends and of 2 between: 0 2 4 .. 14 15 13 .. 3 1.
constexpr std::int64_t kOptimum = 2 + (kCount - 2) * 4;

Task ring_task(std::uint64_t seed) {
  return {.make_engine = [seed](std::uint32_t chain) { return std::make_unique<Ring>(kCount, seed, chain); },
          .temperatures = {60.0, 1.0},
          .proposals_per_sweep = kCount / 2,
          .fingerprint = 7 + seed};
}

RunResult anneal_ring(const AnnealOptions& options, const Execution& execution = {.threads = 1},
                      AnnealTrace* trace = nullptr) {
  return anneal::Run(ring_task(options.seed), options, execution, trace).to_end();
}

TEST(Driver, FindsTheOptimumOfAnotherState) {
  for (const auto name : schedule_names()) {
    if (name == "greedy" || name == "constant") continue;
    const RunResult result = anneal_ring({.schedule = std::string(name), .proposals = 200'000});
    EXPECT_EQ(result.energy, kOptimum) << name;
    Ring ring(kCount, 1, 0);
    ring.check_state(result.state);
    ring.load(result.state);
    EXPECT_EQ(ring.energy(), result.energy) << name;
  }
}

TEST(Driver, ThreadsAndTracesChangeNothing) {
  for (const auto coupling : {ChainOptions::Coupling::independent, ChainOptions::Coupling::tempering}) {
    AnnealOptions options{.proposals = 60'000, .chains = {3, coupling}};
    AnnealTrace trace;
    const RunResult one = anneal_ring(options), two = anneal_ring(options, {.threads = 2}, &trace);
    EXPECT_EQ(one.state, two.state);
    EXPECT_EQ(one.accepted, two.accepted);
    EXPECT_GT(trace.size(), 0u);
  }
}

TEST(Driver, GoesOnFromAnyCheckpoint) {
  for (const auto coupling : {ChainOptions::Coupling::independent, ChainOptions::Coupling::tempering}) {
    AnnealOptions options{.proposals = 1'000'000, .chains = {2, coupling}};
    const RunResult whole = anneal_ring(options);
    std::vector<std::string> checkpoints;
    options.checkpoint.interval_s = 0.0;
    options.checkpoint.save = [&](std::string_view bytes) { checkpoints.emplace_back(bytes); };
    EXPECT_EQ(anneal_ring(options).state, whole.state);
    ASSERT_GT(checkpoints.size(), 3u);
    options.checkpoint.save = {};
    for (const std::string& checkpoint : checkpoints) {
      EXPECT_EQ(checkpoint_proposals(checkpoint), options.proposals);
      options.checkpoint.resume = checkpoint;
      const RunResult resumed = anneal_ring(options);
      EXPECT_EQ(resumed.state, whole.state);
      EXPECT_EQ(resumed.accepted, whole.accepted);
    }
  }
}

TEST(Driver, RefusesForeignCheckpointsAndForgedStates) {
  AnnealOptions options{.proposals = 10'000};
  std::string checkpoint;
  options.checkpoint.save = [&](std::string_view bytes) { checkpoint = bytes; };
  anneal_ring(options);
  options.checkpoint.save = {};
  options.checkpoint.resume = checkpoint;
  EXPECT_NO_THROW(anneal_ring(options));
  options.seed = 2;
  EXPECT_THROW(anneal_ring(options), Error) << "of another run";
  options.seed = 1;
  const Ring other(kCount - 1, 1, 0);
  for (const std::string& state : {other.save(), std::string(kCount, '\0')}) {
    RunRecord record = decode_checkpoint(checkpoint, 8, 1, kCount);
    record.chains[0].now = state;
    options.checkpoint.resume = encode_checkpoint(8, record);
    EXPECT_THROW(anneal_ring(options), Error) << "of " << state.size() << " bytes";
  }
}

TEST(Driver, AStopSavesAndThrows) {
  AnnealOptions options{.proposals = 10'000};
  std::string checkpoint;
  options.checkpoint.save = [&](std::string_view bytes) { checkpoint = bytes; };
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(anneal_ring(options, {.threads = 1, .stop = stop.get_token()}), Error);
  EXPECT_FALSE(checkpoint.empty());
}

TEST(Driver, AStateThatNothingCanChangeIsDoneAtOnce) {
  Task task = ring_task(1);
  task.inert = true;
  const AnnealOptions options;
  const Execution execution{.threads = 1};
  anneal::Run run(task, options, execution, nullptr);
  EXPECT_TRUE(run.done());
  EXPECT_EQ(run.to_end().state, Ring(kCount, 1, 0).save());
}

TEST(Driver, ASliceIsNotCutByACheckpoint) {
  const AnnealOptions options{.proposals = 1'000'000};
  const Execution execution{.threads = 1};
  anneal::Run run(ring_task(1), options, execution, nullptr);
  run.sweep();
  EXPECT_THROW(run.checkpoint(), Error);
  run.advance();
  EXPECT_NO_THROW(run.checkpoint());
}

}  // namespace
}  // namespace bn
