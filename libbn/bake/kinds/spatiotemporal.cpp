// [[spatiotemporal]]: blue-noise masks in volumes, made for the filter that will average their slices.

#include <algorithm>
#include <utility>

#include "bake/kinds/alike.h"
#include "bake/kinds/all.h"
#include "bake/paths.h"
#include "bn/error.h"
#include "bn/kinds.h"

namespace bn {

using namespace baking;

const Kind& baking::spatiotemporal_kind() {
  static const Kind kind{
      .table = "spatiotemporal",
      .title = "Spatiotemporal masks",
      .verb = "noise spatiotemporal",
      .summary = "Make a blue-noise mask for every frame, by void-and-cluster in a volume.",
      .details =
          "A renderer takes slice t in frame t and averages its frames. Every slice is blue noise, and what "
          "is left of "
          "the error after averaging and blurring is the least: the kernel of void-and-cluster is the "
          "autocorrelation of "
          "these filters. The volume wraps around in space and time.\n\n"
          "Presets: both (series of one pixel, slices and the filtered picture), filtered (the filtered "
          "picture above all; "
          "a pixel alone converges slower), stbn (slices and series, for no filter in particular). "
          "docs/spatiotemporal.md "
          "says which is for whom. Depth 1 makes one mask for a blur.\n\n"
          "A file a slice needs a place for a number in the path, such as slice_%03d.png; .ktx2, .dds, .exr, "
          ".bin and .h hold all slices.",
      .examples =
          {{"bn noise spatiotemporal --size 128x128x64 -o stbn/slice_%03d.png",
            "64 frames, a file each, in a folder of their own"},
           {"bn noise spatiotemporal --size 128x128x64 --preset filtered --temporal ema:0.1 -o filtered.ktx2",
            "for an exponential average that keeps 90 %, one file"},
           {"bn noise spatiotemporal --size 64x64x32 --preset stbn --type 16bit -o stbn.dds",
            "good slices and good series, 65536 levels"},
           {"bn noise spatiotemporal --size 128x128 --spatial box:3 -o for_box_3.png",
            "one mask whose error a 3x3 box leaves least of"}},
      .make = [] { return std::make_shared<SpatiotemporalEntry>(); }};
  return kind;
}

const Kind& SpatiotemporalEntry::kind() const { return baking::spatiotemporal_kind(); }

Options SpatiotemporalEntry::options() {
  using Preset = SpatiotemporalPreset;
  constexpr const char* kMeasured = "the best that was measured";
  Options options;
  options.shape("size", mask.size, 1, 16384, "Width and height of a slice, and how many slices.")
      .in("pixels")
      .must_be_given();
  options.choice<Preset>("preset", mask.preset,
                         {{"both", Preset::both}, {"filtered", Preset::filtered}, {"stbn", Preset::stbn}},
                         "What the mask is best at.");
  options.measured<SpatialFilter>(
      "spatial", mask.spatial, mask.spatial_width,
      {{{"gauss", 0.3, 11.0, 1.3435}, SpatialFilter::gauss},
       {{"box", 1, 64, 3, true}, SpatialFilter::box},
       {{"binomial", 1, 64, 3, true}, SpatialFilter::binomial},
       {{"none"}, SpatialFilter::none}},
      "What blurs a frame: a Gaussian of that standard deviation in pixels, a box of that "
      "side, a binomial filter of that order.");
  options.measured<TemporalFilter>(
      "temporal", mask.temporal, mask.temporal_width,
      {{{"ema", 0.0001, 1.0, 0.1}, TemporalFilter::ema},
       {{"box", 1, 64, 8, true}, TemporalFilter::box},
       {{"gauss", 0.3, 45.0, 1.0}, TemporalFilter::gauss},
       {{"none"}, TemporalFilter::none}},
      "What averages frames: an exponential average with that share of the new frame, so "
      "many frames, a Gaussian of that standard deviation in frames.");
  options.choice<RankScope>(
      "ranks", mask.ranks, {{"slice", RankScope::slice}, {"volume", RankScope::volume}},
      "Whether every level is equally often in each slice, or in all of them together.");
  options.seed("seed", mask.seed, "Another seed gives another mask.");
  options.real("sigma", mask.sigma_px, 0.3, 16.0, "Standard deviation of the kernel's Gaussian in a slice.")
      .in("pixels")
      .if_unset(kMeasured);
  options
      .real("gauss_share", mask.gauss_share, 0.0, 16.0, "Weight of that Gaussian beside a box filter's tent.")
      .if_unset(kMeasured);
  options.real("slice_share", mask.slice_share, 0.0, 1.0, "Share of what voxels see of their own slice only.")
      .if_unset(kMeasured);
  options
      .real("pixel_share", mask.pixel_share, 0.0, 16.0, "Weight of what voxels see of their own pixel only.")
      .if_unset(kMeasured);
  options
      .real("pixel_sigma", mask.pixel_sigma, 0.3, 64.0, "Standard deviation of the latter, along the frames.")
      .in("frames")
      .if_unset(kMeasured);
  return options;
}

void SpatiotemporalEntry::check(const Complain& complain) const {
  constexpr std::int64_t kMostVoxels = std::int64_t{1} << 31;
  if (mask.size.count() > kMostVoxels) {
    complain("size", "has too many voxels", "at most 2^31", "");
    return;
  }
  // The library says what else is wrong.
  try {
    spatiotemporal_kernel(mask);
  } catch (const Error& error) {
    complain_of(error.info(), complain);
  }
}

void SpatiotemporalEntry::default_output(std::size_t output) {
  outputs.at(output).type = natural_type(outputs.at(output).path);
}

Options SpatiotemporalEntry::output_options(std::size_t output) {
  return mask_output_options(outputs.at(output).type);
}

Cost SpatiotemporalEntry::cost(const std::vector<Shape>&, const Execution&) const {
  // Measured on one core of a Zen 5 machine; the seconds only pace the progress bar.
  constexpr double kSecondsPerVoxel = 0.5e-6;
  constexpr std::uint64_t kBytesPerVoxel = 16 + 4;  // the solver; samples
  const auto voxels = static_cast<std::uint64_t>(mask.size.count());
  return {.seconds = static_cast<double>(voxels) * kSecondsPerVoxel, .memory_bytes = voxels * kBytesPerVoxel};
}

Made SpatiotemporalEntry::make(const std::vector<Input>&, const Execution& execution) const {
  const SpatiotemporalOptions used = spatiotemporal_constants(mask);
  Made made;
  const auto add = [&](const char* constant, const std::optional<double>& value) {
    if (value) made.facts.add(constant, *value);
  };
  add("sigma", used.sigma_px);
  add("gauss_share", used.gauss_share);
  add("slice_share", used.slice_share);
  add("pixel_share", used.pixel_share);
  add("pixel_sigma", used.pixel_sigma);
  made.picture = [ranks = spatiotemporal_mask(mask, execution), this](std::size_t output) {
    const SampleType type = outputs.at(output).type;
    if (mask.ranks == RankScope::volume) return Picture{.image = encode_mask(ranks, type)};
    // The ranks of each slice cover the levels by themselves.
    std::vector<Image> slices;
    for (int z = 0; z < ranks.depth(); ++z) {
      Grid<std::uint32_t> slice(ranks.size());
      std::copy(ranks.slice(z).begin(), ranks.slice(z).end(), slice.begin());
      slices.push_back(encode_mask(slice, type));
    }
    return Picture{.image = slices.size() == 1 ? std::move(slices.front()) : stack_slices(slices)};
  };
  return made;
}

Metadata SpatiotemporalEntry::metadata(std::size_t, const std::vector<Input>&,
                                       const std::filesystem::path&) const {
  Metadata metadata;
  metadata.algorithm = "void-and-cluster-volume";
  metadata.algorithm_version = kVolumeMaskVersion;
  metadata.kind = "spatiotemporal-mask";
  metadata.facts.add("seed", mask.seed);
  metadata.facts.add("preset", name_of(mask.preset));
  metadata.facts.add("slices", mask.size.depth);
  metadata.facts.add("ranks", mask.ranks == RankScope::slice ? "slice" : "volume");
  return metadata;
}

}  // namespace bn
