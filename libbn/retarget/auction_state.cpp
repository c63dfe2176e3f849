#include "retarget/auction_state.h"

namespace bn::retarget {

template <class T>
AuctionState<T>::AuctionState(const MaskLevels& levels, const RetargetOptions& options)
    : layout(levels.size(), reach_rows(levels.size(), options), options.wrap),
      window(reach_rows(levels.size(), options)),
      square(options.metric == Metric::l2),
      row_level(static_cast<std::size_t>(layout.cells())),
      column_level(row_level.size()),
      price(row_level.size(), options.wrap ? T{0} : kBlocked),
      assignee(row_level.size(), Assignee{kUnassigned, 0}),
      column_of(row_level.size(), kUnassigned) {
  const Grid<std::int32_t> from =
      shifted(levels.from, -std::int64_t{options.step.x}, -std::int64_t{options.step.y});
  const Grid<std::int32_t> onto = shifted(levels.to, options.motion.x, options.motion.y);
  layout.for_each_pixel([&](std::int32_t cell, int x, int y) {
    row_level[static_cast<std::size_t>(cell)] = from(x, y);
    layout.store(column_level, cell, onto(x, y));
    price[static_cast<std::size_t>(cell)] = T{0};
  });
}

template <class T>
void AuctionState<T>::find_columns() {
  std::fill(column_of.begin(), column_of.end(), kUnassigned);
  layout.for_each_pixel([&](std::int32_t column, int, int) {
    const std::int32_t row = assignee[static_cast<std::size_t>(column)].row;
    if (row != kUnassigned) column_of[static_cast<std::size_t>(row)] = column;
  });
}

template <class T>
void AuctionState<T>::refine(int level_factor) {
  for (std::int32_t& level : row_level) level *= level_factor;
  for (Assignee& h : assignee) h.level *= level_factor;
  for (std::int32_t& level : column_level) level *= level_factor;
}

template <class T>
void AuctionState<T>::coarsen(int level_divisor) {
  for (std::int32_t& level : row_level) level /= level_divisor;
  for (Assignee& h : assignee) h.level /= level_divisor;
  for (std::int32_t& level : column_level) level /= level_divisor;
  for (T& p : price) {
    if (p != kBlocked) p = (p + kPriceScale / 2) >> kPriceScaleBits;
  }
}

template <class T>
std::vector<std::int64_t> AuctionState<T>::pixel_prices() const {
  std::vector<std::int64_t> prices;
  prices.reserve(static_cast<std::size_t>(layout.size().area()));
  layout.for_each_pixel(
      [&](std::int32_t cell, int, int) { prices.push_back(price[static_cast<std::size_t>(cell)]); });
  return prices;
}

template <class T>
Grid<Offset> AuctionState<T>::moves(const RetargetOptions& options) const {
  const auto [width, height] = layout.size();
  Grid<Offset> move(layout.size());
  for (int y = 0; y < height; ++y) {
    const int q_y = wrap(std::int64_t{y} + options.step.y, height);
    for (int x = 0; x < width; ++x) {
      const int q_x = wrap(std::int64_t{x} + options.step.x, width);
      const std::int32_t column = column_of[static_cast<std::size_t>(layout.cell(q_x, q_y))];
      const Offset w = layout.position(column);
      Offset k{w.x - q_x, w.y - q_y};
      if (layout.wrapped()) k = {wrap_centred(k.x, width), wrap_centred(k.y, height)};
      move(x, y) = {k.x + options.motion.x, k.y + options.motion.y};
    }
  }
  return move;
}

template struct AuctionState<std::int32_t>;
template struct AuctionState<std::int64_t>;

}  // namespace bn::retarget
