// What a chain of Metropolis swaps is to those who drive it: a state that rounds advance.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "retarget/anneal_instance.h"

namespace bn::retarget {

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

/// Swaps within reach that would raise the energy, by the size of the rise: class i holds rises of
/// 2^i .. 2^(i+1) - 1, the last one all larger ones too.
struct WorseningCounts {
  int sweeps = 1 << 30;  ///< how many of the last sweeps are watched
  std::array<std::int64_t, kWorseningClasses> tried{};
  std::array<std::int64_t, kWorseningClasses> accepted{};
  std::int64_t within_reach = 0;  ///< proposals that the reach allows, worsening or not
  void count(std::int64_t change, bool taken);
  WorseningCounts& operator+=(const WorseningCounts& other);
};

/// A chain. What round number `round` draws depends on (seed, chain, round) only.
class AnnealEngine {
 public:
  virtual ~AnnealEngine() = default;

  /// Sweeps first..end - 1 of a round, at one temperature. Counts worsenings where asked; watched sweeps are
  /// slower, nothing else changes.
  virtual RoundCounts sweeps(std::int64_t round, int first, int end, double temperature,
                             const Execution& execution, WorseningCounts* worsenings = nullptr) = 0;
  /// A whole round.
  RoundCounts round(std::int64_t round, int count, double temperature, const Execution& execution,
                    WorseningCounts* worsenings = nullptr) {
    return sweeps(round, 0, count, temperature, execution, worsenings);
  }
  /// The running energy: kept by adding changes, always equal to the recomputed one.
  virtual std::int64_t energy() const = 0;
  /// The displacement k of the seed at each position.
  virtual Placement displacements() const = 0;
  /// Remembers the placement of now, in place of the one before; kept() gives it back.
  virtual void keep() = 0;
  virtual Placement kept() const = 0;
  /// Continues from there: a valid placement, as displacements() gives.
  virtual void place(const Placement& displacement_at) = 0;
};

/// The engine for this instance's energy, in the identity k = 0. `instance` must outlive it.
std::unique_ptr<AnnealEngine> make_engine(const AnnealInstance& instance, std::uint64_t seed,
                                          std::uint32_t chain);

/// One swap at a time, for any energy: the specification of annealing.
std::unique_ptr<AnnealEngine> make_scalar_engine(const AnnealInstance& instance, std::uint64_t seed,
                                                 std::uint32_t chain);
/// By how much swaps raise the energy in the identity: of 16384 pairs within reach, drawn evenly, those that
/// raise it. Under constant images, and in tiles without pairs, none.
std::vector<std::int64_t> sample_rises(const AnnealInstance& instance);
/// All swaps of one displacement at once, for energies that are sums over pixels.
std::unique_ptr<AnnealEngine> make_sweep_engine(const AnnealInstance& instance, std::uint64_t seed,
                                                std::uint32_t chain);

}  // namespace bn::retarget
