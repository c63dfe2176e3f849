// bn validate: the baked textures at work in a small renderer, measured.

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
  std::filesystem::path slices, slice_tiles;
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

constexpr std::array kPresets{SpatiotemporalPreset::stbn, SpatiotemporalPreset::filtered,
                              SpatiotemporalPreset::both};
constexpr int kRadius = 6;                 // of tiles that are made on the spot
const std::string kGivenStack = "slices";  // the stack of --slices

/// The presets, and the stack that may be given.
std::vector<StudyMethod> known_methods(bool with_given) {
  std::vector<std::string> stacks;
  for (const auto preset : kPresets) stacks.emplace_back(name_of(preset));
  if (with_given) stacks.push_back(kGivenStack);
  return study_methods(stacks);
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const StudyMethod& method : known_methods(true)) names.push_back(method.name());
  return names;
}

/// Those that were asked for and white noise, which the others are measured against; or all.
std::vector<StudyMethod> chosen_methods(const Settings& settings) {
  const std::vector<std::string>& names = settings.methods;
  std::vector<StudyMethod> methods = known_methods(names.empty() ? !settings.slices.empty() : true);
  if (names.empty()) return methods;
  std::erase_if(methods, [&](const StudyMethod& method) {
    return !(method.method == Method::white) &&
           std::find(names.begin(), names.end(), method.name()) == names.end();
  });
  for (const StudyMethod& method : methods) {
    if (method.stack != kGivenStack || !settings.slices.empty()) continue;
    throw Error({.code = ErrorCode::usage,
                 .what = fmt::format("the method {} needs a stack of masks", method.name()),
                 .where = "--method",
                 .limit = "",
                 .remedy = "name one with --slices"});
  }
  return methods;
}

/// The stacks that the methods name, with tiles where seeds are carried.
std::vector<StudyStack> stacks_of(const Settings& settings, const TemporalTextures& given, Session& session) {
  std::vector<StudyStack> stacks;
  const auto add = [&](const std::string& name, const auto& make) {
    const std::vector<StudyMethod>& methods = settings.study.methods;
    const auto uses = [&](bool carries) {
      return std::any_of(methods.begin(), methods.end(), [&](const StudyMethod& method) {
        return method.stack == name && (!carries || method.method == Method::retarget);
      });
    };
    if (!uses(false)) return;
    TemporalTextures textures = make();
    if (uses(true) && textures.moves.empty())
      solve_moves(textures, kRadius, session.execution_showing(fmt::format("tiles of {}", name)));
    session.progress.finish();
    stacks.push_back({name, std::move(textures)});
  };
  add(kGivenStack, [&] { return given; });
  for (const auto preset : kPresets) {
    const std::string name(name_of(preset));
    add(name, [&] { return make_preset_textures(preset, session.execution_showing(name)); });
  }
  return stacks;
}

void run(Settings& settings, Session& session) {
  StudyOptions& study = settings.study;
  check_scene_name(settings.scene);
  study.scenes = settings.scene == "all" ? shipped_scene_names() : std::vector<std::string>{settings.scene};
  for (const std::string& scene : study.scenes) load_scene(scene);  // wrong ones fail before the work starts
  study.methods = chosen_methods(settings);
  if (!settings.methods.empty()) study.variations = false;
  if (!settings.slice_tiles.empty() && settings.slices.empty()) {
    throw Error({.code = ErrorCode::usage,
                 .what = "tiles of a stack without the stack",
                 .where = "--slice-tiles",
                 .limit = "with --slices only",
                 .remedy = ""});
  }
  if (settings.quick) study.make_quick();
  std::shared_ptr<VulkanDevice> device;
  if (settings.device != "cpu") device = open_vulkan_device(settings.device);
  TemporalTextures textures, given;
  if (!settings.slices.empty())
    given = read_stack_textures(settings.slices, settings.slice_tiles, session.execution);
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
  study.stacks = stacks_of(settings, given, session);
  run_study(study, textures, device, settings.out, session.execution_showing("validate"));
  session.progress.finish();
  write_study_report(settings.out, settings.out / "report.html", session.execution);
  Json result{{"out", settings.out.string()}, {"report", (settings.out / "report.html").string()}};
  for (const char* table : {"summary.csv", "errors.csv", "radial.csv", "passes.csv"})
    result["tables"].push_back((settings.out / table).string());
  result["scenes"] = study.scenes;
  for (const StudyMethod& method : study.methods) result["methods"].push_back(method.name());
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
      "Each scene is rendered with one path a pixel, with white noise, with masks used in simpler ways, with "
      "the spatiotemporal presets (64x64x32, a slice a frame), and with the temporal algorithm: sort, sort "
      "and retarget, retarget with the tile for the picture's motion, and retarget from slice to slice of "
      "each preset. The "
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
  verb.arguments.option(
      "--slices", settings->slices, file_path(),
      "A stack of masks (a folder, slice_%03d.png, a file): methods slices, retarget-slices.");
  verb.arguments.option(
      "--slice-tiles", settings->slice_tiles, file_path(),
      "Its retarget tiles, as bn retarget makes them; without it they are made on the spot.");
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
