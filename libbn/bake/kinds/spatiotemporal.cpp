// [[spatiotemporal]]: blue-noise masks in volumes, made for the filter that will average their slices.

#include <algorithm>
#include <utility>

#include "bake/kinds/alike.h"
#include "bake/kinds/all.h"
#include "bake/paths.h"
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
  Options options;
  add_filter_options(options, mask,
                     "Whether every level is equally often in each slice, or in all of them together.");
  return options;
}

void SpatiotemporalEntry::check(const Complain& complain) const { check_filter_options(mask, complain); }

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
  Made made;
  add_constants(made.facts, mask);
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
