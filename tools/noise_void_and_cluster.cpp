// bn noise void-and-cluster: one blue-noise mask.

#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {

Verb noise_void_and_cluster_verb() {
  struct Settings {
    VoidAndClusterOptions options;
    std::optional<SampleType> type;
    std::filesystem::path out;
    bool json = false;
  };
  const auto settings = std::make_shared<Settings>();
  auto& options = settings->options;
  Verb verb;
  verb.name = "noise void-and-cluster";
  verb.summary = "Make one blue-noise mask by void-and-cluster.";
  verb.examples = {
      {"bn noise void-and-cluster --size 256x256 --sigma 1.9 --seed 1 -o mask.png", "a mask, ready to ship"},
      {"bn noise void-and-cluster --size 128x128 --type 16bit -o mask16.png",
       "65536 levels for high-quality dither"},
      {"bn noise void-and-cluster --size 64x64 -o mask.h --json", "a C array, and the figures as JSON"}};
  verb.details =
      "A mask ranks its pixels so that the first k of them, for every k, are evenly spread: thresholding or "
      "dithering "
      "with it leaves errors without low frequencies. It tiles without seams. The same options give the same "
      "bytes on "
      "every machine.";
  verb.arguments.option("--size", options.size, extent_in(1, 16384), "Width and height in pixels.");
  verb.arguments.option("--sigma", options.sigma_px, real_in(0.3, 16, "pixels"),
                        "Standard deviation of the Gaussian that measures crowding; 1.5 to 1.9 are usual.");
  verb.arguments.option(
      "--initial-density", options.initial_density, real_in(0, 0.5),
      "Share of the ranks ordered by removing clusters instead of filling voids; 0 suits best.");
  verb.arguments.option("--cutoff", options.cutoff_px, integer_in(0, 64),
                        "Radius in pixels at which the Gaussian is cut; 0: where it rounds to zero.");
  verb.arguments.option("--seed", options.seed, seed_value(), "Another seed gives another mask.");
  verb.arguments.option(
      "--type", settings->type,
      choice_of<std::optional<SampleType>>(
          {{"8bit", SampleType::u8}, {"16bit", SampleType::u16}, {"float", SampleType::f32}}),
      "Sample type of the file; where it is not given, float for .exr and 8bit for all others.");
  verb.arguments.required_option("--out", settings->out, file_path(),
                                 "The file to write; .png, .exr, .tif, .h or .bin decides the format.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print the result as JSON.");
  verb.run = [settings](Session& session) {
    const SampleType type =
        settings->type.value_or(settings->out.extension() == ".exr" ? SampleType::f32 : SampleType::u8);
    MaskEntry entry;
    entry.name = "mask";
    entry.options = settings->options;
    entry.outputs = {{.path = settings->out.string(), .type = type}};
    const JobRecord job = make_mask(entry, session.execution_showing("void-and-cluster"));
    session.progress.finish();
    for (const auto& note : job.notes) session.progress.note(note);
    session.output.write_result({{"file", settings->out.string()},
                                 {"size", to_json(settings->options.size)},
                                 {"type", name_of(type)},
                                 {"sigma", settings->options.sigma_px},
                                 {"initial_density", settings->options.initial_density},
                                 {"cutoff", settings->options.cutoff_px},
                                 {"seed", settings->options.seed},
                                 {"pixel_hash", job.files.front().pixel_hash},
                                 {"seconds", rounded_seconds(job.seconds)}},
                                settings->json);
  };
  return verb;
}

}  // namespace bn::tools
