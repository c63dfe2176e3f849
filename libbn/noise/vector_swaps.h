// Exchanging the values of voxels for a lower energy: what a round does, and to whom.
//
// A round picks voxels that do not see each other, spread over the torus in one slice, and sorts them into
// groups. In a group, first an estimate is made of what each voxel would gain from the value of each other
// one. Then pairs are formed, each voxel with the partner of most gain that is left; then each pair's gain is
// computed exactly, and the values are exchanged where it is above 0. Voxels of different pairs do not see
// each other, so pairs can be decided in any order and groups on different threads.
//
// Why estimates: to find out by exact sums which of n voxels should exchange takes n^2 of them. The estimate
// replaces what is around by 256ths of the curve: one sum over the surroundings of a voxel then serves for
// all values at once. Of the pairs that it proposes a third to three quarters are good; of pairs drawn
// blindly one in a hundred is.
//
// On a torus too small for 16 such voxels, the group is drawn from all voxels of a slice. They see each other
// and are decided one after the other.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bn/execution.h"
#include "core/progress.h"
#include "noise/vector_terms.h"

namespace bn::noise {

/// Who meets in which round. Depends on sizes, scope and seed only.
class SwapRounds {
 public:
  SwapRounds(const VectorKernel& kernel, Shape size, RankScope scope, std::uint64_t seed);

  /// Voxels of a round.
  int count() const { return count_; }
  int groups() const { return groups_; }
  /// The first voxel of a group; of group groups(), count().
  int first(int group) const { return static_cast<int>(std::int64_t{group} * count_ / groups_); }
  /// Whether they do not see each other.
  bool apart() const { return apart_; }
  std::vector<Voxel> voxels(std::int64_t round) const;

 private:
  Shape size_;
  RankScope scope_;
  std::uint64_t seed_;
  int blocks_x_;
  int blocks_y_;
  int count_;
  int groups_;
  bool apart_;
};

/// Proposes partners to `count` voxels: to i, partners[i], or i itself where there is none. `far` as
/// estimate() gives it, of their own values.
std::vector<int> partners(std::span<const float> far, int count);

/// The gain of exchanging the values of two voxels: minus the change of the energy.
std::int64_t exchange_gain(const VectorField& field, const VectorKernel& kernel, Voxel a, Voxel b);

/// Rounds until each voxel has been in a group `budget` times on average.
void exchange_values(VectorField& field, const VectorKernel& kernel, const VectorMaskOptions& options,
                     const Execution& execution, ProgressMeter& meter);

}  // namespace bn::noise
