// One scene, rendered with each variant and measured frame by frame against its converged pictures.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/camera.h"
#include "study/error_spectrum.h"
#include "study/validation.h"

namespace bn::study {
using namespace render;
namespace {

constexpr float kAverage = 0.1f;  // of the exponential average over time
constexpr int kFirstFrames = 7;
constexpr int kCropSide = 64;

/// A square in the middle of the first region of the scene, or of the picture.
PixelRect crop_at(const SceneResult& result, Extent screen, int frame) {
  PixelRect rect{0, 0, screen.width, screen.height};
  if (result.regions.size() > 1) {
    if (const auto region = region_at(result.scene, result.regions[1], screen, frame)) rect = *region;
  }
  const int side = std::min({kCropSide, screen.width, screen.height});
  return {std::clamp(rect.left + (rect.width - side) / 2, 0, screen.width - side),
          std::clamp(rect.top + (rect.height - side) / 2, 0, screen.height - side), side, side};
}

/// Of a converged picture's own error in one region.
struct OwnError {
  explicit OwnError(const Grid<float>& error) : low_frequency(ErrorSpectrum(error).band(0.0, kLowFrequency)) {
    for (std::size_t i = 0; i < std::size(kBlurs_px); ++i) rms[i] = blurred_rms(error, kBlurs_px[i]);
  }
  /// The RMS of `error` after a blur without this error's part, which is independent of the rest.
  double taken_off(const Grid<float>& error, std::size_t blur) const {
    const double all = blurred_rms(error, kBlurs_px[blur]), own = rms[blur];
    return std::sqrt(std::max(all * all - own * own, 0.0));
  }

  double rms[std::size(kBlurs_px)] = {};
  double low_frequency;
};
/// By frame and region: all sequences are measured against the same pictures.
using OwnErrors = std::map<std::pair<int, std::size_t>, OwnError>;

Measure measure(const Grid<float>& error, const OwnError& own) {
  Measure m;
  for (std::size_t i = 0; i < std::size(kBlurs_px); ++i) m.rms[i] = own.taken_off(error, i);
  const ErrorSpectrum spectrum(error);
  m.low_frequency = spectrum.band(0.0, kLowFrequency);
  for (std::size_t i = 0; i < kBandEdges.size(); ++i)
    m.bands[i] = spectrum.band(i == 0 ? 0.0 : kBandEdges[i - 1], kBandEdges[i]);
  m.reference_low_frequency = own.low_frequency;
  m.radial = spectrum.radial();
  return m;
}

/// Times of one pass over the frames: what the sequence reports is their median.
class PassTimes {
 public:
  void add(const std::vector<PassTime>& frame) {
    for (const PassTime& time : frame) {
      auto found = std::find_if(passes_.begin(), passes_.end(),
                                [&](const auto& pass) { return pass.front().pass == time.pass; });
      if (found == passes_.end()) found = passes_.insert(found, std::vector<PassTime>());
      found->push_back(time);
    }
  }
  std::vector<PassTime> medians() {
    std::vector<PassTime> result;
    for (auto& pass : passes_) {
      std::sort(pass.begin(), pass.end(),
                [](const auto& a, const auto& b) { return a.milliseconds < b.milliseconds; });
      result.push_back(pass[pass.size() / 2]);
    }
    return result;
  }

 private:
  std::vector<std::vector<PassTime>> passes_;
};

Sequence run_sequence(const Stage& stage, const Variant& variant, const SceneResult& result,
                      References& references, OwnErrors& own_errors, ProgressMeter& progress) {
  const StudyOptions& options = stage.options;
  const Extent screen = options.screen;
  Sequence sequence;
  sequence.variant = variant;
  const auto renderer =
      stage.renderer(stage.textures_of(variant.method), {.screen = screen,
                                                         .method = variant.method.method,
                                                         .bounces = options.bounces,
                                                         .block = variant.block,
                                                         .jitter = options.jitter,
                                                         .sort_by_light = variant.sort_by_light,
                                                         .seed = options.seed});
  PassTimes times;
  Grid<float> last_error, running(screen), exponential(screen);
  int still_frames = 0;  // since the camera last moved
  for (int frame = 0; frame <= options.frames; ++frame) {
    throw_if_stopped(stage.execution);
    Frame rendered = renderer->next();
    if (frame > 0) times.add(rendered.times);
    const Grid<float> shown = luminance_of(rendered.colour);
    const bool moved = frame > 0 && !same_view(stage.scene, frame, frame - 1);
    still_frames = moved ? 1 : still_frames + 1;
    const float share = 1.0f / static_cast<float>(still_frames);
    for (std::size_t i = 0; i < shown.count(); ++i) {
      running[i] += (shown[i] - running[i]) * share;
      exponential[i] += (shown[i] - exponential[i]) * std::max(share == 1.0f ? 1.0f : 0.0f, kAverage);
    }
    const Reference& reference = references.at(frame);
    const Grid<float> error = difference(shown, reference.luminance);
    double known = 0.0;
    Grid<float> change(screen);
    if (frame > 0) change = change_along_motion(error, last_error, rendered.motion_of_pixel, known);
    for (std::size_t r = 0; r < result.regions.size(); ++r) {
      const auto rect = region_at(stage.scene, result.regions[r], screen, frame);
      if (!rect) continue;
      const OwnError& own =
          own_errors.try_emplace({frame, r}, crop(reference.own_error, *rect)).first->second;
      Measure m = measure(crop(error, *rect), own);
      if (known > 0.5) m.flicker = blurred_rms(crop(change, *rect), kBlurs_px[kShownBlur]);
      if (!moved) {
        const auto average_error = [&](const Grid<float>& average) {
          return crop(difference(average, reference.luminance), *rect);
        };
        m.running = own.taken_off(average_error(running), kNoBlur);
        m.exponential = own.taken_off(average_error(exponential), kNoBlur);
        m.exponential_blurred = own.taken_off(average_error(exponential), kShownBlur);
      }
      sequence.measures[{frame, r}] = std::move(m);
    }
    const Grid<float> part = crop(error, crop_at(result, screen, frame));
    if (frame < kFirstFrames) sequence.first_errors.push_back(part);
    if (frame == options.frames) {
      sequence.last_error = part;
      sequence.last_crop = crop(rendered.shown, crop_at(result, screen, frame));
      sequence.last_shown = std::move(rendered.shown);
    }
    last_error = error;
    progress.advance(1);
  }
  sequence.passes = times.medians();
  return sequence;
}

}  // namespace

std::optional<PixelRect> region_at(const Scene& scene, const Region& region, Extent screen, int frame) {
  // The picture moves against the camera.
  const auto at = [](double share, int side, double moved) {
    return static_cast<int>(std::lround(share * side - moved));
  };
  const double moved_x = region.name == "picture" ? 0.0 : scene.pan_x_px * frame;
  const double moved_y = region.name == "picture" ? 0.0 : scene.pan_y_px * frame;
  const int left = std::max(at(region.x, screen.width, moved_x), 0);
  const int top = std::max(at(region.y, screen.height, moved_y), 0);
  const int right = std::min(at(region.x + region.width, screen.width, moved_x), screen.width);
  const int bottom = std::min(at(region.y + region.height, screen.height, moved_y), screen.height);
  const double in_view = static_cast<double>(std::max(right - left, 0)) * std::max(bottom - top, 0);
  const double all = region.width * screen.width * region.height * screen.height;
  if (right <= left || bottom <= top || in_view < 0.5 * all) return {};
  return PixelRect{left, top, right - left, bottom - top};
}

Grid<float> luminance_of(const Grid<Rgb>& colour) {
  Grid<float> result(colour.size());
  for (std::size_t i = 0; i < result.count(); ++i) {
    result[i] = 0.2126f * colour[i].r + 0.7152f * colour[i].g + 0.0722f * colour[i].b;
  }
  return result;
}

Grid<float> difference(const Grid<float>& a, const Grid<float>& b) {
  Grid<float> result(a.size());
  for (std::size_t i = 0; i < result.count(); ++i) result[i] = a[i] - b[i];
  return result;
}

Grid<float> change_along_motion(const Grid<float>& error, const Grid<float>& last,
                                const Grid<PixelMotion>& motion, double& known) {
  Grid<float> change(error.size());
  const auto whole = [](int fixed) { return (fixed + 128) >> 8; };
  std::int64_t count = 0;
  for (int y = 0; y < error.height(); ++y) {
    for (int x = 0; x < error.width(); ++x) {
      const PixelMotion moved = motion(x, y);
      if (moved.x == kNoMotion) continue;
      const int from_x = x - whole(moved.x), from_y = y - whole(moved.y);
      if (from_x < 0 || from_y < 0 || from_x >= error.width() || from_y >= error.height()) continue;
      change(x, y) = error(x, y) - last(from_x, from_y);
      ++count;
    }
  }
  known = static_cast<double>(count) / static_cast<double>(error.count());
  return change;
}

const Sequence* SceneResult::find(std::string_view variant) const {
  const auto found = std::find_if(sequences.begin(), sequences.end(),
                                  [&](const Sequence& s) { return s.variant.name == variant; });
  return found == sequences.end() ? nullptr : &*found;
}

std::optional<double> SceneResult::against_white(const Sequence& sequence, std::size_t region,
                                                 int first) const {
  const Sequence* white = find(name_of(Method::white));
  if (!white) return {};
  double sum = 0.0, sum_white = 0.0;
  for (const auto& [key, m] : sequence.measures) {
    if (key.second != region || key.first < first) continue;
    sum += m.low_frequency - m.reference_low_frequency;
    sum_white += white->measures.at(key).low_frequency - m.reference_low_frequency;
  }
  if (!(sum > 0.0 && sum_white > 0.0)) return {};
  return 10.0 * std::log10(sum / sum_white);
}

SceneResult study_scene(const Stage& stage, const std::vector<Variant>& variants, References& references,
                        ProgressMeter& progress) {
  SceneResult result;
  result.scene = stage.scene;
  result.frames = stage.options.frames;
  result.regions.push_back({.name = "picture"});
  for (const Region& region : stage.scene.regions) result.regions.push_back(region);
  references.render(progress);
  OwnErrors own_errors;
  for (const Variant& variant : variants)
    result.sequences.push_back(run_sequence(stage, variant, result, references, own_errors, progress));
  result.reference_rms = blurred_rms(references.at(result.frames).own_error, 0.0);
  return result;
}

}  // namespace bn::study
