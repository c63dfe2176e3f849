// The retarget problem as a sparse linear assignment problem.
//
// Rows are seeds, columns the pixels they land on, both in the coordinates of problem.h. Row q may take the
// columns q + k of its window, at cost(A(q), B(q + k)); nothing is stored per arc. Columns carry prices. By
// weak duality every perfect assignment costs at least
//     sum over rows of min over columns of (cost + price)  -  sum over columns of price,
// with equality iff each row has a column that is cheapest for it: such an assignment is optimal, and the
// prices prove it.
//
// Three steps, one file each:
//   auction.cpp         finds a nearly optimal assignment, fast, with prices in 1/16 of a unit of cost;
//   shortest_paths.cpp  rounds the prices to integers, frees the rows that violate complementary
//                       slackness, and assigns them again by shortest augmenting paths: exact;
//   certificate.cpp     computes the bound afresh from the definition.
// The answer is right whatever the auction leaves behind; the auction only makes it quick.

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "retarget/auction_state.h"

namespace bn::retarget {

enum class Outcome {
  done,        ///< every row has a column
  incomplete,  ///< gave up on some rows (auction only)
  overflow,    ///< a price passed the limit; the state is of no more use
};

/// One level of the auction: on return each assigned row's column is within `epsilon` (raised where a price
/// war would take too long; the value used comes back) of its cheapest.
struct AuctionLevel {
  Outcome outcome;
  std::int64_t epsilon;
};
/// Reports the tile's area as finished work.
template <class T>
AuctionLevel run_auction(AuctionState<T>& state, std::int64_t epsilon, const Execution& execution,
                         ProgressMeter& progress);

/// Frees every row whose column is not its cheapest, then completes the assignment, optimally.
template <class T>
Outcome complete_by_shortest_paths(AuctionState<T>& state, const Execution& execution);

/// The bound that prices (by pixel index, in units of cost / 2^scale_bits) prove for every permutation
/// within reach, rounded up to a whole energy. From the definition alone, in exact integers.
std::int64_t certified_lower_bound(const MaskLevels& levels, const RetargetOptions& options,
                                   const std::vector<std::int64_t>& price, int scale_bits);

/// Which integers carry prices; both give the same result.
enum class PriceWidth { automatic, bits32, bits64 };

/// solve_retarget() with the width chosen, for tests; throws over_limit where bits32 do not suffice.
RetargetTile solve_with_width(const MaskLevels& levels, const RetargetOptions& options,
                              const Execution& execution, PriceWidth width);

}  // namespace bn::retarget
