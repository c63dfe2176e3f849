// What is annealed, as the driver sees it: a state that rounds of proposals change.
//
// A room that anneals something implements Engine. The state is opaque to the driver. It travels as bytes:
// between the chains of parallel tempering, and into checkpoints.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bn/anneal.h"
#include "bn/execution.h"

namespace bn::anneal {

/// What happened in some rounds. Sums, so that bands and rounds can be added in any order.
struct RoundCounts {
  std::int64_t proposals = 0;
  std::int64_t accepted = 0;
  std::int64_t changed = 0;  ///< accepted with a change of energy
  RoundCounts& operator+=(const RoundCounts& other) {
    proposals += other.proposals;
    accepted += other.accepted;
    changed += other.changed;
    return *this;
  }
};

/// Allowed proposals that would raise the energy, by the size of the rise: class i holds rises of
/// 2^i .. 2^(i+1) - 1, the last one all larger ones too.
struct WorseningCounts {
  int sweeps = 1 << 30;  ///< how many of the last sweeps are watched
  std::array<std::int64_t, kWorseningClasses> tried{};
  std::array<std::int64_t, kWorseningClasses> accepted{};
  std::int64_t within_reach = 0;  ///< proposals that are allowed, worsening or not
  void count(std::int64_t change, bool taken);
  WorseningCounts& operator+=(const WorseningCounts& other);
};

/// One chain's state and its moves. What round number `round` draws depends on (seed, chain, round) only.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Makes the sweeps first..end - 1 of a round at one temperature. Counts worsenings where asked; watched
  /// sweeps are slower, nothing else changes.
  virtual RoundCounts sweeps(std::int64_t round, int first, int end, double temperature,
                             const Execution& execution, WorseningCounts* worsenings = nullptr) = 0;
  /// Makes a whole round.
  RoundCounts round(std::int64_t round, int count, double temperature, const Execution& execution,
                    WorseningCounts* worsenings = nullptr) {
    return sweeps(round, 0, count, temperature, execution, worsenings);
  }
  /// The running energy. It is kept by adding changes and always equals the recomputed one.
  virtual std::int64_t energy() const = 0;
  /// Remembers the state of now as the best one, in place of the one before.
  virtual void keep() = 0;

  /// The state of now as bytes, always state_bytes() of them.
  virtual std::string save() const = 0;
  /// The state that keep() remembered, likewise.
  virtual std::string save_kept() const = 0;
  virtual std::size_t state_bytes() const = 0;
  /// Continues from a state that an engine of the same problem saved.
  virtual void load(std::string_view state) = 0;
  /// Throws unless `state`, of state_bytes(), is one that load() may be given: for bytes from outside.
  virtual void check_state(std::string_view state) const = 0;
};

}  // namespace bn::anneal
