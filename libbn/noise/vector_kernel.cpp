#include "noise/vector_kernel.h"

#include <algorithm>
#include <cstdlib>

namespace bn::noise {

VectorKernel::VectorKernel(const VolumeWeights& weights) : sides_(weights.sides()), slices_(sides_.z) {
  const auto greatest = [&](int dx, int dy) {
    auto line = weights.line(dx, dy);
    if (dx == 0 && dy == 0) line = line.subspan(1);
    return line.empty() ? 0 : *std::max_element(line.begin(), line.end());
  };
  std::int32_t top = 0;
  for (int dy = 0; dy <= weights.reach_y(); ++dy) {
    for (int dx = 0; dx <= weights.reach_x(); ++dx) top = std::max(top, greatest(dx, dy));
  }
  const auto is_seen = [&](int dx, int dy) {
    const std::int32_t most = greatest(dx, dy);
    return most > 0 && most * kLeastShare >= top;
  };
  for (int dy = 0; dy <= weights.reach_y(); ++dy) {
    for (int dx = 0; dx <= weights.reach_x(); ++dx) {
      if (!is_seen(dx, dy)) continue;
      reach_x_ = std::max(reach_x_, dx);
      reach_y_ = std::max(reach_y_, dy);
    }
  }
  // A side that the reach spans has each distance once.
  const auto last = [](int reach, int side) { return 2 * reach == side ? reach - 1 : reach; };
  column_at_.assign(static_cast<std::size_t>((2 * reach_x_ + 1) * (2 * reach_y_ + 1)), -1);
  for (int dy = -reach_y_; dy <= last(reach_y_, sides_.y); ++dy) {
    for (int dx = -reach_x_; dx <= last(reach_x_, sides_.x); ++dx) {
      if (!is_seen(std::abs(dx), std::abs(dy))) continue;
      column_at_[static_cast<std::size_t>((dy + reach_y_) * (2 * reach_x_ + 1) + dx + reach_x_)] =
          static_cast<std::int32_t>(columns_.size());
      columns_.push_back({dx, dy, lines_.size()});
      std::vector<std::int32_t> line(weights.line(dx, dy).begin(), weights.line(dx, dy).end());
      if (dx == 0 && dy == 0) line[0] = 0;
      for (const std::int32_t weight : line) sum_ += weight;
      for (int copy = 0; copy < 2; ++copy) lines_.insert(lines_.end(), line.begin(), line.end());
    }
  }
  lines_.resize(lines_.size() + kMostLanes);
}

std::uint64_t VectorKernel::bytes(const TorusSides& sides, const VolumeKernel& kernel) {
  // VolumeWeights has a quarter of the columns, each once.
  return 9 * VolumeWeights::bytes(sides, kernel);
}

std::int32_t VectorKernel::weight(int dx, int dy, int dz) const {
  dx = wrap_centred(dx, sides_.x);
  dy = wrap_centred(dy, sides_.y);
  if (std::abs(dx) > reach_x_ || std::abs(dy) > reach_y_) return 0;
  const std::int32_t column =
      column_at_[static_cast<std::size_t>((dy + reach_y_) * (2 * reach_x_ + 1) + dx + reach_x_)];
  if (column < 0) return 0;
  return lines_[columns_[static_cast<std::size_t>(column)].line +
                static_cast<std::size_t>(wrap(dz, slices_))];
}

}  // namespace bn::noise
