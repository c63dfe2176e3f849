// The temporal algorithm on a flat picture: what sorting and retargeting can reach when neighbours
// render exactly alike. The pixel's value is the square of one random number, so that its
// distribution is skewed like radiance. No renderer, no edges, no motion: an upper bound and a
// quick check of textures.

#include <cmath>

#include "bn/random.h"
#include "bn_study/measures.h"
#include "bn_study/models.h"

namespace bn {

std::vector<double> run_flat_model(const FlatModel& model, const TemporalTextures& textures) {
  textures.check();
  constexpr double kBand = 0.1;
  constexpr std::uint32_t kSeedStream = 0x52540002u;
  const Extent padded = padded_extent(model.screen, textures.mask.size());
  Seeds seeds = initial_seeds(padded, static_cast<std::uint32_t>(random_bits(model.seed, kSeedStream, 0)));
  Grid<float> values(model.screen);
  std::vector<double> power_db;
  for (int frame = 0; frame <= model.frames; ++frame) {
    for (int y = 0; y < values.height(); ++y) {
      for (int x = 0; x < values.width(); ++x) {
        const float u = sample(seeds(x, y), 0);
        values(x, y) = u * u;
      }
    }
    power_db.push_back(10.0 * std::log10(low_frequency_power(values, kBand)));
    const Offset shift = tile_shift(textures.mask.size(), textures.step, frame);
    sort_seeds(seeds, values, textures.mask, shift,
               sort_blocks(model.block, model.jitter, model.seed, frame));
    if (model.retarget) seeds = retarget_seeds(seeds, textures.move({0, 0}), shift);
  }
  return power_db;
}

}  // namespace bn
