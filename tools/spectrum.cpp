// bn spectrum: how good textures are, as numbers, and whether they pass.
//
// Every file is read and judged by itself: one that cannot be read is listed with its error and silences no
// other.

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bn/error.h"
#include "bn/volume.h"
#include "tools/keep_inputs.h"
#include "tools/spectrum_analyst.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::vector<fs::path> files;
  SpectrumSettings spectrum;
  bool volume = false;
  fs::path png, csv;
  bool json = false;
};

/// What the words on the command line mean.
std::vector<SpectrumInput> inputs_of(const Settings& settings, SpectrumResult& result) {
  std::vector<SpectrumInput> inputs;
  std::vector<fs::path> slices;
  for (const fs::path& path : settings.files) {
    std::error_code ignored;
    const bool is_folder = fs::is_directory(path, ignored);
    if (!is_folder && settings.volume) {
      slices.push_back(path);
    } else if (!is_folder || settings.volume) {
      inputs.push_back({{path}});
    } else {
      const std::vector<fs::path> files = image_files_below(path);
      for (const fs::path& file : files) inputs.push_back({{file}, true});
      if (!files.empty()) continue;
      result.faults.push_back({path.string(),
                               {.code = ErrorCode::invalid_input,
                                .what = "there is no texture in this folder",
                                .where = path.string(),
                                .limit = "",
                                .remedy = "name files, or another folder"}});
    }
  }
  if (!slices.empty()) inputs.push_back({std::move(slices)});
  return inputs;
}

void write_picture(const fs::path& path, const PowerSpectrum& power) {
  const Grid<std::uint8_t> grey = log_picture(power.shape.depth > 1 ? project(power, Projection::xy) : power);
  Image image;
  image.size = grey.size();
  image.channels = 1;
  image.samples.resize(grey.count());
  std::memcpy(image.samples.data(), grey.data(), grey.count());
  Metadata metadata;
  metadata.algorithm = "power-spectrum";
  metadata.algorithm_version = 1;
  metadata.kind = "spectrum";
  write_image(path, image, metadata);
}

/// Ends with the highest exit code of all that went wrong. One file by itself ends with its own error.
void throw_the_worst(const SpectrumResult& result) {
  std::vector<std::string> failures = failures_of(result);
  const SpectrumResult::Fault* worst = nullptr;
  for (const auto& fault : result.faults) {
    if (worst == nullptr || fault.error.code > worst->error.code) worst = &fault;
  }
  const std::size_t kMostNamed = 4, all = failures.size();
  if (all > 0) {
    if (all > kMostNamed) failures.resize(kMostNamed);
    throw Error({.code = ErrorCode::verification_failed,
                 .what = fmt::format("{}{}", fmt::join(failures, "; "),
                                     all > kMostNamed ? fmt::format("; and {} more", all - kMostNamed) : ""),
                 .where = "check",
                 .limit = "",
                 .remedy = ""});
  }
  if (worst != nullptr) {
    ErrorInfo info = worst->error;
    if (result.faults.size() > 1) info.what += fmt::format(" (and {} more errors)", result.faults.size() - 1);
    throw Error(std::move(info));
  }
  if (!result.check) return;
  for (const SpectrumRow& row : result.rows) {
    if (!row.judgement || row.judgement->outcome != Judgement::Outcome::cannot_tell) continue;
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "too small to judge: " + row.judgement->reasons.front(),
                 .where = row.name(),
                 .limit = "",
                 .remedy = "leave out --check to see its figures"});
  }
}

void run(const Settings& settings, Session& session) {
  if (!settings.png.empty()) {
    check_writable(settings.png, SampleType::u8, 1);
    check_keeps(settings.png, "--png", settings.files);
  }
  if (!settings.csv.empty()) check_text_writable(settings.csv);
  SpectrumResult result{.check = settings.spectrum.check,
                        .rows = {},
                        .pairs = {},
                        .faults = {},
                        .notes = {},
                        .file_findings = {}};
  const std::vector<SpectrumInput> inputs = inputs_of(settings, result);
  session.progress.start("spectrum");
  SpectrumAnalyst analyst(settings.spectrum, session, result);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    analyst.look_at(inputs[i]);
    session.progress.update(static_cast<double>(i + 1) / static_cast<double>(inputs.size()));
  }
  analyst.finish();
  session.progress.finish();

  if (settings.json) {
    session.output.write_result(to_json(result), true);
  } else {
    session.output.tell(to_text(result));
  }
  if (!analyst.one_size() && !(settings.png.empty() && settings.csv.empty())) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "textures of different sizes have no common spectrum",
                 .where = "--png and --csv",
                 .limit = "",
                 .remedy = "write them one by one"});
  }
  if (analyst.average()) {
    if (!settings.png.empty()) write_picture(settings.png, *analyst.average());
    if (!settings.csv.empty()) write_text_file(settings.csv, curves_csv(*analyst.average()));
  }
  throw_the_worst(result);
}

}  // namespace

Verb spectrum_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "spectrum";
  verb.summary = "Print how good textures are, and check them against thresholds.";
  verb.examples = {
      {"bn spectrum mask.png --check blue", "is it blue noise? exit code 5 where it is not"},
      {"bn spectrum masks --json", "figures of all in a folder and of their average, for a program"},
      {"bn spectrum slices --volume --check stbn", "a spatiotemporal volume, a file a slice"},
      {"bn spectrum mask.png --png spectrum.png --csv curves.csv", "the spectrum to look at and to plot"}};
  verb.details =
      "One texture: a line a figure, with what the check allows and what the best known masks of its size "
      "read. "
      "Several: a line each, and their average. Every channel is judged, and channels of one file are "
      "compared: one "
      "mask moved or repeated fails. Power is against white noise, by frequency (cycles/pixel), of the ranks "
      "of the "
      "pixels.\n\n"
      "The grade is 100 where a texture is as good as the best known, 0 where it is no better than white "
      "noise; it "
      "is that of the weakest figure. Checks: blue (lower bands, isotropy, distribution), white (every band "
      "and "
      "isotropy within the chance of white noise), stbn (slices blue, every pixel blue in time; needs "
      "--volume). "
      "Verdicts: pass; weak, a pass with a grade below 80; FAIL, with the likely cause where it can be told; "
      "small, "
      "where the size allows no verdict. docs/spectrum.md has the thresholds, their reasons, the grade's "
      "reference "
      "and the JSON.\n\n"
      "A file of several slices, a pattern (slice_%03d.png) and with --volume a folder or a list of slices "
      "are "
      "volumes. Slices are taken in the order of their numbers, of which none may be missing. A file that "
      "cannot be read is listed and the others "
      "are "
      "judged all the same; the exit code is the highest of all that went wrong.";
  verb.arguments.positional_list("FILE|DIR", settings->files, file_path(), "Textures, and folders of them.");
  verb.arguments.option("--check", settings->spectrum.check,
                        choice_of<std::optional<Check>>(
                            {{"blue", Check::blue}, {"white", Check::white}, {"stbn", Check::stbn}}),
                        "Compare with the thresholds of this kind.");
  verb.arguments.option(
      "--distribution", settings->spectrum.distribution,
      choice_of<Distribution>({{"uniform", Distribution::uniform}, {"triangular", Distribution::triangular}}),
      "How the values should be spread over their range.");
  verb.arguments.option("--channel", settings->spectrum.channel, any_text("all|N|NAME"),
                        "The channel to analyse: its number from 0, or the name that an EXR gives it.");
  verb.arguments.flag("--volume", settings->volume, true,
                      "Each folder, or all files together, is one volume of slices.");
  verb.arguments.option(
      "--png", settings->png, texture_path(),
      "Write the spectrum (of the average) as a picture: DC in the middle, -50 to +12.5 dB.");
  verb.arguments.option("--csv", settings->csv, text_path(), "Write power and anisotropy by frequency.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
