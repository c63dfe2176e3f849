// The temporal algorithm on a flat picture: what sorting and retargeting can reach when neighbours
// render exactly alike. The pixel's value is the square of one random number, so that its
// distribution is skewed like radiance. No renderer, no edges, no motion: an upper bound and a
// quick check of textures.

#include <cmath>

#include "bn/random.h"
#include "bn_study/measures.h"
#include "bn_study/models.h"

namespace bn {
namespace {

constexpr double kBand = 0.1;
constexpr float kAverage = 0.1f;  // of each new frame, in the exponential average
constexpr double kBlur_px = 1.5;
constexpr float kMean = 1.0f / 3.0f;  // of the square of a random number
constexpr std::uint32_t kSeedStream = 0x52540002u;

}  // namespace

FlatRun run_flat_model(const FlatModel& model, const TemporalTextures& textures) {
  textures.check();
  const Extent padded = padded_extent(model.screen, textures.size());
  Seeds seeds = initial_seeds(padded, static_cast<std::uint32_t>(random_bits(model.seed, kSeedStream, 0)));
  Grid<float> values(model.screen), error(model.screen);  // the latter of the average
  FlatRun run;
  double white = 0.0, white_blurred = 0.0;  // RMS of the first frame, which is white noise
  double white_power = 1.0;                 // that is left of white noise's by the average
  for (int frame = 0; frame <= model.frames; ++frame) {
    const float share = frame == 0 ? 1.0f : kAverage;
    for (int y = 0; y < values.height(); ++y) {
      for (int x = 0; x < values.width(); ++x) {
        const float u = sample(seeds(x, y), 0);
        values(x, y) = u * u;
        error(x, y) += share * (u * u - kMean - error(x, y));
      }
    }
    run.power_db.push_back(10.0 * std::log10(low_frequency_power(values, kBand)));
    const double averaged = blurred_rms(error, 0.0), blurred = blurred_rms(error, kBlur_px);
    if (frame == 0) {
      white = averaged;
      white_blurred = blurred;
    } else {
      white_power = (1.0 - share) * (1.0 - share) * white_power + share * share;
    }
    const auto against = [&](double rms, double first) {
      return 20.0 * std::log10(rms / first) - 10.0 * std::log10(white_power);
    };
    run.averaged_db.push_back(against(averaged, white));
    run.averaged_blurred_db.push_back(against(blurred, white_blurred));
    const Offset shift = textures.shift(frame);
    sort_seeds(seeds, values, textures.mask(frame), shift,
               sort_blocks(model.block, model.jitter, model.seed, frame));
    if (model.retarget) seeds = retarget_seeds(seeds, textures.move({0, 0}, frame), shift);
  }
  return run;
}

}  // namespace bn
