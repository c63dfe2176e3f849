// The engines that anneal a retarget tile: a chain of Metropolis swaps of seeds.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "anneal/engine.h"
#include "retarget/anneal_instance.h"

namespace bn::retarget {

using anneal::RoundCounts;
using anneal::WorseningCounts;

/// A placement as bytes: one signed byte per axis and pixel, all x and y, then a volume's z.
std::string placement_bytes(const Placement& displacement_at);

/// A chain whose state is a placement of seeds.
class RetargetEngine : public anneal::Engine {
 public:
  explicit RetargetEngine(const AnnealInstance& instance) : instance_(instance) {}

  /// The displacement k of the seed at each position.
  virtual Placement displacements() const = 0;
  /// The placement that keep() remembered.
  virtual Placement kept() const = 0;
  /// Continues from there: a valid placement, as displacements() gives.
  virtual void place(const Placement& displacement_at) = 0;

  std::string save() const final { return placement_bytes(displacements()); }
  std::string save_kept() const final { return placement_bytes(kept()); }
  std::size_t state_bytes() const final;
  void load(std::string_view state) final;
  void check_state(std::string_view state) const final;

 protected:
  const AnnealInstance& instance_;
};

/// The placement that bytes of the right length stand for, valid or not.
Placement placement_of(const AnnealInstance& instance, std::string_view bytes);

/// The engine for this instance's energy, in the identity k = 0. `instance` must outlive it.
std::unique_ptr<RetargetEngine> make_engine(const AnnealInstance& instance, std::uint64_t seed,
                                            std::uint32_t chain);

/// One swap at a time, for any energy: the specification of annealing.
std::unique_ptr<RetargetEngine> make_scalar_engine(const AnnealInstance& instance, std::uint64_t seed,
                                                   std::uint32_t chain);
/// By how much swaps raise the energy in the identity: of 16384 pairs within reach, drawn evenly, those that
/// raise it. Under constant images, and in tiles without pairs, none.
std::vector<std::int64_t> sample_rises(const AnnealInstance& instance);
/// All swaps of one displacement at once, for energies that are sums over pixels.
std::unique_ptr<RetargetEngine> make_sweep_engine(const AnnealInstance& instance, std::uint64_t seed,
                                                  std::uint32_t chain);

}  // namespace bn::retarget
