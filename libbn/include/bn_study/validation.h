// bn_study/validation.h - floor 4 (study): scenes rendered with every method and measured, behind `bn
// validate`. Not installed.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bn/render.h"

namespace bn {

/// Textures of a study beside its mask: the stack of a preset, or a user's.
struct StudyStack {
  std::string name;
  TemporalTextures textures;
};

/// A method of a study, with the mask or with a stack. A stack has two: a slice a frame is its sampler
/// (Method::mask_moved), or the temporal algorithm runs on it (Method::retarget).
struct StudyMethod {
  Method method;
  std::string stack = {};  ///< its name; empty: the mask
  /// "mask-moved", "retarget"; of a stack: "both", "retarget-both"
  std::string name() const;
};

/// Every method, in the order of the tables, with the stacks of these names.
std::vector<StudyMethod> study_methods(std::span<const std::string> stacks);

/// What `bn validate` renders and measures.
struct StudyOptions {
  std::vector<std::string> scenes;  ///< names or files
  std::vector<StudyMethod> methods = study_methods({});
  std::vector<StudyStack> stacks = {};  ///< that `methods` name
  Extent screen{384, 256};
  int frames = 16;               ///< after the first, 1..1000
  int reference_samples = 2048;  ///< paths a pixel of the converged picture, 1..65536
  int bounces = 2;
  int block = 8;
  bool jitter = false;
  bool sort_by_light = false;
  bool variations = true;  ///< also other block sizes with retarget, and the tiles with sorting by light
  std::uint64_t seed = 1;

  /// A minute's run.
  void make_quick();
};

/// Renders every scene with every method and writes to `folder`:
///   errors.csv    by scene, variant, frame, region: RMSE, power in bands, flicker, averages in time
///   radial.csv    power of the error by radial frequency, likewise
///   passes.csv    milliseconds, share and memory of each pass
///   summary.csv   by scene, variant, region: error at f <= 0.1 against white noise, dB
///   report.md     the summary as tables
///   SCENE/...png  last frames; sheets of errors over their spectra: first frames, methods, block sizes
///   references/   converged pictures, which an equal run takes from there
/// `device`: null renders on the processor. Files are written whole or not at all.
void run_study(const StudyOptions& options, const TemporalTextures& textures,
               std::shared_ptr<VulkanDevice> device, const std::filesystem::path& folder,
               const Execution& execution = {});

}  // namespace bn
