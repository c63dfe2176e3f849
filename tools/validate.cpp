// bn validate: the baked textures at work in a small renderer, measured.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bn/error.h"
#include "bn/options.h"
#include "bn/report.h"
#include "bn_study/validation.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  std::string scene;
  std::vector<std::string> methods;  ///< empty: all
  StudyOptions study;
  std::string device = "lavapipe";
  std::filesystem::path textures;
  std::filesystem::path slices;
  std::optional<Offset> step;
  bool unsafe = false;
  bool quick = false;
  std::filesystem::path out = "validation";
  bool json = false;
};

std::vector<std::string> scene_words() {
  std::vector<std::string> words = shipped_scene_names();
  words.emplace_back("all");
  return words;
}

/// The name of a shipped scene, or a file.
ValueKind<std::string> scene() {
  ValueKind<std::string> kind = any_text("SCENE", scene_words());
  kind.parse = [](std::string_view text, std::string_view where) {
    check_path_word(text, where);
    return std::string(text);
  };
  return kind;
}

/// A misspelt name of a scene reads as the name of a file that is not there.
void check_scene_name(const std::string& scene) {
  const std::vector<std::string> words = scene_words();
  std::error_code failed;
  if (std::find(words.begin(), words.end(), scene) != words.end() || std::filesystem::exists(scene, failed))
    return;
  const std::string nearest = nearest_word(scene, words);
  throw Error({.code = ErrorCode::io,
               .what = "there is no scene and no file of this name",
               .where = scene,
               .limit = fmt::format("{}, or a TOML file", fmt::join(words, ", ")),
               .remedy = nearest.empty() ? "" : fmt::format("did you mean {}?", nearest)});
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method method : kMethods) names.emplace_back(name_of(method));
  return names;
}

void run(Settings& settings, Session& session) {
  StudyOptions& study = settings.study;
  check_scene_name(settings.scene);
  study.scenes = settings.scene == "all" ? shipped_scene_names() : std::vector<std::string>{settings.scene};
  for (const std::string& scene : study.scenes) load_scene(scene);  // wrong ones fail before the work starts
  if (!settings.methods.empty()) {
    study.methods.clear();
    for (const Method method : kMethods) {
      const auto& chosen = settings.methods;
      if (std::find(chosen.begin(), chosen.end(), name_of(method)) != chosen.end())
        study.methods.push_back(method);
    }
    study.variations = false;
    // White noise is what the others are measured against.
    if (std::find(study.methods.begin(), study.methods.end(), Method::white) == study.methods.end())
      study.methods.insert(study.methods.begin(), Method::white);
  }
  if (settings.quick) study.make_quick();
  std::shared_ptr<VulkanDevice> device;
  if (settings.device != "cpu") device = open_vulkan_device(settings.device);
  TemporalTextures textures;
  if (settings.textures.empty()) {
    textures = make_temporal_textures(4, session.execution_showing("textures"));
    if (settings.step && !(*settings.step == textures.step)) {
      throw Error({.code = ErrorCode::usage,
                   .what = "the step of textures that are baked on the spot cannot be chosen",
                   .where = "--step",
                   .limit = "with --textures only",
                   .remedy = ""});
    }
    session.progress.finish();
  } else {
    textures = read_temporal_textures(settings.textures, settings.step, settings.unsafe, session.execution);
  }
  if (!settings.slices.empty()) textures.slices = read_slices(settings.slices, session.execution);
  run_study(study, textures, device, settings.out, session.execution_showing("validate"));
  session.progress.finish();
  write_study_report(settings.out, settings.out / "report.html", session.execution);
  Json result{{"out", settings.out.string()}, {"report", (settings.out / "report.html").string()}};
  for (const char* table : {"summary.csv", "errors.csv", "radial.csv", "passes.csv"})
    result["tables"].push_back((settings.out / table).string());
  result["scenes"] = study.scenes;
  for (const Method method : study.methods) result["methods"].push_back(name_of(method));
  if (settings.json) return session.output.write_result(result, true);
  session.output.tell(fmt::format("report  {}\n", result["report"].get<std::string>()));
}

}  // namespace

Verb validate_verb() {
  const auto settings = std::make_shared<Settings>();
  StudyOptions& study = settings->study;
  Verb verb;
  verb.name = "validate";
  verb.summary = "Render scenes with the baked textures and measure what they bring.";
  verb.examples = {{"bn validate all --quick -o study", "every shipped scene, a minute's run"},
                   {"bn validate poster --textures out/64 -o study", "one scene with the textures of a bake"},
                   {"bn validate my_scene.toml --method reproject --block 16 --frames 32 -o study",
                    "a scene of your own, one method against white noise"},
                   {"bn validate room --device gpu --size 1920x1080 -o study", "on a graphics card"}};
  verb.details =
      "Each scene is rendered with one path a pixel, with white noise, with masks used in simpler ways, and "
      "with "
      "the temporal algorithm: sort, sort and retarget, and retarget with the tile for the picture's motion. "
      "The "
      "errors against a converged picture, their spectra and the cost of every pass go into CSV files, "
      "pictures, "
      "a page (report.html) and its tables alone (report.md).\n\n"
      "The Vulkan device is Mesa's lavapipe unless --device names another: gpu, a part of a device's name, "
      "or cpu "
      "for the plain renderer without Vulkan.";
  verb.arguments.positional(
      "SCENE", settings->scene, scene(),
      fmt::format("{}, all of them by all, or a TOML file.", fmt::join(shipped_scene_names(), ", ")));
  verb.arguments.option(
      "--method", settings->methods, word_list(method_names()),
      "Some methods, and white noise to measure them against; all adds other block sizes and "
      "sorting by light.");
  verb.arguments.option(
      "--textures", settings->textures, folder_path(),
      "Folder with mask.png and retarget_atlas.png of a bake; without it they are made on the spot.");
  verb.arguments.option("--slices", settings->slices, folder_path(),
                        "Folder with a stack of masks, an image a slice in name order: the method slices.");
  verb.arguments.option("--step", settings->step, offset_or_auto(),
                        "The dither step; must be the one the tiles were baked for, which auto takes.");
  verb.arguments.flag("--unsafe", settings->unsafe, true,
                      "Do not check that the step is that of the tiles, for experiments.");
  verb.arguments.option("--device", settings->device, any_text("NAME"),
                        "lavapipe, gpu, cpu, or a device's name.");
  verb.arguments.option("--size", study.screen, extent_in(8, 4096), "The screen.");
  verb.arguments.option("--frames", study.frames, integer_in(1, 1000), "Frames after the first.");
  verb.arguments.option("--reference", study.reference_samples, integer_in(1, 65536),
                        "Paths a pixel of the converged picture.");
  verb.arguments.option("--bounces", study.bounces, integer_in(1, 8), "Scatterings a path.");
  verb.arguments.option("--block", study.block, integer_in(2, 16), "Side of the sort blocks: 2, 4, 8 or 16.");
  verb.arguments.flag("--jitter", study.jitter, true, "Move the block grid by a random offset each frame.");
  verb.arguments.flag("--sort-by-light", study.sort_by_light, true,
                      "Sort by the light alone, without the surface's colour; ignores texture edges.");
  verb.arguments.option("--seed", study.seed, seed_value(), "Chooses the random numbers.");
  verb.arguments.flag("--quick", settings->quick, true, "192x128 pixels, 8 frames, 128 reference paths.");
  verb.arguments.option("--out", settings->out, folder_path(), "Where the report goes.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print where everything is as JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
