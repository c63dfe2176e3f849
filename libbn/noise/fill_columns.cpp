// Filling the largest voids of a volume, in any order that gives what one at a time would give.
//
// The rule is that of fill_tile.cpp: energies only grow, so a voxel that is the least (energy, index) of all
// unset voxels in its reach may be set at once, and sorting by (energy when set, index) restores the
// sequential order. Here columns are asked: a column's least voxel *leads* if it comes before the least
// voxels of all columns in the reach of the kernel.
//
// Leading voxels are found by walking downhill. From a start one goes to the least voxel in its reach, from
// there to the least in that one's reach, and so on; energies fall along the way, so it ends at a voxel that
// leads. That is set, and the one before, which waited for it, looks again. Each look either sets a voxel or
// adds one to the way that will be set, so there are two looks a voxel, and they are at columns that the last
// additions have brought into the cache. A way goes wherever it must, so no thread has to
// wait for another; one that comes to where another thread stays at work is given up, and tried again later.
//
// Invariant. The keys (energy, index) along the way fall, and those further back can only have grown since;
// so no column is on it twice.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/fill_columns.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "noise/add_column-inl.h"
#include "noise/fill_columns.h"

HWY_BEFORE_NAMESPACE();
namespace bn::noise {
namespace HWY_NAMESPACE {
namespace {

struct Column {
  int x;
  int y;
  friend bool operator==(const Column&, const Column&) = default;
};

/// Looks for the least voxels around columns.
class Surroundings {
 public:
  template <class Kernel>
  Surroundings(Extent columns, const Kernel& kernel)
      : columns_(columns),
        first_x_(kernel.first_x),
        first_y_(kernel.first_y),
        width_(kernel.last_x - kernel.first_x + 1),
        height_(kernel.last_y - kernel.first_y + 1),
        copy_stride_(std::max(width_, kLanes)),
        copy_(static_cast<std::size_t>(copy_stride_ * height_), kFullColumn),
        least_of_rows_(static_cast<std::size_t>(kLanes * height_)) {}

  /// Shows the columns that (x, y) has in reach. Valid until they change.
  HWY_INLINE void look(const std::int32_t* least, Column c) {
    x_ = c.x + first_x_;
    y_ = c.y + first_y_;
    if (x_ >= 0 && y_ >= 0 && x_ + width_ <= columns_.width && y_ + height_ <= columns_.height &&
        width_ >= kLanes) {
      view_ = least + std::int64_t{y_} * columns_.width + x_;
      stride_ = columns_.width;
    } else {
      copy(least);
    }
  }

  HWY_INLINE std::int32_t least() {
    const D d;
    auto least = hn::Set(d, kFullColumn);
    const std::int32_t* row = view_;
    for (int y = 0; y < height_; ++y, row += stride_) {
      auto of_row = hn::LoadU(d, row + last_vector());
      for (int x = 0; x < width_ - kLanes; x += kLanes) of_row = hn::Min(of_row, hn::LoadU(d, row + x));
      hn::StoreU(of_row, d, least_of_row(y));
      least = hn::Min(least, of_row);
    }
    return hn::GetLane(hn::MinOfLanes(d, least));
  }

  /// Calls body(column) for the columns whose least energy is `energy`, row by row, until it returns true.
  /// Some may come twice. Call least() before.
  template <class Body>
  HWY_INLINE void find(std::int32_t energy, const Body& body) {
    const D d;
    const auto wanted = hn::Set(d, energy);
    const std::int32_t* row = view_;
    for (int y = 0; y < height_; ++y, row += stride_) {
      if (HWY_LIKELY(hn::AllFalse(d, hn::Eq(hn::LoadU(d, least_of_row(y)), wanted)))) continue;
      for (int x = 0;; x += kLanes) {
        x = std::min(x, last_vector());
        if (HWY_UNLIKELY(!hn::AllFalse(d, hn::Eq(hn::LoadU(d, row + x), wanted)))) {
          for (int i = x; i < x + kLanes && i < width_; ++i) {
            if (row[i] == energy &&
                body(Column{wrap_once(x_ + i, columns_.width), wrap_once(y_ + y, columns_.height)}))
              return;
          }
        }
        if (x == last_vector()) break;
      }
    }
  }

 private:
  using D = hn::CappedTag<std::int32_t, 8>;
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

  std::int32_t* least_of_row(int y) { return least_of_rows_.data() + y * kLanes; }
  int last_vector() const { return std::max(width_ - kLanes, 0); }
  static int wrap_once(int value, int period) {
    return value < 0 ? value + period : value >= period ? value - period : value;
  }

  /// Across a seam, or less than a vector wide.
  HWY_NOINLINE void copy(const std::int32_t* least) {
    std::int32_t* to = copy_.data();
    for (int y = 0; y < height_; ++y, to += copy_stride_) {
      const std::int32_t* row = least + std::int64_t{wrap_once(y_ + y, columns_.height)} * columns_.width;
      const int from = wrap_once(x_, columns_.width);
      const int until_seam = std::min(width_, columns_.width - from);
      std::copy_n(row + from, until_seam, to);
      std::copy_n(row, width_ - until_seam, to + until_seam);
    }
    view_ = copy_.data();
    stride_ = copy_stride_;
  }

  const Extent columns_;
  const int first_x_, first_y_;
  const int width_, height_;
  const int copy_stride_;
  std::vector<std::int32_t> copy_;
  std::vector<std::int32_t> least_of_rows_;  // the least in every kLanes-th column, a vector a row
  const std::int32_t* view_ = nullptr;
  std::ptrdiff_t stride_ = 0;
  int x_ = 0, y_ = 0;  // of the upper left column, perhaps outside the torus
};

template <class D>
class ColumnFiller {
 public:
  using Lane = hn::TFromD<D>;

  explicit ColumnFiller(const ColumnJob<Lane>& job)
      : job_(job),
        field_(job.field),
        adder_(job.field, job.kernel),
        around_(job.field.columns(), job.kernel),
        held_(job.locks) {}

  void run() {
    bool is_full = false;
    for (std::int32_t limit = 0; !is_full && limit < job_.end;) {
      limit = std::min(limit, job_.end - job_.step) + job_.step;
      is_full = true;
      for (int first = 0; first < job_.rows.count; first += kBandRows) {
        const int count = std::min(kBandRows, job_.rows.count - first);
        is_full &= fill_band({job_.rows.first + first, count}, limit);
        held_.release();
        tell();
      }
    }
  }

 private:
  /// Bands follow each other in the cache.
  static constexpr int kBandRows = 8;
  /// A millisecond's work or two.
  static constexpr std::int64_t kMostUntold = 1024;

  void tell() { job_.progress(std::exchange(set_, 0)); }

  /// Sets the voxels below the limit, where no other thread is at work; whether all columns are full.
  bool fill_band(RowRange rows, std::int32_t limit) {
    bool is_full = true;
    for (int y = rows.first; y < rows.first + rows.count; ++y) {
      for (int x = 0; x < field_.columns().width; ++x) is_full &= force({x, y}, limit);
    }
    return is_full;
  }

  std::int64_t index(Column c) const { return std::int64_t{c.y} * field_.columns().width + c.x; }
  std::int32_t least(Column c) const { return field_.least[static_cast<std::size_t>(index(c))]; }

  /// Sets the voxels of a column below the limit, and what must come before them; whether the column is full.
  bool force(Column start, std::int32_t limit) {
    if (!held_.wait_for(start.y)) return false;
    if (least(start) >= limit) return least(start) == kFullColumn;
    way_.assign(1, start);
    while (!way_.empty()) {
      if (!held_.wait_for(way_.back().y)) return false;
      const Column last = way_.back();
      if (least(last) >= limit) {
        way_.pop_back();
        continue;
      }
      const Column first = first_in_reach(last);
      if (first != last) {
        way_.push_back(first);
      } else {
        set(last);
        if (set_ == kMostUntold) tell();
        if (way_.size() > 1) way_.pop_back();
      }
    }
    return least(start) == kFullColumn;
  }

  /// The column in reach whose least voxel comes first, or one whose least voxel comes before that of `c`.
  HWY_INLINE Column first_in_reach(Column c) {
    around_.look(field_.least.data(), c);
    const std::int32_t energy = around_.least();
    Column found = c;
    if (energy < least(c)) {
      around_.find(energy, [&](Column other) {
        found = other;
        return true;
      });
      return found;
    }
    around_.find(energy, [&](Column other) {
      if (HWY_UNLIKELY(other != found) && before(other, found)) found = other;
      return false;
    });
    return found;
  }

  /// Of two columns of the same least energy, whether the first has it at the lower index.
  HWY_NOINLINE bool before(Column a, Column b) const {
    const int slice_a = least_slice(a);
    const int slice_b = least_slice(b);
    if (slice_a != slice_b) return slice_a < slice_b;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  }

  HWY_INLINE int least_slice(Column c) const {
    const auto at = static_cast<std::size_t>(index(c));
    return adder_.find_slice(index(c), static_cast<Lane>(field_.least[at] - field_.base[at]));
  }

  HWY_INLINE void set(Column c) {
    const int slice = least_slice(c);
    const std::int64_t at = index(c);
    job_.energy_when_set[slice * field_.columns().area() + at] = static_cast<std::uint32_t>(least(c));
    field_.column(at)[slice] = Lanes<Lane>::kSet;
    adder_.add(c.x, c.y, slice);
    adder_.update(at);
    ++set_;
  }

  const ColumnJob<Lane>& job_;
  ColumnField<Lane>& field_;
  ColumnAdder<D> adder_;
  Surroundings around_;
  RowLocks::Holder held_;
  std::int64_t set_ = 0;
  std::vector<Column> way_;
};

/// Of the places in the field of a voxel from slices of half the size, the one of least energy.
template <class Lane>
Voxel least_of_four(const ColumnField<Lane>& field, const Voxel& v) {
  const auto [width, height] = field.columns();
  const auto along = [](int at, int second, int side) {
    return static_cast<int>((2 * std::int64_t{at} + second) * side / (2 * std::max(side / 2, 1)));
  };
  Voxel best{};
  std::int32_t least = kFullColumn;
  for (int i = 0; i < 4; ++i) {
    const Voxel place{along(v.x, i % 2, width), along(v.y, i / 2, height), v.z};
    const std::int32_t energy = field.energy(std::int64_t{place.y} * width + place.x, place.z);
    if (energy >= least) continue;
    least = energy;
    best = place;
  }
  return best;
}

template <class D>
struct VectorsOf {
  using Lane = hn::TFromD<D>;
  static void fill(const ColumnJob<Lane>& job) { ColumnFiller<D>(job).run(); }
  static std::vector<Voxel> set(ColumnField<Lane>& field, const ColumnKernel<Lane>& kernel,
                                std::span<const Voxel> voxels) {
    ColumnAdder<D> adder(field, kernel);
    std::vector<Voxel> places;
    for (const Voxel& of_half : voxels) {
      const Voxel v = least_of_four(field, of_half);
      places.push_back(v);
      const std::int64_t at = std::int64_t{v.y} * field.columns().width + v.x;
      field.column(at)[v.z] = Lanes<Lane>::kSet;
      adder.add(v.x, v.y, v.z);
      adder.update(at);
    }
    return places;
  }
};

/// Calls body with the widest vectors that divide the stride.
template <class Body>
auto with_16_bit_vectors(int stride, const Body& body) {
  if (stride % 32 == 0) return body(VectorsOf<hn::CappedTag<std::uint16_t, 32>>());
  if (stride % 16 == 0) return body(VectorsOf<hn::CappedTag<std::uint16_t, 16>>());
  return body(VectorsOf<hn::CappedTag<std::uint16_t, 8>>());
}
using Vectors32 = VectorsOf<hn::CappedTag<std::int32_t, 8>>;

void fill_16_bits_here(const ColumnJob<std::uint16_t>& job) {
  with_16_bit_vectors(job.field.stride(), [&](auto vectors) { vectors.fill(job); });
}

void fill_32_bits_here(const ColumnJob<std::int32_t>& job) { Vectors32::fill(job); }

std::vector<Voxel> set_16_bits_here(ColumnField<std::uint16_t>& field,
                                    const ColumnKernel<std::uint16_t>& kernel,
                                    std::span<const Voxel> voxels) {
  return with_16_bit_vectors(field.stride(),
                             [&](auto vectors) { return vectors.set(field, kernel, voxels); });
}

std::vector<Voxel> set_32_bits_here(ColumnField<std::int32_t>& field,
                                    const ColumnKernel<std::int32_t>& kernel, std::span<const Voxel> voxels) {
  return Vectors32::set(field, kernel, voxels);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace bn::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn::noise {
namespace {
HWY_EXPORT(fill_16_bits_here);
HWY_EXPORT(fill_32_bits_here);
HWY_EXPORT(set_16_bits_here);
HWY_EXPORT(set_32_bits_here);
}  // namespace

void fill_columns(const ColumnJob<std::uint16_t>& job) { HWY_DYNAMIC_DISPATCH(fill_16_bits_here)(job); }
void fill_columns(const ColumnJob<std::int32_t>& job) { HWY_DYNAMIC_DISPATCH(fill_32_bits_here)(job); }

std::vector<Voxel> set_voxels(ColumnField<std::uint16_t>& field, const ColumnKernel<std::uint16_t>& kernel,
                              std::span<const Voxel> voxels) {
  return HWY_DYNAMIC_DISPATCH(set_16_bits_here)(field, kernel, voxels);
}
std::vector<Voxel> set_voxels(ColumnField<std::int32_t>& field, const ColumnKernel<std::int32_t>& kernel,
                              std::span<const Voxel> voxels) {
  return HWY_DYNAMIC_DISPATCH(set_32_bits_here)(field, kernel, voxels);
}

}  // namespace bn::noise
#endif  // HWY_ONCE
