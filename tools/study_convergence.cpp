// bn study convergence: which samples a renderer's frames converge with best.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bn/report.h"
#include "bn/spectrum.h"
#include "bn/texture.h"
#include "bn/volume.h"
#include "bn_study/convergence_study.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  std::vector<std::filesystem::path> stacks;
  Extent size{128, 128};
  int slices = 64;
  int frames = 64;
  int reset = 16;
  double sigma = 1.3435;
  double alpha = 0.1;
  std::uint64_t seed = 1;
  bool files_only = false;
  std::filesystem::path out;
  bool json = false;
};

/// The figures of one source.
struct Row {
  std::vector<Convergence> errors;  ///< heavisides first
  std::array<double, 4> bands{};    ///< of a slice
  double power_at_0 = 0.0;          ///< of a pixel's series
};

/// A stack, or a strip of square slices.
Image read_stack(const std::filesystem::path& path, const Execution& execution) {
  const Image image = read_volume(path, {}, execution).image;
  const auto [width, height] = image.size;
  if (image.depth > 1 || width == height || std::max(width, height) % std::min(width, height) != 0)
    return image;
  return read_volume(path, {.columns = std::max(1, width / height)}, execution).image;
}

/// The first channel as samples in [0, 1): of integers, the middles of the levels.
Grid<float> samples_of_file(const std::filesystem::path& path, const Execution& execution) {
  const Image image = read_stack(path, execution);
  const ChannelSamples channel = samples_of_channel(image, 0);
  const double middle = image.type == SampleType::u8 || image.type == SampleType::u16 ? 0.5 : 0.0;
  Grid<float> samples(image.shape());
  std::transform(channel.value.begin(), channel.value.end(), samples.begin(), [&](double value) {
    return static_cast<float>((value + middle - channel.low) / (channel.high - channel.low));
  });
  return samples;
}

Row measure(const SampleSource& source, const ConvergenceOptions& options, const Execution& execution) {
  Row row;
  row.errors = study_convergence(source, options, execution);
  const std::vector<double> values(source.first.begin(), source.first.end());
  const auto figures = analyse(values, source.first.shape(), 0.0, 1.0, execution).figures;
  std::copy_n(figures.bands.mean.begin(), row.bands.size(), row.bands.begin());
  row.power_at_0 = series_power(source.first)[0];
  return row;
}

/// The frames that tables show, of those there are.
std::vector<std::size_t> shown_frames(const std::vector<std::size_t>& wanted, int frames) {
  std::vector<std::size_t> shown;
  for (const std::size_t frame : wanted) {
    if (frame <= static_cast<std::size_t>(frames)) shown.push_back(frame);
  }
  return shown;
}

std::string error_table(const std::vector<Row>& rows, int frames) {
  const auto filtered = shown_frames({1, 16, 32, 64}, frames), mean = shown_frames({4, 16, 64}, frames);
  std::string text = "| random steps";
  for (const std::size_t frame : filtered) text += fmt::format(" | filtered {}", frame);
  for (const std::size_t frame : mean) text += fmt::format(" | mean {}", frame);
  text += " | bands of a slice | in time at 0 |\n|---";
  for (std::size_t i = 0; i < filtered.size() + mean.size() + 2; ++i) text += "|---";
  text += "|\n";
  for (const Row& row : rows) {
    const Convergence& steps = row.errors.front();
    text += "| " + steps.source;
    for (const std::size_t frame : filtered) text += fmt::format(" | {:.4f}", steps.filtered[frame - 1]);
    for (const std::size_t frame : mean) text += fmt::format(" | {:.4f}", steps.mean[frame - 1]);
    text += fmt::format(" | {:.2g} {:.2g} {:.2g} {:.2g} | {:.2g} |\n", row.bands[0], row.bands[1],
                        row.bands[2], row.bands[3], row.power_at_0);
  }
  return text;
}

/// The last frames' errors by integrand.
std::string integrand_table(const std::vector<Row>& rows) {
  std::string text = "| filtered, last";
  for (const Convergence& c : rows.front().errors) text += " | " + c.integrand;
  text += " |\n|---";
  for (std::size_t i = 0; i < rows.front().errors.size(); ++i) text += "|---";
  text += "|\n";
  for (const Row& row : rows) {
    text += "| " + row.errors.front().source;
    for (const Convergence& c : row.errors) text += fmt::format(" | {:.4f}", c.filtered.back());
    text += " |\n";
  }
  return text;
}

/// What moves, and what denoisers leave, for random steps.
std::string denoiser_table(const std::vector<Row>& rows) {
  std::string text = "| random steps | begun later | moving";
  for (const std::string_view denoiser : kDenoisers) text += fmt::format(" | {}", denoiser);
  text += " |\n|---|---|---";
  for (std::size_t i = 0; i < kDenoisers.size(); ++i) text += "|---";
  text += "|\n";
  for (const Row& row : rows) {
    const Convergence& steps = row.errors.front();
    text += fmt::format("| {} | {:.4f} | {:.4f}", steps.source, steps.later.back(), steps.moving);
    for (const double error : steps.denoised) text += fmt::format(" | {:.4f}", error);
    text += " |\n";
  }
  return text;
}

std::string tables(const std::vector<Row>& rows, int frames) {
  return error_table(rows, frames) + "\n" + integrand_table(rows) + "\n" + denoiser_table(rows);
}

Json json_of(const std::vector<Row>& rows) {
  Json result = Json::array();
  for (const Row& row : rows) {
    Json errors = Json::array();
    for (const Convergence& c : row.errors) {
      errors.push_back({{"integrand", c.integrand},
                        {"mean", c.mean},
                        {"filtered", c.filtered},
                        {"later", c.later},
                        {"moving", c.moving},
                        {"denoised", c.denoised}});
    }
    result.push_back({{"source", row.errors.front().source},
                      {"bands", row.bands},
                      {"temporal_power_at_0", row.power_at_0},
                      {"errors", errors}});
  }
  return result;
}

constexpr std::string_view kFigures =
#include "tools/study_convergence.gnuplot.inc"
    ;

/// The names of sources for gnuplot, which draws them in this order.
std::string figures(const std::vector<Row>& rows) {
  std::string names = fmt::format("count = {0}\narray sources[{0}]\n", rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::string name = rows[i].errors.front().source;
    std::erase_if(name, [](char c) { return c == '"' || c == '\\' || c == '\n'; });
    names += fmt::format("sources[{}] = \"{}\"\n", i + 1, name);
  }
  return names + std::string(kFigures);
}

void write_folder(const Settings& settings, const std::vector<Row>& rows, Session& session) {
  std::vector<Convergence> all;
  for (const Row& row : rows) all.insert(all.end(), row.errors.begin(), row.errors.end());
  write_text_file(settings.out / "convergence.csv", convergence_csv(all));
  write_text_file(settings.out / "denoised.csv", denoised_csv(all));
  write_text_file(settings.out / "tables.md", tables(rows, settings.frames));
  const std::string failure = draw_figures(settings.out, figures(rows), session.execution);
  if (!failure.empty()) session.progress.note("no figures: " + failure);
}

void run(const Settings& settings, Session& session) {
  // Files first: what cannot be read ends the run before the work.
  std::vector<SampleSource> sources;
  for (const auto& path : settings.stacks)
    sources.push_back(source_of_stack(path.stem().string(), samples_of_file(path, session.execution)));
  if (!settings.files_only) {
    auto made = sample_sources({settings.size.width, settings.size.height, settings.slices}, settings.seed,
                               session.execution_showing("masks"));
    sources.insert(sources.begin(), std::make_move_iterator(made.begin()),
                   std::make_move_iterator(made.end()));
  }
  if (sources.empty()) {
    throw Error({.code = ErrorCode::usage,
                 .what = "nothing to measure",
                 .where = "--files-only",
                 .limit = "",
                 .remedy = "name a stack"});
  }
  if (!settings.out.empty()) make_folder(settings.out);
  const ConvergenceOptions options{
      .filter = {.taps = settings.sigma > 0.0 ? FrameFilter::gaussian_taps(settings.sigma)
                                              : std::vector<double>(),
                 .alpha = settings.alpha},
      .frames = settings.frames,
      .reset = std::min(settings.reset, settings.frames)};
  std::vector<Row> rows;
  for (const SampleSource& source : sources)
    rows.push_back(measure(source, options, session.execution_showing(source.name)));
  session.progress.finish();
  if (!settings.out.empty()) write_folder(settings, rows, session);
  if (settings.json) return session.output.write_result(json_of(rows), true);
  session.output.tell(tables(rows, settings.frames));
}

}  // namespace

Verb study_convergence_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "study convergence";
  verb.summary = "Measure which noise a renderer's frames converge with best.";
  verb.examples = {
      {"bn study convergence -o convergence", "the tables and figures of docs/spatiotemporal.md, minutes"},
      {"bn study convergence stbn/ fast.png --files-only --json", "two stacks of any tool, for a script"}};
  verb.details =
      "A renderer evaluates a function at a pixel's number of a frame, blurs each frame and averages frames "
      "exponentially (filtered), or averages each pixel's frames alone (mean). What is left of the error is "
      "measured, root mean square over pixels, for random steps [x < t], a step, a ramp, and a triangle, a "
      "disk, a bilinear function and a Gaussian of two numbers.\n\n"
      "Sources: white noise; one mask, shifted or moved on by the golden ratio; R2, Halton and Sobol points "
      "rotated by masks; the presets of bn noise spatiotemporal; and every STACK, which is a folder or "
      "pattern of slices, a file of slices, or a strip. Moving: each pixel loses its average every --reset "
      "frames, at a time of its own. Begun later: a third of the slices after the first. Denoisers: what "
      "they leave of the exponential average.\n\n"
      "The folder gets convergence.csv (every frame), denoised.csv, tables.md, and figures as SVG where "
      "gnuplot is installed.";
  verb.arguments.optional_list("STACK", settings->stacks, texture_path(),
                               "Slices of any tool: a folder, a pattern, a file.");
  verb.arguments.option("--size", settings->size, extent_in(8, 1024), "Width and height of what is made.");
  verb.arguments.option("--slices", settings->slices, integer_in(2, 1024), "Slices of what is made.");
  verb.arguments.option("--frames", settings->frames, integer_in(2, 4096), "Frames that are rendered.");
  verb.arguments.option("--reset", settings->reset, integer_in(1, 4096), "Frames that a moving pixel keeps.");
  verb.arguments.option("--sigma", settings->sigma, real_in(0.0, 11.0, "pixels"),
                        "Standard deviation of the blur; 0 for none.");
  verb.arguments.option("--alpha", settings->alpha, real_in(0.0001, 1.0),
                        "Share of the new frame in the exponential average.");
  verb.arguments.option("--seed", settings->seed, seed_value(), "Another seed gives other noise.");
  verb.arguments.flag("--files-only", settings->files_only, true, "Measure the stacks alone.");
  verb.arguments.option("--out", settings->out, folder_path(), "The folder to write; made if missing.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
