#include "noise/column_field.h"

#include <algorithm>
#include <map>

namespace bn::noise {

// Small enough for shallow volumes, else whole vectors of the common widths.
template <class Lane>
int column_stride(int slices) {
  const int unit = slices > 8 ? 16 : 8;
  return (slices + unit - 1) / unit * unit;
}

template <class Lane>
ColumnField<Lane>::ColumnField(Extent columns, int slices)
    : base(static_cast<std::size_t>(columns.area())),
      least(static_cast<std::size_t>(columns.area())),
      columns_(columns),
      slices_(slices),
      stride_(column_stride<Lane>(slices)) {
  constexpr std::size_t kLanesInLine = sizeof(CacheLine) / sizeof(Lane);
  const std::size_t lanes_needed = least.size() * static_cast<std::size_t>(stride_);
  memory_.resize((lanes_needed + kLanesInLine - 1) / kLanesInLine);
  for (std::int64_t i = 0; i < columns.area(); ++i) {
    std::fill(column(i) + slices, column(i) + stride_, Lanes<Lane>::kSet);
  }
}

template <class Lane>
std::uint64_t ColumnField<Lane>::bytes(Extent columns, int slices) {
  const auto stride = static_cast<std::uint64_t>(column_stride<Lane>(slices));
  return static_cast<std::uint64_t>(columns.area()) * (stride * sizeof(Lane) + 2 * sizeof(std::int32_t)) + 64;
}

template <class Lane>
void ColumnField<Lane>::update_least(std::int64_t index) {
  const Lane lane = *std::min_element(column(index), column(index) + slices_);
  const auto at = static_cast<std::size_t>(index);
  least[at] = lane >= Lanes<Lane>::kSet ? kFullColumn : base[at] + lane;
}

template <class Lane>
ColumnKernel<Lane>::ColumnKernel(const VolumeWeights& weights)
    : inner_(weights.sides().w == 1 ? 1 : weights.sides().z),
      outer_(weights.slices() / inner_),
      variant_stride_(2 * weights.slices() + column_stride<Lane>(weights.slices())) {
  // A side that the reach spans has each distance once.
  const auto last = [](int reach, int side) { return 2 * reach == side ? reach - 1 : reach; };
  first_x = -weights.reach_x();
  last_x = last(weights.reach_x(), weights.sides().x);
  first_y = -weights.reach_y();
  last_y = last(weights.reach_y(), weights.sides().y);

  struct Line {
    std::uint32_t entry;
    bool in_slice;
    bool empty;
  };
  std::map<std::vector<std::int32_t>, Line> known;  // most lines occur at (dx, dy) and at (dy, dx)
  const auto line_at = [&](int dx, int dy) {
    const std::span<const std::int32_t> line = weights.line(dx, dy);
    const auto [found, is_new] = known.try_emplace(std::vector<std::int32_t>(line.begin(), line.end()));
    if (is_new) {
      const bool in_slice = std::all_of(line.begin() + 1, line.end(), [](std::int32_t w) { return w == 0; });
      const bool empty = in_slice && line[0] == 0;
      const std::uint32_t entry = in_slice ? static_cast<std::uint32_t>(line[0])
                                           : add_line(line, column_stride<Lane>(weights.slices()));
      found->second = {entry, in_slice, empty};
    }
    return found->second;
  };
  for (int dy = first_y; dy <= last_y; ++dy) {
    bool open = false;
    for (int dx = first_x; dx <= last_x; ++dx) {
      const Line line = line_at(dx, dy);
      if (line.empty) {
        open = false;
        continue;
      }
      if (!open || segments_.back().in_slice != line.in_slice) {
        segments_.push_back({dy, dx, 0, line.in_slice, entries_.size()});
        open = true;
      }
      ++segments_.back().count;
      entries_.push_back(line.entry);
    }
  }
}

template <class Lane>
std::uint32_t ColumnKernel<Lane>::add_line(std::span<const std::int32_t> line, int stride) {
  const std::size_t entry = lines_.size();
  const int slices = inner_ * outer_;
  lines_.resize(entry + static_cast<std::size_t>(inner_ * variant_stride_));
  Lane* to = lines_.data() + entry;
  for (int inner = 0; inner < inner_; ++inner, to += variant_stride_) {
    for (int i = 0; i < 2 * slices + stride; ++i) {
      const int from = i / inner_ % outer_ * inner_ + wrap(i % inner_ - inner, inner_);
      to[i] = static_cast<Lane>(line[static_cast<std::size_t>(from)]);
    }
  }
  return static_cast<std::uint32_t>(entry);
}

template int column_stride<std::uint16_t>(int);
template int column_stride<std::int32_t>(int);
template class ColumnField<std::uint16_t>;
template class ColumnField<std::int32_t>;
template class ColumnKernel<std::uint16_t>;
template class ColumnKernel<std::int32_t>;

}  // namespace bn::noise
