#include "anneal/tempering.h"

#include "bn/random.h"
#include "core/reproducible_math.h"

namespace bn::anneal {
namespace {

/// Stream of random numbers for exchanges between chains.
constexpr std::uint32_t kExchangeStream = 0x5D000000u;

}  // namespace

double TemperatureLadder::at(int place) const {
  const double share = static_cast<double>(place) / (count - 1);
  return range.end * reproducible_exp(share * reproducible_log(range.start / range.end));
}

void exchange_neighbours(std::vector<Chain>& chains, const TemperatureLadder& ladder, std::uint64_t seed,
                         std::int64_t slice) {
  for (std::size_t c = static_cast<std::size_t>(slice & 1); c + 1 < chains.size(); c += 2) {
    Engine &cold = *chains[c].engine, &hot = *chains[c + 1].engine;
    const double gain = static_cast<double>(cold.energy() - hot.energy());
    const double exponent =
        gain * (1.0 / ladder.at(static_cast<int>(c)) - 1.0 / ladder.at(static_cast<int>(c) + 1));
    const auto bits = random_bits(seed, kExchangeStream + static_cast<std::uint32_t>(c),
                                  static_cast<std::uint64_t>(slice)) >>
                      11;
    const double u = (static_cast<double>(bits) + 0.5) * 0x1p-53;
    if (exponent < 0.0 && u >= reproducible_exp(exponent)) continue;
    const std::string was_cold = cold.save();
    cold.load(hot.save());
    hot.load(was_cold);
  }
}

}  // namespace bn::anneal
