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
#include "bn/texture.h"
#include "tools/slice_files.h"
#include "tools/spectrum_result.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::vector<fs::path> files;
  std::optional<int> channel;  ///< none: all
  bool volume = false;
  std::optional<Check> check;
  Distribution distribution = Distribution::uniform;
  fs::path png, csv;
  bool json = false;
};

/// "all", or one channel's number.
ValueKind<std::optional<int>> channel_or_all() {
  const ValueKind<int> number = integer_in(0, 63);
  return {.placeholder = "N|all",
          .allowed = "all, or " + number.allowed,
          .parse = [number](std::string_view text, std::string_view where) -> std::optional<int> {
            if (text == "all") return std::nullopt;
            return number.parse(text, where);
          },
          .show =
              [](const std::optional<int>& channel) {
                return channel ? fmt::format("{}", *channel) : std::string("all");
              }};
}

/// The channels of one picture, or of a stack of pictures.
struct Texture {
  std::string name;
  Shape shape;
  std::vector<ChannelSamples> channels;
};

/// One texture still to be read.
struct Input {
  std::string name;
  std::vector<fs::path> files;  ///< one, or the slices of a volume
  bool found = false;           ///< in a folder: what is no mask is passed over
};

[[noreturn]] void fail(const fs::path& path, std::string what, std::string limit, std::string remedy = "") {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = path.string(),
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

/// Reads `path` and appends its channels as the next slice.
void append_slice(const fs::path& path, const Image& image, Texture& texture) {
  const Shape slice = image.size;
  if (texture.channels.empty()) {
    texture.shape = slice;
    texture.channels.resize(static_cast<std::size_t>(image.channels));
  } else if (texture.shape.slice() != image.size) {
    fail(path, fmt::format("a slice of {} x {}", slice.width, slice.height),
         fmt::format("{} x {}, as the first", texture.shape.width, texture.shape.height));
  } else if (std::ssize(texture.channels) != image.channels) {
    fail(path, fmt::format("a slice of {} channels", image.channels),
         fmt::format("{}, as the first", texture.channels.size()));
  } else {
    ++texture.shape.depth;
  }
  for (std::size_t c = 0; c < texture.channels.size(); ++c) {
    append_samples(texture.channels[c], samples_of_channel(image, static_cast<int>(c)));
  }
}

/// Whether a file of ours is something else than a texture to be judged.
bool is_no_texture(const FileContent& content) {
  if (!content.metadata) return false;
  const std::string& kind = content.metadata->kind;
  return kind.starts_with("retarget") || kind == "contact-sheet" || kind == "spectrum";
}

/// Nothing for a file in a folder that is no mask.
std::optional<Texture> read_texture(const Input& input, const Execution& execution) {
  Texture texture{.name = input.name, .shape = {}, .channels = {}};
  for (const fs::path& path : input.files) {
    const FileContent content = read_image(path, execution);
    if (input.found && is_no_texture(content)) return std::nullopt;
    append_slice(path, content.image, texture);
  }
  return texture;
}

/// What the words on the command line mean.
std::vector<Input> inputs_of(const Settings& settings, SpectrumResult& result) {
  std::vector<Input> inputs;
  std::vector<fs::path> slices;
  const auto add_volume = [&](const std::vector<fs::path>& files, const std::string& folder) {
    SliceFiles order = in_slice_order(files);
    for (const std::string& note : order.notes) result.notes.push_back(note);
    const std::string name = folder.empty() ? order.files.front().string() : folder;
    inputs.push_back({fmt::format("{} ({} slices)", name, order.files.size()), std::move(order.files)});
  };
  for (const fs::path& path : settings.files) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
      const std::vector<fs::path> files = textures_below(path);
      if (files.empty()) {
        result.faults.push_back({path.string(),
                                 {.code = ErrorCode::invalid_input,
                                  .what = "there is no texture in this folder",
                                  .where = path.string(),
                                  .limit = "",
                                  .remedy = "name files, or another folder"}});
      } else if (settings.volume) {
        add_volume(files, path.string());
      } else {
        for (const fs::path& file : files) inputs.push_back({file.string(), {file}, true});
      }
    } else if (settings.volume) {
      slices.push_back(path);
    } else {
      inputs.push_back({path.string(), {path}});
    }
  }
  if (!slices.empty()) add_volume(slices, "");
  return inputs;
}

/// Goes through the textures, one in memory at a time.
class Analyst {
 public:
  Analyst(const Settings& settings, Session& session, SpectrumResult& result)
      : settings_(settings), session_(session), result_(result) {}

  void look_at(const Input& input) {
    try {
      const std::optional<Texture> texture = read_texture(input, session_.execution);
      if (!texture) return void(++passed_over_);
      look_at(*texture);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled) throw;
      result_.faults.push_back({input.name, error.info()});
    }
  }

  /// Adds the average of what is independent.
  void finish() {
    if (passed_over_ > 0) {
      result_.notes.push_back(fmt::format("{} file{} in the folders {} no mask and {} passed over",
                                          passed_over_, passed_over_ == 1 ? "" : "s",
                                          passed_over_ == 1 ? "is" : "are",
                                          passed_over_ == 1 ? "was" : "were"));
    }
    if (!one_size_ && prints_.size() > 1) {
      result_.notes.push_back("the textures differ in size, so there is no average");
    } else if (average_ && average_->textures > 1) {
      SpectrumRow row;
      row.file = "average";
      row.figures = figures_of_merit(*average_, worst_deviation_);
      row.figures.distribution = settings_.distribution;
      row.figures.distribution_distance = worst_distance_;
      judge(row, {{}, row.figures.shape, 0.0, 1.0}, {{}, row.figures});
      result_.rows.push_back(std::move(row));
    }
  }

  bool one_size() const { return one_size_; }
  const std::optional<PowerSpectrum>& average() const { return average_; }

 private:
  /// Ranks at up to kPrintValues places: enough to know a texture again in another encoding.
  static constexpr std::size_t kPrintValues = 4096;
  struct Print {
    std::string name;
    Shape shape;
    std::vector<double> rank;
  };

  void look_at(const Texture& texture) {
    const auto count = static_cast<int>(texture.channels.size());
    if (settings_.channel && *settings_.channel >= count) {
      fail(texture.name, fmt::format("there is no channel {}", *settings_.channel),
           fmt::format("0..{}", count - 1));
    }
    std::vector<Samples> samples;
    for (const ChannelSamples& channel : texture.channels) {
      samples.push_back(
          {channel.value, texture.shape, channel.low, std::max(channel.high, channel.low + 1e-300)});
    }
    const std::vector<int> wanted = channels_to_judge(texture);
    // Analysed before anything is added: a file with a fault leaves no row.
    std::vector<Analysis> analyses;
    for (const int c : wanted) {
      const Samples& s = samples[static_cast<std::size_t>(c)];
      try {
        analyses.push_back(
            analyse(s.values, s.shape, s.low, s.high, session_.execution, settings_.distribution));
      } catch (const Error& error) {
        ErrorInfo info = error.info();
        info.where = texture.name;
        throw Error(std::move(info));
      }
    }
    bool failed = false;
    std::vector<int> judged;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const int c = wanted[i];
      const Samples& s = samples[static_cast<std::size_t>(c)];
      SpectrumRow row;
      row.file = texture.name;
      row.channel = c;
      row.only_channel = count == 1;
      row.figures = analyses[i].figures;
      row.set_aside = aside_of(texture, c);
      if (row.set_aside.empty()) {
        judge(row, s, analyses[i]);
        failed |= row.judgement && !row.judgement->passed();
        bool again = false;
        for (const int other : judged) again |= is_again(texture, samples, other, c);
        judged.push_back(c);
        if (!again) take_into_average(row.name(), s, analyses[i]);
      }
      result_.rows.push_back(std::move(row));
    }
    if (failed && !settings_.channel) {
      for (const Finding& finding : diagnose_alpha(samples)) {
        result_.file_findings.push_back(fmt::format("{}: {}", texture.name, finding.text));
      }
    }
  }

  void judge(SpectrumRow& row, const Samples& samples, const Analysis& analysis) {
    if (settings_.check) {
      row.judgement = judge_texture(samples, analysis, *settings_.check, session_.execution);
      row.grade = row.judgement->grade;
    } else {
      row.grade = grade(row.figures, row.figures.shape.depth > 1 ? Check::stbn : Check::blue);
    }
  }

  /// Grey that is stored as colour is one texture.
  std::vector<int> channels_to_judge(const Texture& texture) {
    if (settings_.channel) return {*settings_.channel};
    const auto& channels = texture.channels;
    std::vector<int> wanted;
    const bool grey = channels.size() >= 3 && channels[1].value == channels[0].value &&
                      channels[2].value == channels[0].value &&
                      (channels.size() != 4 || channels[3].value != channels[0].value);
    for (int c = 0; c < std::ssize(channels); ++c) {
      if (!grey || c == 0 || c > 2) wanted.push_back(c);
    }
    if (grey) {
      result_.notes.push_back(
          fmt::format("{}: channels 0, 1 and 2 are equal, grey stored as colour; judged once", texture.name));
    }
    return wanted;
  }

  std::string aside_of(const Texture& texture, int c) const {
    const std::size_t count = texture.channels.size();
    if (settings_.channel || (count != 2 && count != 4) || c + 1 != static_cast<int>(count)) return {};
    const ChannelSamples& alpha = texture.channels.back();
    const double top = alpha.high > 2.0 ? alpha.high - 1.0 : 1.0;
    const bool opaque =
        std::all_of(alpha.value.begin(), alpha.value.end(), [&](double value) { return value == top; });
    return opaque ? "not judged: it is constant, an opaque alpha channel" : "";
  }

  /// Compares two channels; whether the second is the first, wherever it stands.
  bool is_again(const Texture& texture, const std::vector<Samples>& samples, int a, int b) {
    const CrossSpectrum cross =
        cross_spectrum(samples[static_cast<std::size_t>(a)].values,
                       samples[static_cast<std::size_t>(b)].values, texture.shape, session_.execution);
    if (std::isnan(cross.correlation)) return false;  // a constant one has failed already
    result_.pairs.push_back({texture.name, a, b, cross, relation_of(cross, fmt::format("channel {}", a))});
    return !result_.pairs.back().relation.empty() && std::abs(cross.peak_correlation) > 0.9;
  }

  /// Once for each texture, in whatever encodings and places it comes.
  void take_into_average(const std::string& name, const Samples& samples, const Analysis& analysis) {
    if (const std::string twin = known_as(name, samples); !twin.empty()) {
      result_.notes.push_back(
          fmt::format("{} is the same texture as {}: no independent sample, so counted once", name, twin));
      return;
    }
    worst_deviation_ = std::max(worst_deviation_, analysis.figures.histogram_max_deviation);
    if (settings_.distribution != Distribution::uniform) {
      worst_distance_ = std::isnan(worst_distance_)
                            ? analysis.figures.distribution_distance
                            : std::max(worst_distance_, analysis.figures.distribution_distance);
    }
    if (!average_) {
      average_ = analysis.power;
    } else if (one_size_ && average_->shape == analysis.power.shape) {
      accumulate(*average_, analysis.power);
    } else {
      one_size_ = false;
    }
  }

  /// The name of an earlier texture whose ranks are these but for rounding, or "".
  std::string known_as(const std::string& name, const Samples& samples) {
    Print print{name, samples.shape, {}};
    const std::vector<double> rank = midranks(samples.values, session_.execution);
    const std::size_t every = std::max<std::size_t>(1, rank.size() / kPrintValues);
    double mean = 0.0, square = 0.0;
    for (std::size_t i = 0; i < rank.size(); i += every) print.rank.push_back(rank[i]);
    for (const double r : print.rank) mean += r / static_cast<double>(print.rank.size());
    for (double& r : print.rank) r -= mean, square += r * r;
    for (double& r : print.rank) r /= std::sqrt(std::max(square, 1e-300));
    for (const Print& other : prints_) {
      if (other.shape != print.shape) continue;
      double correlation = 0.0;
      for (std::size_t i = 0; i < print.rank.size(); ++i) correlation += print.rank[i] * other.rank[i];
      if (correlation > 0.98) return other.name;
    }
    prints_.push_back(std::move(print));
    return {};
  }

  const Settings& settings_;
  Session& session_;
  SpectrumResult& result_;
  std::vector<Print> prints_;
  std::optional<PowerSpectrum> average_;
  bool one_size_ = true;
  double worst_deviation_ = 0.0, worst_distance_ = std::numeric_limits<double>::quiet_NaN();
  int passed_over_ = 0;
};

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
  if (!settings.png.empty()) check_writable(settings.png, SampleType::u8, 1);
  if (!settings.csv.empty()) check_text_writable(settings.csv);
  SpectrumResult result{
      .check = settings.check, .rows = {}, .pairs = {}, .faults = {}, .notes = {}, .file_findings = {}};
  const std::vector<Input> inputs = inputs_of(settings, result);
  session.progress.start("spectrum");
  Analyst analyst(settings, session, result);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    analyst.look_at(inputs[i]);
    session.progress.update(static_cast<double>(i + 1) / static_cast<double>(inputs.size()));
  }
  analyst.finish();
  session.progress.finish();

  if (settings.json) {
    session.output.write_result(to_json(result), true);
  } else if (!session.quiet) {
    session.output.write(to_text(result));
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
      "Slices are taken in the order of their numbers. A file that cannot be read is listed and the others "
      "are "
      "judged all the same; the exit code is the highest of all that went wrong.";
  verb.arguments.positional_list("FILE|DIR", settings->files, file_path(), "Textures, and folders of them.");
  verb.arguments.option("--check", settings->check,
                        choice_of<std::optional<Check>>(
                            {{"blue", Check::blue}, {"white", Check::white}, {"stbn", Check::stbn}}),
                        "Compare with the thresholds of this kind.");
  verb.arguments.option(
      "--distribution", settings->distribution,
      choice_of<Distribution>({{"uniform", Distribution::uniform}, {"triangular", Distribution::triangular}}),
      "How the values should be spread over their range.");
  verb.arguments.option("--channel", settings->channel, channel_or_all(), "The channel to analyse.");
  verb.arguments.flag("--volume", settings->volume, true,
                      "Each folder, or all files together, is one volume of slices.");
  verb.arguments.option(
      "--png", settings->png, file_path(),
      "Write the spectrum (of the average) as a picture: DC in the middle, -50 to +12.5 dB.");
  verb.arguments.option("--csv", settings->csv, file_path(), "Write power and anisotropy by frequency.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
