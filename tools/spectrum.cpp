// bn spectrum: how good textures are, as numbers, and whether they pass.

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "bn/error.h"
#include "bn/spectrum.h"
#include "bn/texture.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  std::vector<std::filesystem::path> files;
  int channel = 0;
  bool volume = false;
  std::optional<Check> check;
  std::filesystem::path png, csv;
  bool json = false;
};

/// One channel of an image, or of a stack of them.
struct Texture {
  ChannelSamples samples;
  Shape shape;
};

/// Reads `path` and appends its channel as the next slice.
void append_slice(const std::filesystem::path& path, int channel, const Execution& execution,
                  Texture& texture) {
  const Image image = read_image(path, execution).image;
  const auto fail = [&](std::string what, std::string limit, std::string remedy) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::move(what),
                 .where = path.string(),
                 .limit = std::move(limit),
                 .remedy = std::move(remedy)});
  };
  if (channel >= image.channels) {
    fail(fmt::format("there is no channel {}", channel), fmt::format("0..{}", image.channels - 1), "");
  }
  const Shape slice{image.size.width, image.size.height};
  if (texture.samples.value.empty()) {
    texture.shape = slice;
  } else if (Shape{texture.shape.width, texture.shape.height} == slice) {
    ++texture.shape.depth;
  } else {
    fail(fmt::format("a slice of {} x {}", slice.width, slice.height),
         fmt::format("{} x {}, as the first", texture.shape.width, texture.shape.height), "");
  }
  append_samples(texture.samples, samples_of_channel(image, channel));
}

/// The finding of one texture or average.
struct Finding {
  std::string name;
  FiguresOfMerit figures;
  std::vector<CheckFailure> failures;
};

std::string describe(const CheckFailure& failure) {
  return fmt::format("{} {:.4g}, allowed {:.4g}..{:.4g}", failure.figure, failure.value, failure.low,
                     failure.high);
}

Json to_json(const Finding& finding, bool checked) {
  Json result{{"file", finding.name}};
  result.update(Json::parse(bn::to_json(finding.figures)));
  if (!checked) return result;
  result["passed"] = finding.failures.empty();
  result["failures"] = Json::array();
  for (const auto& failure : finding.failures) result["failures"].push_back(describe(failure));
  return result;
}

std::string table(const std::vector<Finding>& findings, bool checked) {
  std::size_t width = 4;
  bool volumes = false;
  for (const auto& finding : findings) {
    width = std::max(width, finding.name.size());
    volumes |= finding.figures.shape.depth > 1;
  }
  std::string text = fmt::format(
      "{:{}}        size  f<=.0625     <=.125    <=.1875      <=.25       <=.5   peak     at   aniso dB  max "
      "dB  "
      "blur 1.0    1.5    2.0  hist dev{}{}\n",
      "file", width, volumes ? "  time at 0  time low" : "", checked ? "  check" : "");
  for (const auto& [name, f, failures] : findings) {
    std::string size = fmt::format("{}x{}", f.shape.width, f.shape.height);
    if (f.shape.depth > 1) size += fmt::format("x{}", f.shape.depth);
    text += fmt::format("{:{}}  {:>10}", name, width, size);
    for (const double band : f.bands.mean) text += fmt::format(" {:>10.3g}", band);
    text += fmt::format("  {:5.2f}  {:5.3f}      {:5.1f}   {:5.1f}     {:5.1f}  {:5.1f}  {:5.1f}  {:8.3g}",
                        f.peak, f.peak_frequency, f.anisotropy_db_mean, f.anisotropy_db_max,
                        f.gauss_residual_db[0], f.gauss_residual_db[1], f.gauss_residual_db[2],
                        f.histogram_max_deviation);
    if (volumes) text += fmt::format("  {:9.3g}  {:8.3g}", f.temporal_power_at_0, f.temporal_power_low);
    if (checked) text += failures.empty() ? "  pass" : "  FAIL";
    text += "\n";
  }
  return text;
}

void write_picture(const std::filesystem::path& path, const PowerSpectrum& power) {
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

void run(const Settings& settings, Session& session) {
  if (!settings.png.empty()) check_writable(settings.png, SampleType::u8, 1);
  if (!settings.csv.empty()) check_text_writable(settings.csv);
  // A volume is one texture of all files; else each file is one.
  const std::size_t files_a_texture = settings.volume ? settings.files.size() : 1;
  std::vector<Finding> findings;
  std::optional<PowerSpectrum> average;
  bool one_size = true;
  double worst_deviation = 0.0;
  session.progress.start("spectrum");
  for (std::size_t first = 0; first < settings.files.size(); first += files_a_texture) {
    Texture texture;
    for (std::size_t i = 0; i < files_a_texture; ++i) {
      append_slice(settings.files[first + i], settings.channel, session.execution, texture);
    }
    const std::string name = settings.files[first].string() +
                             (settings.volume ? fmt::format(" ({} slices)", files_a_texture) : "");
    const Analysis analysis = [&] {
      try {
        return analyse(texture.samples.value, texture.shape, texture.samples.low, texture.samples.high,
                       session.execution);
      } catch (const Error& error) {
        ErrorInfo info = error.info();
        info.where = name;
        throw Error(std::move(info));
      }
    }();
    findings.push_back({name, analysis.figures, {}});
    worst_deviation = std::max(worst_deviation, analysis.figures.histogram_max_deviation);
    if (!average) {
      average = analysis.power;
    } else if (one_size && average->shape == analysis.power.shape) {
      accumulate(*average, analysis.power);
    } else {
      one_size = false;
    }
    session.progress.update(static_cast<double>(first + files_a_texture) /
                            static_cast<double>(settings.files.size()));
  }
  session.progress.finish();
  if (!one_size && !(settings.png.empty() && settings.csv.empty())) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "textures of different sizes have no common spectrum",
                 .where = "--png and --csv",
                 .limit = "",
                 .remedy = "write them one by one"});
  }
  if (findings.size() > 1 && one_size) {
    findings.push_back({"average", figures_of_merit(*average, worst_deviation), {}});
  } else if (findings.size() > 1) {
    session.progress.note("the textures differ in size, so there is no average");
  }
  if (settings.check) {
    for (auto& finding : findings) finding.failures = check(finding.figures, *settings.check);
  }

  if (settings.json) {
    Json result{{"textures", Json::array()}};
    for (const auto& finding : findings)
      result["textures"].push_back(to_json(finding, settings.check.has_value()));
    session.output.write_result(result, true);
  } else {
    session.output.write(table(findings, settings.check.has_value()));
  }
  if (!settings.png.empty()) write_picture(settings.png, *average);
  if (!settings.csv.empty()) write_text_file(settings.csv, curves_csv(*average));

  std::vector<std::string> failed;
  for (const auto& finding : findings) {
    for (const auto& failure : finding.failures) failed.push_back(finding.name + ": " + describe(failure));
  }
  if (failed.empty()) return;
  throw Error({.code = ErrorCode::verification_failed,
               .what = fmt::format("{}", fmt::join(failed, "; ")),
               .where = "check",
               .limit = "",
               .remedy = ""});
}

}  // namespace

Verb spectrum_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "spectrum";
  verb.summary = "Print how good textures are, and check them against thresholds.";
  verb.examples = {
      {"bn spectrum mask.png --check blue", "is it blue noise? exit code 5 where it is not"},
      {"bn spectrum masks/*.png --json", "figures of each and of their average, for a program"},
      {"bn spectrum slices/*.png --volume --check stbn", "a spatiotemporal volume, its slices in order"},
      {"bn spectrum mask.png --png spectrum.png --csv curves.csv", "the spectrum to look at and to plot"}};
  verb.details =
      "One line a texture: mean power against white noise in five bands of frequency (cycles/pixel, of the "
      "ranks of "
      "the pixels), the radial peak and its frequency, anisotropy (0 dB is that of white noise), what a "
      "Gaussian blur "
      "of 1, 1.5 and 2 pixels leaves against white noise (dB), the largest deviation of the histogram from "
      "flat. "
      "Several files of one size give the figures of their averaged spectrum too.\n\n"
      "Checks: blue (lower bands, isotropy, histogram), white (every band and isotropy within the chance of "
      "white "
      "noise), stbn (slices blue, every pixel blue in time; needs --volume). The thresholds and their "
      "reasons are in "
      "docs/spectrum.md. A check that fails is named and ends with exit code 5.";
  verb.arguments.positional_list("FILE", settings->files, file_path(), "The textures.");
  verb.arguments.option("--check", settings->check,
                        choice_of<std::optional<Check>>(
                            {{"blue", Check::blue}, {"white", Check::white}, {"stbn", Check::stbn}}),
                        "Compare with the thresholds of this kind.");
  verb.arguments.option("--channel", settings->channel, integer_in(0, 63), "The channel to analyse.");
  verb.arguments.flag("--volume", settings->volume, true,
                      "The files are the slices of one volume, in order.");
  verb.arguments.option(
      "--png", settings->png, file_path(),
      "Write the spectrum (of the average) as a picture: DC in the middle, -50 to +12.5 dB.");
  verb.arguments.option("--csv", settings->csv, file_path(), "Write power and anisotropy by frequency.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
