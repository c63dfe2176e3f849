// The study behind `bn validate`: each scene with each method, measured against a converged picture.
//
// References. A view's converged picture is the mean of many white-noise frames with the camera at
// rest there. Its own error is white and `reference_samples` times less in power than one frame's;
// the report states it. A scene whose camera moves on every frame would need a reference a frame, so
// only the last kReferences views are measured.
//
// Low-frequency error is stated against white noise: the power at 0 < f <= 0.1 cycles per pixel that
// the method leaves in a region, over the power that white noise leaves there, in dB, both averaged over the
// same frames.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>

#include "bn/runtime.h"
#include "bn/spectrum.h"
#include "bn/texture.h"
#include "core/progress.h"
#include "runtime/renderer.h"
#include "runtime/scene.h"

namespace bn {
namespace {

constexpr double kBand = 0.1;
constexpr int kReferences = 2;
constexpr double kAverage = 0.1;  // of the exponential average over time
constexpr int kStripFrames = 7;
constexpr int kStripSide = 64;
constexpr double kSigmas[] = {0.0, 1.0, 1.5, 2.0};

struct Rows {
  int left, top, width, height;
};

Rows pixels_of(const Region& region, Extent screen) {
  const auto at = [](double share, int side) { return static_cast<int>(std::lround(share * side)); };
  Rows rows{at(region.x, screen.width), at(region.y, screen.height), at(region.width, screen.width),
            at(region.height, screen.height)};
  rows.width = std::clamp(rows.width, 1, screen.width - rows.left);
  rows.height = std::clamp(rows.height, 1, screen.height - rows.top);
  return rows;
}

Grid<float> crop(const Grid<float>& picture, Rows rows) {
  Grid<float> part({rows.width, rows.height});
  for (int y = 0; y < rows.height; ++y) {
    for (int x = 0; x < rows.width; ++x) part(x, y) = picture(rows.left + x, rows.top + y);
  }
  return part;
}

Grid<float> luminance(const Grid<Colour>& colour) {
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

/// What is measured of one method, in one region, at one frame.
struct Measure {
  double rms[4] = {};          ///< for kSigmas
  double low_frequency = 0.0;  ///< absolute
  double flicker = -1.0;  ///< RMS change of the blurred (sigma 1.5) error since the last frame; < 0: unknown
  double running = -1.0;  ///< RMS error of the running average
  double exponential = -1.0;  ///< and of the exponential one
};

using Key = std::pair<int, std::size_t>;  // frame, region

struct MethodResult {
  std::map<Key, Measure> measures;
  std::vector<PassTime> passes;  ///< of the last frame
  std::map<std::size_t, std::vector<double>> radial;
  std::vector<double> frequency;
};

class SceneStudy {
 public:
  SceneStudy(const StudyOptions& options, const TemporalTextures& textures,
             std::shared_ptr<VulkanDevice> device, Scene scene, const std::filesystem::path& folder,
             const Execution& execution, ProgressMeter& progress)
      : options_(options),
        textures_(textures),
        device_(std::move(device)),
        scene_(std::move(scene)),
        folder_(folder / scene_.name),
        execution_(execution),
        progress_(progress) {
    regions_.push_back({.name = "picture"});
    for (const Region& region : scene_.regions) regions_.push_back(region);
  }

  void run() {
    std::filesystem::create_directories(folder_);
    make_references();
    for (const Method method : options_.methods) results_[method] = run_method(method);
  }

  std::string errors_csv() const;
  std::string radial_csv() const;
  std::string passes_csv() const;
  std::string report() const;

 private:
  std::unique_ptr<Renderer> renderer(Method method, std::optional<int> camera_frame) const {
    RenderSettings settings{.screen = options_.screen,
                            .method = method,
                            .bounces = options_.bounces,
                            .block = options_.block,
                            .jitter = options_.jitter,
                            .sort_by_light = options_.sort_by_light,
                            .seed = options_.seed};
    settings.camera_frame = camera_frame;
    // The references must not share their random numbers with the white noise they judge.
    if (camera_frame) settings.seed = ~options_.seed;
    if (device_) return make_vulkan_renderer(device_, scene_, textures_, settings);
    return make_plain_renderer(scene_, textures_, settings, execution_);
  }

  void make_references() {
    reference_of_.assign(static_cast<std::size_t>(options_.frames) + 1, -1);
    for (int frame = options_.frames; frame >= 0; --frame) {
      for (int other = frame + 1; other <= options_.frames; ++other) {
        if (same_view(scene_, frame, other)) {
          reference_of_[static_cast<std::size_t>(frame)] = reference_of_[static_cast<std::size_t>(other)];
          break;
        }
      }
      const bool known = reference_of_[static_cast<std::size_t>(frame)] >= 0;
      if (known || references_.size() >= kReferences) continue;
      const auto view = renderer(Method::white, frame);
      std::vector<double> sum(static_cast<std::size_t>(options_.screen.area()));
      for (int i = 0; i < options_.reference_samples; ++i) {
        throw_if_stopped(execution_);
        const Grid<float> sample = luminance(view->next().colour);
        for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += sample[p];
        progress_.advance(1);
      }
      Grid<float> mean(options_.screen);
      for (std::size_t p = 0; p < sum.size(); ++p)
        mean[p] = static_cast<float>(sum[p] / options_.reference_samples);
      reference_of_[static_cast<std::size_t>(frame)] = static_cast<int>(references_.size());
      references_.push_back(std::move(mean));
    }
  }

  MethodResult run_method(Method method) {
    MethodResult result;
    const auto view = renderer(method, {});
    std::optional<Grid<float>> last_error;
    Grid<float> running(options_.screen), exponential(options_.screen);
    int still_frames = 0;  // since the camera last moved
    std::vector<Grid<float>> strip;
    for (int frame = 0; frame <= options_.frames; ++frame) {
      throw_if_stopped(execution_);
      Frame rendered = view->next();
      progress_.advance(1);
      const Grid<float> shown = luminance(rendered.colour);
      const bool moved = frame > 0 && !same_view(scene_, frame, frame - 1);
      still_frames = moved ? 1 : still_frames + 1;
      for (std::size_t i = 0; i < shown.count(); ++i) {
        running[i] += (shown[i] - running[i]) / static_cast<float>(still_frames);
        exponential[i] +=
            (shown[i] - exponential[i]) * (still_frames == 1 ? 1.0f : static_cast<float>(kAverage));
      }
      const int reference = reference_of_[static_cast<std::size_t>(frame)];
      if (reference < 0) continue;
      const Grid<float>& truth = references_[static_cast<std::size_t>(reference)];
      const Grid<float> error = difference(shown, truth);
      for (std::size_t r = 0; r < regions_.size(); ++r) {
        const Rows rows = pixels_of(regions_[r], options_.screen);
        const Grid<float> part = crop(error, rows);
        Measure measure;
        for (std::size_t i = 0; i < std::size(kSigmas); ++i) measure.rms[i] = blurred_rms(part, kSigmas[i]);
        measure.low_frequency = low_frequency_error(part, kBand);
        if (last_error && !moved)
          measure.flicker = blurred_rms(difference(part, crop(*last_error, rows)), 1.5);
        if (!moved) {
          measure.running = blurred_rms(crop(difference(running, truth), rows), 0.0);
          measure.exponential = blurred_rms(crop(difference(exponential, truth), rows), 0.0);
        }
        result.measures[{frame, r}] = measure;
        if (frame == options_.frames) radial(result, r, part);
      }
      if (static_cast<int>(strip.size()) < kStripFrames) strip.push_back(strip_part(error));
      last_error = error;
      if (frame == options_.frames) {
        result.passes = rendered.times;
        write_frame(method, rendered.shown);
      }
    }
    write_strip(method, strip);
    return result;
  }

  void radial(MethodResult& result, std::size_t region, const Grid<float>& part) const {
    const std::vector<double> values(part.begin(), part.end());
    const RadialCurve curve =
        radial_power(power_spectrum(values, {part.width(), part.height(), 1}, {.threads = 1}));
    // Curves of regions of different size share no frequencies; the whole picture's are kept too.
    if (region <= 1) {
      result.radial[region] = curve.power;
      if (region == std::min<std::size_t>(1, regions_.size() - 1)) result.frequency = curve.frequency;
    }
  }

  /// A square of the error from the middle of the first region of the scene.
  Grid<float> strip_part(const Grid<float>& error) const {
    const Rows rows = pixels_of(regions_.size() > 1 ? regions_[1] : regions_[0], options_.screen);
    const int side = std::min({kStripSide, options_.screen.width, options_.screen.height});
    const int left = std::clamp(rows.left + (rows.width - side) / 2, 0, options_.screen.width - side);
    const int top = std::clamp(rows.top + (rows.height - side) / 2, 0, options_.screen.height - side);
    return crop(error, {left, top, side, side});
  }

  void write_frame(Method method, const Grid<std::uint32_t>& shown) const {
    Image image{.size = shown.size(), .channels = 3, .type = SampleType::u8, .samples = {}};
    for (const std::uint32_t pixel : shown) {
      for (int shift = 0; shift < 24; shift += 8)
        image.samples.push_back(static_cast<std::byte>(pixel >> shift & 255u));
    }
    write(image, fmt::format("{}.png", name_of(method)));
  }

  /// Errors of the first frames side by side, and below each its power spectrum, DC in the middle.
  void write_strip(Method method, const std::vector<Grid<float>>& strip) const {
    if (strip.empty()) return;
    const int side = strip[0].width();
    const auto frames = static_cast<int>(strip.size());
    Grid<float> sheet({side * frames, side * 2});
    const double white = blurred_rms(strip[0], 0.0);
    for (int i = 0; i < frames; ++i) {
      const Grid<float>& part = strip[static_cast<std::size_t>(i)];
      const std::vector<double> values(part.begin(), part.end());
      const Grid<double> power = centred_power(power_spectrum(values, {side, side, 1}, {.threads = 1}));
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          sheet(i * side + x, y) = 0.5f + static_cast<float>(part(x, y) / (4.0 * std::max(white, 1e-12)));
          // An amplitude, so that what is dark in it is dark to the eye.
          sheet(i * side + x, side + y) = static_cast<float>(0.5 * std::sqrt(power(x, y)));
        }
      }
    }
    Image image{.size = sheet.size(), .channels = 1, .type = SampleType::u8, .samples = {}};
    for (const float value : sheet) {
      image.samples.push_back(static_cast<std::byte>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))));
    }
    write(image, fmt::format("{}-first-frames.png", name_of(method)));
  }

  void write(const Image& image, const std::string& name) const {
    Metadata metadata;
    metadata.algorithm = "validate";
    metadata.kind = "picture";
    write_image(folder_ / name, image, metadata);
  }

  /// Low-frequency error of `method` against white noise over the second half of the measured frames, dB.
  std::optional<double> against_white(Method method, std::size_t region) const {
    const auto white = results_.find(Method::white);
    const auto own = results_.find(method);
    if (white == results_.end() || own == results_.end()) return {};
    double sum_white = 0.0, sum_own = 0.0;
    for (const auto& [key, measure] : own->second.measures) {
      if (key.second != region || key.first < (options_.frames + 1) / 2) continue;
      sum_own += measure.low_frequency;
      sum_white += white->second.measures.at(key).low_frequency;
    }
    if (!(sum_own > 0.0 && sum_white > 0.0)) return {};
    return 10.0 * std::log10(sum_own / sum_white);
  }

  const StudyOptions& options_;
  const TemporalTextures& textures_;
  std::shared_ptr<VulkanDevice> device_;
  Scene scene_;
  std::filesystem::path folder_;
  Execution execution_;
  ProgressMeter& progress_;
  std::vector<Region> regions_;
  std::vector<int> reference_of_;  ///< by frame; -1: none
  std::vector<Grid<float>> references_;
  std::map<Method, MethodResult> results_;
};

std::string known(double value) { return value < 0.0 ? "" : fmt::format("{:.6g}", value); }

std::string SceneStudy::errors_csv() const {
  std::string text;
  for (const auto& [method, result] : results_) {
    for (const auto& [key, m] : result.measures) {
      text +=
          fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{}\n", scene_.name,
                      name_of(method), key.first, regions_[key.second].name, m.rms[0], m.rms[1], m.rms[2],
                      m.rms[3], m.low_frequency, known(m.flicker), known(m.running), known(m.exponential));
    }
  }
  return text;
}

std::string SceneStudy::radial_csv() const {
  std::string text;
  const std::size_t region = std::min<std::size_t>(1, regions_.size() - 1);
  for (const auto& [method, result] : results_) {
    const auto curve = result.radial.find(region);
    if (curve == result.radial.end()) continue;
    for (std::size_t i = 0; i < curve->second.size(); ++i) {
      if (std::isnan(curve->second[i])) continue;
      text += fmt::format("{},{},{},{:.5f},{:.6g}\n", scene_.name, name_of(method), regions_[region].name,
                          result.frequency[i], curve->second[i]);
    }
  }
  return text;
}

std::string SceneStudy::passes_csv() const {
  std::string text;
  for (const auto& [method, result] : results_) {
    double sum = 0.0;
    for (const PassTime& time : result.passes) sum += time.milliseconds;
    for (const PassTime& time : result.passes) {
      text += fmt::format("{},{},{},{:.4f},{:.3f}\n", scene_.name, name_of(method), time.pass,
                          time.milliseconds, 100.0 * time.milliseconds / std::max(sum, 1e-9));
    }
  }
  return text;
}

std::string SceneStudy::report() const {
  std::string text = fmt::format("\n## {}\n\n| method |", scene_.name);
  for (const Region& region : regions_) text += fmt::format(" {} |", region.name);
  text += " RMSE | blurred 1.5 | flicker | averaged |\n|---|";
  for (std::size_t i = 0; i < regions_.size() + 4; ++i) text += "---|";
  text += "\n";
  for (const auto& [method, result] : results_) {
    text += fmt::format("| {} |", name_of(method));
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      const auto db = against_white(method, r);
      text += db ? fmt::format(" {:.1f} |", *db) : " |";
    }
    const auto last = result.measures.find({options_.frames, 0});
    if (last == result.measures.end()) continue;
    const Measure& m = last->second;
    text += fmt::format(" {:.4f} | {:.4f} | {} | {} |\n", m.rms[0], m.rms[2], known(m.flicker),
                        known(m.exponential));
  }
  return text;
}

}  // namespace

void StudyOptions::make_quick() {
  screen = {192, 128};
  frames = 8;
  reference_samples = 256;
}

void run_study(const StudyOptions& options, const TemporalTextures& textures,
               std::shared_ptr<VulkanDevice> device, const std::filesystem::path& folder,
               const Execution& execution) {
  if (options.frames < 1 || options.frames > 1000 || options.reference_samples < 1 ||
      options.reference_samples > 65536 || options.scenes.empty() || options.methods.empty()) {
    throw Error(
        {.code = ErrorCode::invalid_input,
         .what = fmt::format("{} scenes, {} methods, {} frames, {} reference samples", options.scenes.size(),
                             options.methods.size(), options.frames, options.reference_samples),
         .where = "validate",
         .limit = "a scene and a method at least, 1..1000 frames, 1..65536 samples",
         .remedy = ""});
  }
  textures.check();
  std::vector<Scene> scenes;
  for (const std::string& name : options.scenes) scenes.push_back(load_scene(name));
  // What a renderer refuses, it refuses before a folder is made.
  for (const Scene& scene : scenes) {
    for (const Method method : options.methods) {
      const RenderSettings settings{
          .screen = options.screen, .method = method, .bounces = options.bounces, .block = options.block};
      check_rendering(scene, textures, settings);
    }
  }
  const RenderSettings largest{.screen = options.screen, .method = Method::white, .block = options.block};
  if (device) {
    make_vulkan_renderer(device, scenes[0], textures, largest);
  } else {
    make_plain_renderer(scenes[0], textures, largest);
  }
  std::filesystem::create_directories(folder);
  const auto steps = (options.frames + 1) * static_cast<int>(options.methods.size()) +
                     kReferences * options.reference_samples;
  ProgressMeter progress(execution, static_cast<std::uint64_t>(steps) * scenes.size());

  std::string errors =
      "scene,method,frame,region,rmse,rmse_blur_1,rmse_blur_1.5,rmse_blur_2,low_frequency_error,flicker,"
      "rmse_running_average,rmse_exponential_average\n";
  std::string radial = "scene,method,region,frequency,power\n";
  std::string passes = "scene,method,pass,milliseconds,percent_of_frame\n";
  std::string report = fmt::format(
      "# Validation\n\n{}x{} pixels, 1 path a pixel, {} bounces, {} frames, sort blocks of {}{}, {}.\n\n"
      "Region columns: error at 0 < f <= 0.1 cycles per pixel against white noise, dB, mean of the measured "
      "frames from\n"
      "frame {} on. The rest is of the whole picture at the last frame: RMSE, RMSE after a blur of 1.5 "
      "pixels, change of\n"
      "the blurred error from frame to frame, RMSE of the exponential average (0.1).\n"
      "References: {} paths a pixel, so {:.0f} dB below white noise.\n",
      options.screen.width, options.screen.height, options.bounces, options.frames + 1, options.block,
      fmt::format("{}{}", options.jitter ? ", jittered" : "",
                  options.sort_by_light ? ", sorted by light" : ""),
      device ? "on " + make_vulkan_renderer(device, scenes[0], textures, {.screen = {8, 8}})->device()
             : "on the processor",
      (options.frames + 1) / 2, options.reference_samples, 10.0 * std::log10(options.reference_samples));
  for (Scene& scene : scenes) {
    SceneStudy study(options, textures, device, std::move(scene), folder, execution, progress);
    study.run();
    errors += study.errors_csv();
    radial += study.radial_csv();
    passes += study.passes_csv();
    report += study.report();
  }
  write_text_file(folder / "errors.csv", errors);
  write_text_file(folder / "radial.csv", radial);
  write_text_file(folder / "passes.csv", passes);
  write_text_file(folder / "report.md", report);
  progress.finish();
}

}  // namespace bn
