// The certificate: what a set of prices proves, computed from the definition of the problem in 64-bit
// integers. It shares neither storage nor code with the solver, so an error there cannot certify itself.
//
//     bound = sum over rows q of min over k of (cost(A(q), B(q + k)) + price(q + k))  -  sum of all prices
//
// Any prices give a valid bound. Rows of pixels are handled together: for each displacement k one
// contiguous pass lowers the running minima.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "retarget/certificate.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "retarget/assignment.h"

HWY_BEFORE_NAMESPACE();
namespace bn::retarget {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// least[i] = min(least[i], scale * cost(a[i], b[i]) + price[i])
void LowerMinima(std::int64_t* least, const std::int64_t* a, const std::int64_t* b, const std::int64_t* price,
                 std::size_t count, Metric metric, int scale_bits) {
  const hn::ScalableTag<std::int64_t> d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto difference = hn::Sub(hn::LoadU(d, a + i), hn::LoadU(d, b + i));
    const auto cost =
        metric == Metric::l2 ? hn::Mul(difference, difference) : hn::Max(difference, hn::Neg(difference));
    const auto value = hn::Add(hn::ShiftLeftSame(cost, scale_bits), hn::LoadU(d, price + i));
    hn::StoreU(hn::Min(hn::LoadU(d, least + i), value), d, least + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace bn::retarget
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bn::retarget {

HWY_EXPORT(LowerMinima);

namespace {

constexpr std::size_t kMostLanes = 8;
constexpr std::int64_t kNothing = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kBlocked = std::int64_t{1} << 62;

/// A line of an array with columns -before..width+after-1: wrapped, or `blocked` beyond the border.
template <class T>
void copy_line(const T* line, int width, int before, int after, bool wrapped, std::int64_t blocked,
               std::vector<std::int64_t>& to) {
  for (int x = -before; x < width + after; ++x) {
    const bool inside = x >= 0 && x < width;
    to[static_cast<std::size_t>(x + before)] = inside    ? std::int64_t{line[x]}
                                               : wrapped ? std::int64_t{line[wrap(x, width)]}
                                                         : blocked;
  }
}

}  // namespace

std::int64_t certified_lower_bound(const MaskLevels& levels, const RetargetOptions& options,
                                   const std::vector<std::int64_t>& price, int scale_bits) {
  const auto [width, height] = levels.size();
  const Grid<std::int32_t> from =
      shifted(levels.from, -std::int64_t{options.step.x}, -std::int64_t{options.step.y});
  const Grid<std::int32_t> onto = shifted(levels.to, options.motion.x, options.motion.y);
  const std::vector<ReachRow> window = reach_rows(levels.size(), options);
  int before = 0, after = 0;
  for (const ReachRow& row : window) {
    before = std::max(before, -row.x_low);
    after = std::max(after, row.x_high);
  }
  const auto padded = static_cast<std::size_t>(before + width + after) + kMostLanes;
  std::vector<std::int64_t> least(padded), from_line(padded), onto_line(padded), price_line(padded);

  __extension__ __int128 bound = 0;  // sums of prices may pass 64 bits; the bound itself does not
  for (int y = 0; y < height; ++y) {
    std::fill(least.begin(), least.end(), kNothing);
    copy_line(&from(0, y), width, 0, 0, true, 0, from_line);
    for (const ReachRow& row : window) {
      int to_y = y + row.y;
      if (!options.wrap && (to_y < 0 || to_y >= height)) continue;
      to_y = wrap(to_y, height);
      copy_line(&onto(0, to_y), width, before, after, true, 0, onto_line);
      copy_line(price.data() + static_cast<std::size_t>(to_y) * width, width, before, after, options.wrap,
                kBlocked, price_line);
      for (int x = row.x_low; x <= row.x_high; ++x) {
        HWY_DYNAMIC_DISPATCH(LowerMinima)
        (least.data(), from_line.data(), onto_line.data() + before + x, price_line.data() + before + x,
         static_cast<std::size_t>(width), options.metric, scale_bits);
      }
    }
    for (int x = 0; x < width; ++x) bound += least[static_cast<std::size_t>(x)];
  }
  for (const std::int64_t p : price) bound -= p;
  // Energies are whole, so a fraction of a unit rounds up.
  return -static_cast<std::int64_t>(-bound >> scale_bits);
}

}  // namespace bn::retarget
#endif
