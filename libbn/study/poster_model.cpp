// A poster under a pan, without a renderer: what edges and motion do to the temporal algorithm, one cause at
// a time and with the true picture known exactly.
//
// A checkered poster hangs on an even wall; the camera pans. A pixel shows a(p) * u^2, where u is a random
// number of its seed and a the reflectance there, so its error is a(p) * (u^2 - 1/3). Edges of colour only
// scale a seed's value. At edges between surfaces a seed means something else on the other side: there u is
// another random number of the seed, as where light comes from elsewhere.
//
// Against white noise: of that, the windowed power is known, the window's mean of a^2 times the variance of
// u^2, 4/45.

#include <algorithm>
#include <cmath>

#include "bn/random.h"
#include "bn_study/measures.h"
#include "bn_study/models.h"
#include "study/error_spectrum.h"

namespace bn {
using namespace study;
namespace {

constexpr std::uint32_t kSeedStream = 0x52540005u;
constexpr double kBand = 0.1;
constexpr int kPosterWidth = 120, kPosterHeight = 80, kColumns = 3, kRows = 2;
constexpr int kMargin = 12;
constexpr float kReflectance[3] = {0.6f, 0.85f, 0.08f};  // wall, light and dark cells

/// Which of the three a point shows, in pixels from the poster's top left corner.
int field_at(double x, double y) {
  if (x < 0.0 || y < 0.0 || x >= kPosterWidth || y >= kPosterHeight) return 0;
  const int cell =
      static_cast<int>(x * kColumns / kPosterWidth) + static_cast<int>(y * kRows / kPosterHeight);
  return 1 + cell % 2;
}

class Poster {
 public:
  explicit Poster(const PosterModel& model)
      : model_(model),
        // In the middle of the picture in the middle of the run.
        left_((model.screen.width - kPosterWidth) / 2.0 + model.pan_px * model.frames / 2.0),
        top_((model.screen.height - kPosterHeight) / 2.0) {}

  int field(int x, int y, int frame) const {
    return field_at(x + 0.5 - left_ + model_.pan_px * frame, y + 0.5 - top_);
  }
  /// The part of the picture that is measured: the poster and a margin, as far as in view.
  Region region(int frame) const {
    const auto inside = [](double at, int side) { return std::clamp(at, 0.0, static_cast<double>(side)); };
    const double left = inside(std::round(left_ - model_.pan_px * frame) - kMargin, model_.screen.width);
    const double right = inside(left + kPosterWidth + 2 * kMargin, model_.screen.width);
    const double top = inside(top_ - kMargin, model_.screen.height);
    const double bottom = inside(top_ + kPosterHeight + kMargin, model_.screen.height);
    return {"", left, top, right - left, bottom - top};
  }

 private:
  const PosterModel& model_;
  double left_, top_;
};

}  // namespace

PosterRun run_poster_model(const PosterModel& model, const TemporalTextures& textures) {
  textures.check();
  const Poster poster(model);
  Seeds seeds = initial_seeds(padded_extent(model.screen, textures.size()),
                              static_cast<std::uint32_t>(random_bits(model.seed, kSeedStream, 0)));
  // The picture moves against the camera. Rounded half up like the mean motion of the screen.
  const int motion = std::clamp(static_cast<int>(std::floor(-model.pan_px + 0.5)), -textures.motion_range,
                                textures.motion_range);
  PosterRun run;
  std::int64_t crossing = 0, moved = 0;
  for (int frame = 0; frame <= model.frames; ++frame) {
    Grid<float> key(model.screen);
    const Region part = poster.region(frame);
    const int left = static_cast<int>(part.x), top = static_cast<int>(part.y);
    Grid<float> error({static_cast<int>(part.width), static_cast<int>(part.height)});
    Grid<float> square(error.size());  // of the reflectance
    for (int y = 0; y < model.screen.height; ++y) {
      for (int x = 0; x < model.screen.width; ++x) {
        const int field = poster.field(x, y, frame);
        const auto dimension =
            static_cast<std::uint32_t>(model.edge == PosterModel::Edge::surface ? field : 0);
        const float u = sample(seeds(x, y), dimension);
        const float a = kReflectance[field];
        key(x, y) = model.sort_by_light ? u * u : a * u * u;
        const int i = x - left, j = y - top;
        if (i < 0 || j < 0 || i >= error.width() || j >= error.height()) continue;
        error(i, j) = a * (u * u - 1.0f / 3.0f);
        square(i, j) = a * a;
      }
    }
    double mean_square = 0.0;  // under the window of low_frequency_error()
    double weights = 0.0;
    for (int y = 0; y < error.height(); ++y) {
      for (int x = 0; x < error.width(); ++x) {
        const double weight = hann_window(x, error.width()) * hann_window(y, error.height());
        mean_square += weight * weight * square(x, y);
        weights += weight * weight;
      }
    }
    const double white = mean_square / weights * 4.0 / 45.0;
    run.power_db.push_back(10.0 * std::log10(low_frequency_error(error, kBand) / white));
    const Offset shift = textures.shift(frame);
    const Grid<Offset>& move = textures.move({model.reproject ? motion : 0, 0}, frame);
    sort_seeds(seeds, key, textures.mask(frame), shift, sort_blocks(model.block, false, model.seed, frame));
    for (int y = top; y < top + error.height(); ++y) {
      for (int x = left; x < left + error.width(); ++x) {
        const Offset by = move.torus(x + shift.x, y + shift.y);
        crossing += poster.field(x, y, frame) != poster.field(x + by.x, y + by.y, frame + 1);
        ++moved;
      }
    }
    seeds = retarget_seeds(seeds, move, shift);
  }
  run.crossing = static_cast<double>(crossing) / static_cast<double>(moved);
  return run;
}

}  // namespace bn
