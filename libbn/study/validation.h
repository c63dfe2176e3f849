// The parts of the study behind `bn validate`. validation.cpp runs them in the order they stand in here.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bn/spectrum.h"
#include "bn_study/measures.h"
#include "bn_study/validation.h"
#include "core/progress.h"

namespace bn::study {

inline constexpr double kLowFrequency =
    0.1;  // cycles per pixel; above it the eye sees little at arm's length
inline constexpr double kBlurs_px[] = {0.0, 1.0, 1.5, 2.0};
inline constexpr std::size_t kNoBlur = 0, kShownBlur = 2;  // of these, where one is enough

// --- what is rendered ------------------------------------------------------------------------------

/// One sequence of frames: a method with its settings.
struct Variant {
  std::string name;  ///< the method's, with what differs from the options: "retarget-block-4"
  StudyMethod method = {Method::white};
  int block = 8;
  bool sort_by_light = false;
};
std::vector<Variant> variants_of(const StudyOptions& options);

/// A scene with everything that renders it.
struct Stage {
  const StudyOptions& options;
  const TemporalTextures& textures;      ///< of the methods without a stack
  std::shared_ptr<VulkanDevice> device;  ///< null: the processor
  Scene scene;
  std::filesystem::path folder;  ///< of the scene's pictures
  Execution execution;

  const TemporalTextures& textures_of(const StudyMethod& method) const;
  std::unique_ptr<Renderer> renderer(const TemporalTextures& with, const RenderSettings& settings) const;
};

// --- where it is measured --------------------------------------------------------------------------

struct PixelRect {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Where a region of the scene is at a frame: regions follow the picture under a pan. Nothing where less than
/// half of it is in view.
std::optional<PixelRect> region_at(const Scene& scene, const Region& region, Extent screen, int frame);

template <class T>
Grid<T> crop(const Grid<T>& picture, PixelRect rect) {
  Grid<T> part({rect.width, rect.height});
  for (int y = 0; y < rect.height; ++y) {
    for (int x = 0; x < rect.width; ++x) part(x, y) = picture(rect.left + x, rect.top + y);
  }
  return part;
}

Grid<float> luminance_of(const Grid<Rgb>& colour);
Grid<float> difference(const Grid<float>& a, const Grid<float>& b);

/// What changed between two frames' errors where the picture moved by whole pixels of `motion`: each pixel
/// less the one it comes from. `known` is the share of pixels that were in view in both; the others read 0.
Grid<float> change_along_motion(const Grid<float>& error, const Grid<float>& last,
                                const Grid<PixelMotion>& motion, double& known);

// --- converged pictures ------------------------------------------------------------------------------

struct Reference {
  Grid<float> luminance;
  /// Half the difference of its two halves: as strong as its own error.
  Grid<float> own_error;
};

/// One converged picture for each view of the camera, kept in files: an equal run finds them there.
class References {
 public:
  References(const Stage& stage, int frames, std::filesystem::path folder);
  /// Views that are still to be rendered, in frames of the renderer.
  int work() const;
  void render(ProgressMeter& progress);
  const Reference& at(int frame);
  int views() const { return static_cast<int>(frame_of_view_.size()); }

 private:
  std::filesystem::path file_of(int view) const;
  std::optional<Reference> read(int view) const;

  const Stage& stage_;
  std::filesystem::path folder_;
  std::vector<int> view_of_frame_;
  std::vector<int> frame_of_view_;
  int view_ = -1;  ///< that current_ is of
  Reference current_;
};

// --- what is measured ------------------------------------------------------------------------------

/// Of one sequence, at one frame, in one region.
struct Measure {
  /// RMS errors, of which the converged picture's own part is taken off.
  double rms[std::size(kBlurs_px)] = {};
  double low_frequency = 0.0;            ///< power at 0 < f <= kLowFrequency
  double bands[kBandEdges.size()] = {};  ///< power up to each edge from the one before
  double reference_low_frequency = 0.0;  ///< of the converged picture's own error
  /// RMS change of the error, blurred (1.5 pixels), since the last frame, along the motion; < 0: unknown.
  double flicker = -1.0;
  double running = -1.0;              ///< RMS error of the average since the camera last moved; < 0: it moves
  double exponential = -1.0;          ///< and of the exponential one (0.1)
  double exponential_blurred = -1.0;  ///< which is then blurred (1.5 pixels)
  RadialCurve radial;
};

struct Sequence {
  Variant variant;
  std::map<std::pair<int, std::size_t>, Measure> measures;  ///< by frame and region
  std::vector<PassTime> passes;                             ///< the median of the frames after the first
  std::vector<Grid<float>> first_errors;                    ///< crops of the first frames
  Grid<float> last_error;                                   ///< the same crop at the last frame
  Grid<std::uint32_t> last_crop;                            ///< the picture there
  Grid<std::uint32_t> last_shown;                           ///< the whole picture

  /// Frees what only write_pictures() reads.
  void drop_pictures() {
    first_errors.clear();
    last_error = {};
    last_crop = last_shown = {};
  }
};

struct SceneResult {
  Scene scene;
  std::vector<Region> regions;  ///< the whole picture first
  int frames = 0;
  double reference_rms = 0.0;  ///< own error of the last view's converged picture
  std::vector<Sequence> sequences;

  const Sequence* find(std::string_view variant) const;
  /// Low-frequency error of a sequence against white noise over the frames from `first` on, dB, the
  /// reference's own taken off both.
  std::optional<double> against_white(const Sequence& sequence, std::size_t region, int first) const;
};

SceneResult study_scene(const Stage& stage, const std::vector<Variant>& variants, References& references,
                        ProgressMeter& progress);

// --- what is written -------------------------------------------------------------------------------

void write_pictures(const SceneResult& result, const std::filesystem::path& folder);

std::string errors_csv(const std::vector<SceneResult>& results);
std::string radial_csv(const std::vector<SceneResult>& results);
std::string passes_csv(const std::vector<SceneResult>& results);
std::string summary_csv(const std::vector<SceneResult>& results);
/// What the figures are of: screen, frames, device, scenes; for the page.
std::string study_json(const std::vector<SceneResult>& results, const StudyOptions& options,
                       const std::string& device);
std::string report_md(const std::vector<SceneResult>& results, const StudyOptions& options,
                      const std::string& device);

}  // namespace bn::study
