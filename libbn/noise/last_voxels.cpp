#include "noise/last_voxels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include "core/reproducible_math.h"
#include "noise/axis_function.h"
#include "noise/point_grid.h"

namespace bn::noise {
namespace {

struct Hole {
  Pixel at;
  int slice;
  int z, w;  // of the slice
};

/// A difference of two places along an axis, around the torus.
int around(int difference, int side) { return difference < 0 ? difference + side : difference; }

/// How much more other slices weigh than in the kernel, for their Gaussian is narrower. With 8 slices lose
/// half of what is gained and the average of frames is 5 % better; with 1 it is 10 % worse.
constexpr int kOtherSlices = 3;

/// What a voxel sees of others in time, by dw * z_side + dz; of its own slice 256.
std::vector<std::int32_t> sight_in_time(const TorusSides& sides, const VolumeKernel& kernel) {
  std::vector<double> sum(static_cast<std::size_t>(sides.z * sides.w));
  for (const KernelTerm& term : kernel) {
    // What sees its own pixel only hardly ever meets another hole.
    if (term.x.form == AxisForm::delta && term.y.form == AxisForm::delta) continue;
    const std::vector<double> z = wrapped(term.z, sides.z), w = wrapped(term.w, sides.w);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += term.weight * z[i % z.size()] * w[i / z.size()];
  }
  std::vector<std::int32_t> seen;
  for (const double value : sum)
    seen.push_back(sum[0] > 0.0 ? static_cast<std::int32_t>(kOtherSlices * 256.0 * value / sum[0] + 0.5) : 0);
  seen[0] /= kOtherSlices;
  return seen;
}

/// Holes that see those of their slice through a Gaussian of half their mean distance there, and those of
/// other slices through one of half the mean distance of all that are seen, laid over each other.
class Holes {
 public:
  Holes(const TorusSides& sides, const std::vector<std::int32_t>& in_time, const std::vector<Hole>& holes,
        const Execution& execution)
      : sides_(sides), in_time_(in_time), holes_(holes), execution_(execution), energy_(holes.size()) {
    const int slices = sides.z * sides.w;
    const double pixels_a_hole =
        static_cast<double>(sides.x) * sides.y * slices / static_cast<double>(holes.size());
    own_slice_ = gaussian(pixels_a_hole);
    const auto others_begin = in_time.begin() + 1;
    const std::int64_t all = std::accumulate(others_begin, in_time.end(), std::int64_t{0});
    const std::int64_t most = all == 0 ? 1 : *std::max_element(others_begin, in_time.end());
    if (all > 0)
      other_slices_ = gaussian(pixels_a_hole * static_cast<double>(most) / static_cast<double>(all + most));

    const Extent size{sides.x, sides.y};
    everywhere_ = PointGrid(size, reach(other_slices_));
    in_slice_.assign(static_cast<std::size_t>(slices), PointGrid(size, reach(own_slice_)));
    first_.assign(static_cast<std::size_t>(slices), 0);
    for (const Hole& hole : holes) {
      everywhere_.add(hole.at);
      in_slice_[static_cast<std::size_t>(hole.slice)].add(hole.at);
      for (auto slice = static_cast<std::size_t>(hole.slice) + 1; slice < first_.size(); ++slice)
        ++first_[slice];
    }
    constexpr std::int64_t kChunk = 256;
    const std::int64_t count = std::ssize(holes);
    parallel_for(execution, (count + kChunk - 1) / kChunk, [&](std::int64_t chunk) {
      throw_if_stopped(execution);
      for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, count); ++i) {
        const auto hole = static_cast<std::size_t>(i);
        for_each_seen(hole, [&](std::size_t, std::int32_t weight) { energy_[hole] += weight; });
      }
    });
  }

  /// The numbers of all holes in the order in which they are filled: always the one of greatest energy, the
  /// lowest number of equal ones.
  std::vector<std::size_t> fill() {
    using Candidate = std::pair<std::int32_t, std::ptrdiff_t>;  // energy, -number
    std::vector<Candidate> all;
    for (std::size_t i = 0; i < energy_.size(); ++i)
      all.push_back({energy_[i], -static_cast<std::ptrdiff_t>(i)});
    std::priority_queue<Candidate> queue({}, std::move(all));
    std::vector<std::size_t> order;
    while (!queue.empty()) {
      const auto [energy, minus_number] = queue.top();
      const auto number = static_cast<std::size_t>(-minus_number);
      queue.pop();
      // Energies only fall, so the queue holds none that is too low.
      if (energy_[number] < energy) {
        queue.push({energy_[number], minus_number});
        continue;
      }
      if (order.size() % 256 == 0) throw_if_stopped(execution_);
      order.push_back(number);
      for_each_seen(number, [&](std::size_t other, std::int32_t weight) { energy_[other] -= weight; });
    }
    return order;
  }

 private:
  static constexpr double kMostT = 4.5;

  /// The Gaussian of half the mean distance of points that have so many pixels each, by squared distance, up
  /// to the largest on the torus.
  std::vector<std::int32_t> gaussian(double pixels_a_point) const {
    const int half_x = sides_.x / 2, half_y = sides_.y / 2;
    std::vector<std::int32_t> values;
    for (int squared = 0; squared <= half_x * half_x + half_y * half_y; ++squared) {
      const double t = 2.0 * squared / pixels_a_point;
      if (t >= kMostT) break;
      values.push_back(static_cast<std::int32_t>(256.0 * reproducible_exp(-t)));
    }
    return values;
  }
  static int reach(const std::vector<std::int32_t>& by_squared_distance) {
    return static_cast<int>(std::sqrt(static_cast<double>(by_squared_distance.size()))) + 1;
  }

  /// Calls body(number, weight) for what a hole sees, itself included.
  template <class Body>
  void for_each_seen(std::size_t hole, const Body& body) const {
    const Hole& centre = holes_[hole];
    const auto slice = static_cast<std::size_t>(centre.slice);
    const std::size_t first = first_[slice];
    in_slice_[slice].near(centre.at, [&](int number, std::int64_t squared) {
      if (squared < std::ssize(own_slice_))
        body(first + static_cast<std::size_t>(number),
             in_time_[0] * own_slice_[static_cast<std::size_t>(squared)]);
    });
    if (other_slices_.empty()) return;
    everywhere_.near(centre.at, [&](int number, std::int64_t squared) {
      const auto other = static_cast<std::size_t>(number);
      const Hole& seen = holes_[other];
      if (squared >= std::ssize(other_slices_) || seen.slice == centre.slice) return;
      const int distance =
          around(seen.w - centre.w, sides_.w) * sides_.z + around(seen.z - centre.z, sides_.z);
      const std::int32_t in_time = in_time_[static_cast<std::size_t>(distance)];
      body(other, in_time * other_slices_[static_cast<std::size_t>(squared)]);
    });
  }

  const TorusSides sides_;
  const std::vector<std::int32_t>& in_time_;
  const std::vector<Hole>& holes_;
  const Execution& execution_;
  std::vector<std::int32_t> own_slice_, other_slices_;  // by squared distance in a slice
  PointGrid everywhere_{{1, 1}, 1};
  std::vector<PointGrid> in_slice_;
  std::vector<std::size_t> first_;  // hole of each slice
  std::vector<std::int32_t> energy_;
};

}  // namespace

void reorder_last_voxels(Grid<std::uint32_t>& ranks, const VolumeWeights& weights, const VolumeKernel& kernel,
                         const Execution& execution) {
  constexpr int kLeastDistance = 8;
  const TorusSides& sides = weights.sides();
  const std::vector<std::int32_t> in_time = sight_in_time(sides, kernel);
  if (in_time[0] == 0) return;
  const auto area = static_cast<std::uint32_t>(sides.x * sides.y);
  const int apart = std::max(weights.sight(), kLeastDistance);
  std::vector<std::uint32_t> next(static_cast<std::size_t>(ranks.depth()),
                                  area - area / static_cast<std::uint32_t>(apart * apart));
  std::vector<Hole> holes;
  for (int slice = 0; slice < ranks.depth(); ++slice) {
    const auto of_slice = ranks.slice(slice);
    for (std::size_t i = 0; i < of_slice.size(); ++i) {
      if (of_slice[i] >= next[static_cast<std::size_t>(slice)])
        holes.push_back({{static_cast<int>(i) % sides.x, static_cast<int>(i) / sides.x},
                         slice,
                         slice % sides.z,
                         slice / sides.z});
    }
  }
  // Until half of them are filled the kernel stays the same.
  while (!holes.empty()) {
    std::vector<std::size_t> order = Holes(sides, in_time, holes, execution).fill();
    const auto half = static_cast<std::ptrdiff_t>((order.size() + 1) / 2);
    std::for_each(order.begin(), order.begin() + half, [&](std::size_t number) {
      const Hole& hole = holes[number];
      ranks.slice(hole.slice)[static_cast<std::size_t>(hole.at.y * sides.x + hole.at.x)] =
          next[static_cast<std::size_t>(hole.slice)]++;
    });
    order.erase(order.begin(), order.begin() + half);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i) holes[i] = holes[order[i]];
    holes.resize(order.size());
  }
}

}  // namespace bn::noise
