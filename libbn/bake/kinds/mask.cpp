// [[mask]]: blue-noise masks by void-and-cluster, one to four of them in the channels of one picture.

#include "bake/kinds/alike.h"
#include "bake/kinds/all.h"
#include "bake/paths.h"
#include "bn/kinds.h"

namespace bn {

const Kind& baking::mask_kind() {
  static const Kind kind{
      .table = "mask",
      .title = "Blue-noise masks",
      .verb = "noise void-and-cluster",
      .summary = "Make one blue-noise mask by void-and-cluster.",
      .details =
          "A mask ranks its pixels so that the first k of them, for every k, are evenly spread: thresholding "
          "or "
          "dithering with it leaves errors without low frequencies. It tiles without seams. The same options "
          "give the "
          "same bytes on every machine.\n\n"
          "With --channels each channel is a mask of its own: channel c is the one of seed + c. With --count "
          "each file "
          "goes on to the next seeds; its path has a place for the number, such as %03d.",
      .examples = {{"bn noise void-and-cluster --size 256x256 --sigma 1.9 --seed 1 -o mask.png",
                    "a mask, ready to ship"},
                   {"bn noise void-and-cluster --size 128x128 --type 16bit -o mask16.png",
                    "65536 levels for high-quality dither"},
                   {"bn noise void-and-cluster --size 128x128 --channels 4 -o rgba.png",
                    "four independent masks in one picture"},
                   {"bn noise void-and-cluster --size 64x64 --count 32 -o mask_%02d.png",
                    "32 different masks"},
                   {"bn noise void-and-cluster --size 64x64 -o mask.h --json",
                    "a C array, and the figures as JSON"}},
      .make = [] { return std::make_shared<MaskEntry>(); }};
  return kind;
}

const Kind& MaskEntry::kind() const { return baking::mask_kind(); }

Options MaskEntry::options() {
  Options options;
  options.word(
      "method", {"void-and-cluster"}, "The algorithm.", [] { return Value(std::string("void-and-cluster")); },
      [](const Value&) {});
  options.size("size", void_and_cluster.size, 1, 16384, "Width and height.").in("pixels").must_be_given();
  options
      .real("sigma", void_and_cluster.sigma_px, 0.3, 16.0,
            "Standard deviation of the Gaussian that measures crowding; 1.5 to 1.9 are usual.")
      .in("pixels");
  options.real("initial_density", void_and_cluster.initial_density, 0.0, 0.5,
               "Share of the ranks ordered by removing clusters instead of filling voids; 0 suits best.");
  options.seed("seed", void_and_cluster.seed, "Another seed gives another mask.");
  options
      .integer("cutoff", void_and_cluster.cutoff_px, 0, 64,
               "Radius at which the Gaussian is cut; 0: where it rounds to zero.")
      .in("pixels");
  options.integer("channels", channels, 1, 4, "Masks in one picture: channel c is the mask of seed + c.")
      .from_edition(2);
  return options;
}

void MaskEntry::take_later_seeds(int number) {
  void_and_cluster.seed += static_cast<std::uint64_t>(number) * static_cast<std::uint64_t>(channels);
}

void MaskEntry::default_output(std::size_t output) {
  outputs.at(output).type = baking::natural_type(outputs.at(output).path);
}

Options MaskEntry::output_options(std::size_t output) {
  return baking::mask_output_options(outputs.at(output).type);
}

Cost MaskEntry::cost(const std::vector<Shape>&, const Execution&) const {
  // Measured on one core of a Zen 5 machine; the seconds only pace the progress bar.
  constexpr double kSecondsPerPixel = 0.3e-6;
  constexpr std::uint64_t kBytesPerPixel = 12 + 4, kBytesPerSample = 4 + 4;  // the solver; ranks and samples
  const auto pixels = static_cast<std::uint64_t>(void_and_cluster.size.area()),
             masks = static_cast<std::uint64_t>(channels);
  return {.seconds = static_cast<double>(pixels * masks) * kSecondsPerPixel,
          .memory_bytes = pixels * (kBytesPerPixel + (masks - 1) * kBytesPerSample + 4)};
}

Made MaskEntry::make(const std::vector<Input>&, const Execution& execution) const {
  std::vector<Grid<std::uint32_t>> ranks;
  for (int c = 0; c < channels; ++c) {
    VoidAndClusterOptions of_channel = void_and_cluster;
    of_channel.seed += static_cast<std::uint64_t>(c);
    Execution part = execution;
    if (execution.progress) part.progress = [&](double done) { execution.progress((c + done) / channels); };
    ranks.push_back(bn::void_and_cluster(of_channel, part));
  }
  return {.picture = [ranks = std::move(ranks), this](std::size_t output) {
    return Picture{.image = encode_masks(ranks, outputs.at(output).type)};
  }};
}

Metadata MaskEntry::metadata(std::size_t, const std::vector<Input>&, const std::filesystem::path&) const {
  Metadata metadata;
  metadata.algorithm = "void-and-cluster";
  metadata.algorithm_version = kVoidAndClusterVersion;
  metadata.kind = "mask";
  metadata.facts.add("seed", void_and_cluster.seed);
  return metadata;
}

}  // namespace bn
