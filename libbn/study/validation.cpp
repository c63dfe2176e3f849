// The study behind `bn validate`: each scene with each method, measured against converged pictures.
//
// Low-frequency error is stated against white noise: the power at 0 < f <= 0.1 cycles per pixel that a method
// leaves in a region, over the power that white noise leaves there, in dB, both summed over the same frames.
// A texture's worth shows after some frames, so the first half of the sequence is not counted.
//
// Everything that can be refused is refused before the first file is written.

#include <fmt/format.h>

#include "bn/error.h"
#include "bn/texture.h"
#include "render/renderer.h"
#include "study/validation.h"

namespace bn {
using namespace render;
using namespace study;
namespace {

void check_options(const StudyOptions& options) {
  const auto within = [](int value, int low, int high) { return value >= low && value <= high; };
  if (within(options.frames, 1, 1000) && within(options.reference_samples, 1, 65536) &&
      !options.scenes.empty() && !options.methods.empty())
    return;
  throw Error(
      {.code = ErrorCode::invalid_input,
       .what = fmt::format("{} scenes, {} methods, {} frames, {} reference samples", options.scenes.size(),
                           options.methods.size(), options.frames, options.reference_samples),
       .where = "validate",
       .limit = "a scene and a method at least, 1..1000 frames, 1..65536 samples",
       .remedy = ""});
}

}  // namespace

void StudyOptions::make_quick() {
  screen = {192, 128};
  frames = 8;
  reference_samples = 128;
}

void run_study(const StudyOptions& options, const TemporalTextures& textures,
               std::shared_ptr<VulkanDevice> device, const std::filesystem::path& folder,
               const Execution& execution) {
  check_options(options);
  textures.check();
  const std::vector<Variant> variants = variants_of(options);
  std::vector<Stage> stages;
  for (const std::string& name : options.scenes) {
    Scene scene = load_scene(name);
    const auto own_folder = folder / scene.name;
    stages.push_back({options, textures, device, std::move(scene), own_folder, execution});
    for (const Variant& variant : variants) {
      const RenderSettings settings{.screen = options.screen,
                                    .method = variant.method.method,
                                    .bounces = options.bounces,
                                    .block = variant.block};
      const Stage& stage = stages.back();
      check_rendering(stage.scene, stage.textures_of(variant.method), settings);
    }
  }
  // Memory is all that only a renderer can refuse.
  const std::string name =
      stages.front().renderer(textures, {.screen = options.screen, .method = Method::white})->device();

  int work = 0;
  std::vector<References> references;
  for (const Stage& stage : stages) {
    references.emplace_back(stage, options.frames, folder / "references");
    work += references.back().work() + static_cast<int>(variants.size()) * (options.frames + 1);
  }
  ProgressMeter progress(execution, static_cast<std::uint64_t>(work));
  std::vector<SceneResult> results;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    make_folder(stages[i].folder);
    results.push_back(study_scene(stages[i], variants, references[i], progress));
    write_pictures(results.back(), stages[i].folder);
    for (Sequence& sequence : results.back().sequences) sequence.drop_pictures();
  }
  write_text_file(folder / "errors.csv", errors_csv(results));
  write_text_file(folder / "radial.csv", radial_csv(results));
  write_text_file(folder / "passes.csv", passes_csv(results));
  write_text_file(folder / "summary.csv", summary_csv(results));
  write_text_file(folder / "study.json", study_json(results, options, name));
  write_text_file(folder / "report.md", report_md(results, options, name));
  progress.finish();
}

}  // namespace bn
