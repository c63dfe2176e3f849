// Parallel tempering: chains at constant temperatures, a ladder, whose neighbours offer to exchange states.
//
// C. J. Geyer, "Markov chain Monte Carlo maximum likelihood", Computing Science and Statistics 23 (1991).

#pragma once

#include <cstdint>
#include <vector>

#include "anneal/chain.h"

namespace bn::anneal {

/// Temperatures in geometric steps, place 0 the coldest.
struct TemperatureLadder {
  TemperatureRange range;
  int count = 2;
  double at(int place) const;
};

/// Neighbours on the ladder exchange states with Metropolis' chance: even pairs in even slices, odd ones in
/// odd slices. The states move and the engines stay, so that their random numbers do.
void exchange_neighbours(std::vector<Chain>& chains, const TemperatureLadder& ladder, std::uint64_t seed,
                         std::int64_t slice);

}  // namespace bn::anneal
