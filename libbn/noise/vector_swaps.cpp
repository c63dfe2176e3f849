// Stream of random_bits: 5, who meets.

#include "noise/vector_swaps.h"

#include <algorithm>

#include "bn/random.h"

namespace bn::noise {
namespace {

constexpr std::uint32_t kMeetStream = 5;
/// Fewer voxels apart than this are no choice of partners.
constexpr int kFewest = 16;
constexpr int kGroup = 320;

int place_of(int block, int blocks, int side) {
  return static_cast<int>(std::int64_t{block} * side / blocks);
}

}  // namespace

SwapRounds::SwapRounds(const VectorKernel& kernel, Shape size, RankScope scope, std::uint64_t seed)
    : size_(size),
      scope_(scope),
      seed_(seed),
      blocks_x_(std::max(1, size.width / (kernel.reach_x() + 1))),
      blocks_y_(std::max(1, size.height / (kernel.reach_y() + 1))),
      count_(blocks_x_ * blocks_y_),
      apart_(count_ >= kFewest) {
  if (!apart_) {
    const std::int64_t voxels = scope == RankScope::slice ? size.slice().area() : size.count();
    count_ = static_cast<int>(std::min<std::int64_t>(voxels, kGroup));
  }
  groups_ = apart_ ? (count_ + kGroup - 1) / kGroup : 1;
}

std::vector<Voxel> SwapRounds::voxels(std::int64_t round) const {
  // Draw 0 is the round's; each voxel, or row of blocks, has one more.
  const auto draw = [&](int which) {
    return random_bits(seed_, kMeetStream,
                       static_cast<std::uint64_t>(round) << 24 | static_cast<unsigned>(which));
  };
  const auto low = [](std::uint64_t bits, int bound) {
    return static_cast<int>(
        random_below(static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bound)));
  };
  const auto high = [&](std::uint64_t bits, int bound) { return low(bits >> 32, bound); };
  const bool in_slice = scope_ == RankScope::slice;
  const int slice = low(draw(0), size_.depth);
  const int y_shift = high(draw(0), size_.height);

  std::vector<Voxel> voxels;
  for (int i = 0; i < count_; ++i) {
    if (apart_) {
      const int row = i / blocks_x_;
      const int x = place_of(i % blocks_x_, blocks_x_, size_.width) + low(draw(1 + row), size_.width);
      const int y = place_of(row, blocks_y_, size_.height) + y_shift;
      const int z = in_slice ? slice : low(draw(1 + blocks_y_ + i), size_.depth);
      voxels.push_back({x % size_.width, y % size_.height, z});
    } else {
      // One from each of as many equal stretches of all voxels.
      const std::int64_t all = in_slice ? size_.slice().area() : size_.count();
      const std::int64_t first = all * i / count_;
      const std::int64_t at = first + low(draw(1 + i), static_cast<int>(all * (i + 1) / count_ - first));
      const std::int64_t in_plane = at % size_.slice().area();
      const int z = in_slice ? slice : static_cast<int>(at / size_.slice().area());
      voxels.push_back(
          {static_cast<int>(in_plane % size_.width), static_cast<int>(in_plane / size_.width), z});
    }
  }
  return voxels;
}

std::vector<int> partners(std::span<const float> far, int of, std::size_t stride) {
  const auto count = static_cast<std::size_t>(of);
  // What both gain, where voxels i and j exchange their values, by i * count + j.
  std::vector<float> gains(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      gains[i * count + j] = gains[j * count + i] =
          (far[i * stride + j] - far[i * stride + i]) + (far[j * stride + i] - far[j * stride + j]);
    }
  }
  std::vector<int> partner(count);
  for (std::size_t i = 0; i < count; ++i) partner[i] = static_cast<int>(i);
  const auto is_free = [&](std::size_t i) { return partner[i] == static_cast<int>(i); };
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_free(i)) continue;
    float most = 0.0f;
    std::size_t best = i;
    for (std::size_t j = 0; j < count; ++j) {
      if (gains[i * count + j] > most && is_free(j)) {
        most = gains[i * count + j];
        best = j;
      }
    }
    partner[i] = static_cast<int>(best);
    partner[best] = static_cast<int>(i);
  }
  return partner;
}

std::int64_t exchange_gain(const VectorField& field, const VectorKernel& kernel, Voxel a, Voxel b) {
  const ScaledVector of_a = field.value(field.index(a));
  const ScaledVector of_b = field.value(field.index(b));
  // Where they see each other, each sum has taken what is between them for lost. It stays.
  const std::int64_t kept = 2 * std::int64_t{kernel.weight(b.x - a.x, b.y - a.y, b.z - a.z)} *
                            unlikeness(of_a, of_b, field.components(), field.unlikeness());
  return gain(field, kernel, a, of_a, of_b) + gain(field, kernel, b, of_b, of_a) + kept;
}

namespace {

/// The memory of rounds, and what they do.
class Exchange {
 public:
  Exchange(VectorField& field, const VectorKernel& kernel, const SwapRounds& rounds, VectorValues values)
      : field_(field),
        kernel_(kernel),
        rounds_(rounds),
        middles_(cell_middles(values)),
        shift_(cell_shift(kernel)) {
    groups_.resize(static_cast<std::size_t>(rounds.groups()));
  }

  void make(std::int64_t round, const Execution& execution) {
    voxels_ = rounds_.voxels(round);
    const auto in_groups = [&](auto what) {
      parallel_for(execution, rounds_.groups(), [&](std::int64_t group) { what(static_cast<int>(group)); });
    };
    in_groups([&](int group) { tabulate(group); });
    // Parts of groups, so that there is work for all threads.
    const auto parts = static_cast<std::int64_t>(rounds_.groups()) * kParts;
    const auto in_parts = [&](auto what) {
      parallel_for(execution, parts, [&](std::int64_t part) {
        Group& group = groups_[static_cast<std::size_t>(part / kParts)];
        const std::size_t count = group.values.size();
        const auto at = static_cast<std::size_t>(part % kParts);
        what(group, count * at / kParts, count * (at + 1) / kParts);
      });
    };
    in_parts([&](Group& group, std::size_t begin, std::size_t end) { look_around(group, begin, end); });
    in_groups([&](int number) {
      Group& group = groups_[static_cast<std::size_t>(number)];
      group.partner = partners(group.far, static_cast<int>(group.values.size()), group.stride);
      if (!rounds_.apart()) decide(group, 0, group.values.size());
    });
    if (rounds_.apart()) {
      in_parts([&](Group& group, std::size_t begin, std::size_t end) { decide(group, begin, end); });
    }
  }

 private:
  static constexpr int kParts = 8;

  struct Group {
    std::size_t first;  // of the round's voxels
    std::vector<ScaledVector> values;
    std::size_t stride;
    std::vector<float> distances, seen, far;
    std::vector<int> partner;
  };

  void tabulate(int number) {
    Group& group = groups_[static_cast<std::size_t>(number)];
    group.first = static_cast<std::size_t>(rounds_.first(number));
    const auto count = static_cast<std::size_t>(rounds_.first(number + 1)) - group.first;
    group.values.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      group.values[i] = field_.value(field_.index(voxels_[group.first + i]));
    const ValueTable table(group.values);
    group.stride = table.stride();
    group.distances.resize(kCells * group.stride);
    group.seen.resize(count * kCells);
    group.far.resize(count * group.stride);
    distances_from_cells(middles_, table, field_, group.distances);
  }

  void look_around(Group& group, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      add_up_cells(field_, kernel_, voxels_[group.first + i], shift_,
                   std::span<float, kCells>(group.seen.data() + i * kCells, std::size_t{kCells}));
    }
    estimate(std::span(group.seen).subspan(begin * kCells, (end - begin) * kCells), group.distances,
             static_cast<int>(group.values.size()), group.stride,
             std::span(group.far).subspan(begin * group.stride));
  }

  void decide(Group& group, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto j = static_cast<std::size_t>(group.partner[i]);
      if (j <= i) continue;
      const Voxel a = voxels_[group.first + i];
      const Voxel b = voxels_[group.first + j];
      if (exchange_gain(field_, kernel_, a, b) > 0) field_.exchange(field_.index(a), field_.index(b));
    }
  }

  VectorField& field_;
  const VectorKernel& kernel_;
  const SwapRounds& rounds_;
  std::vector<ScaledVector> middles_;
  int shift_;
  std::vector<Voxel> voxels_;
  std::vector<Group> groups_;
};

}  // namespace

void exchange_values(VectorField& field, const VectorKernel& kernel, const VectorMaskOptions& options,
                     const Execution& execution, ProgressMeter& meter) {
  if (kernel.columns().empty()) return;
  const SwapRounds rounds(kernel, field.size(), options.mask.ranks, options.mask.seed);
  if (rounds.count() < 2) return;
  Exchange exchange(field, kernel, rounds, options.values);
  const std::int64_t visits = options.budget * field.size().count();
  for (std::int64_t round = 0; round * rounds.count() < visits; ++round) {
    throw_if_stopped(execution);
    exchange.make(round, execution);
    meter.advance(static_cast<std::uint64_t>(rounds.count()));
  }
}

}  // namespace bn::noise
