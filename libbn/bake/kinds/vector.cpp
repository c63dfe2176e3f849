// [[vector]]: blue-noise masks of vectors and directions, made for the filter that will average their slices.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "bake/kinds/alike.h"
#include "bake/kinds/all.h"
#include "bake/paths.h"
#include "bn/kinds.h"

namespace bn {

using namespace baking;

namespace {

bool is_direction(VectorValues values) {
  return values == VectorValues::sphere || values == VectorValues::hemisphere;
}

/// What channels hold: of the circle, its fraction of a turn.
std::array<float, 4> channels_of(VectorValues values, std::uint32_t place) {
  if (values == VectorValues::circle) return {std::ldexp(static_cast<float>(place >> 8), -24)};
  return vector_value(values, place);
}

/// 8 and 16 bit: floor(256 u), floor(65536 u), of directions u = (v + 1) / 2; floats: v.
Image encode(const Grid<std::uint32_t>& places, VectorValues values, int channels, SampleType type) {
  const bool whole = type == SampleType::u8 || type == SampleType::u16;
  Image image;
  image.size = places.size();
  image.depth = places.depth();
  image.channels = channels;
  image.type = whole ? type : SampleType::f32;
  image.samples.resize(places.count() * static_cast<std::size_t>(channels) * bytes_per_sample(image.type));
  std::byte* to = image.samples.data();
  const float levels = type == SampleType::u8 ? 256.0f : 65536.0f;
  for (const std::uint32_t place : places) {
    const std::array<float, 4> value = channels_of(values, place);
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c, to += bytes_per_sample(image.type)) {
      const float share = is_direction(values) ? (value[c] + 1.0f) * 0.5f : value[c];
      const auto level = static_cast<std::uint16_t>(std::min(share * levels, levels - 1.0f));
      const auto byte = static_cast<std::uint8_t>(level);
      if (type == SampleType::u8) {
        std::memcpy(to, &byte, sizeof byte);
      } else if (type == SampleType::u16) {
        std::memcpy(to, &level, sizeof level);
      } else {
        std::memcpy(to, &value[c], sizeof value[c]);
      }
    }
  }
  return type == SampleType::f16 ? to_half(image) : image;
}

}  // namespace

const Kind& baking::vector_kind() {
  static const Kind kind{
      .table = "vector",
      .title = "Vector masks",
      .verb = "noise vector",
      .summary = "Make a blue-noise mask of vectors or directions for every frame.",
      .details =
          "Each pixel of slice t has a vector for frame t: a point of a light, a direction. Whatever is "
          "computed "
          "from it, what is left of the error after blurring a frame and averaging frames is small. A scalar "
          "mask "
          "is pushed through a curve that fills the space of the values; then pixels of a slice exchange "
          "their "
          "values as long as that helps.\n\n"
          "Channels: vec2, vec3, vec4 as they are; circle one, the fraction of a turn; sphere and hemisphere "
          "x, y, "
          "z, in 8 and 16 bit files (v + 1) / 2. The hemisphere is around z, with a density in proportion to "
          "z. "
          "Samples of whole numbers are floors: add a half before dividing by 256 or 65536.\n\n"
          "docs/vector_masks.md says what presets and shares do for vectors. Depth 1 makes one mask for a "
          "blur.",
      .examples = {{"bn noise vector --values vec2 --size 128x128x32 -o vec2/slice_%03d.png",
                    "points of the square, a file a frame"},
                   {"bn noise vector --values hemisphere --size 64x64x32 --type 16bit -o cosine.ktx2",
                    "cosine-weighted directions, one file"},
                   {"bn noise vector --values vec2 --size 128x128x32 --preset filtered --slice-share 0.85 "
                    "--sigma 1.5 "
                    "--budget 40 -o early/slice_%03d.png",
                    "the best first frames"},
                   {"bn noise vector --values sphere --size 64x64 --budget 0 -o curve.exr",
                    "the curve alone, at once"}},
      .make = [] { return std::make_shared<VectorEntry>(); }};
  return kind;
}

const Kind& VectorEntry::kind() const { return baking::vector_kind(); }

Options VectorEntry::options() {
  using Values = VectorValues;
  Options options;
  options.choice<Values>("values", vectors.values,
                         {{"vec2", Values::vec2},
                          {"vec3", Values::vec3},
                          {"vec4", Values::vec4},
                          {"circle", Values::circle},
                          {"sphere", Values::sphere},
                          {"hemisphere", Values::hemisphere}},
                         "What a pixel has: a point of the unit square or cube, or a direction.");
  options.choice<VectorEnergy>(
      "energy", vectors.energy,
      {{"half_spaces", VectorEnergy::half_spaces}, {"georgiev_fajardo", VectorEnergy::georgiev_fajardo}},
      "How unlike two values are: how often half-spaces part them, or as Georgiev and Fajardo have it.");
  add_filter_options(options, vectors.mask,
                     "Whether values are spread evenly in each slice, or in all of them together.");
  options.integer("budget", vectors.budget, 0, kMostVectorBudget,
                  "How often each pixel looks for a better value, on average; 0: the curve alone.");
  return options;
}

void VectorEntry::check(const Complain& complain) const { check_filter_options(vectors.mask, complain); }

void VectorEntry::default_output(std::size_t output) {
  outputs.at(output).type = natural_type(outputs.at(output).path);
}

Options VectorEntry::output_options(std::size_t output) {
  return mask_output_options(outputs.at(output).type);
}

int VectorEntry::output_channels(std::size_t) const {
  return vectors.values == VectorValues::circle ? 1 : vector_components(vectors.values);
}

Cost VectorEntry::cost(const std::vector<Shape>&, const Execution&) const {
  // Measured on one core of a Sapphire Rapids machine; the seconds only pace the progress bar.
  constexpr double kSecondsPerVisit = 1.5e-6;
  constexpr double kSecondsPerSlice = 0.05e-6;  // of those that a visit looks at
  constexpr std::uint64_t kBytesPerVoxel = 60;
  const auto voxels = static_cast<std::uint64_t>(vectors.mask.size.count());
  const double visit = kSecondsPerVisit + kSecondsPerSlice * vectors.mask.size.depth;
  return {.seconds = static_cast<double>(voxels) * (0.5e-6 + static_cast<double>(vectors.budget) * visit),
          .memory_bytes = voxels * kBytesPerVoxel};
}

Made VectorEntry::make(const std::vector<Input>&, const Execution& execution) const {
  Made made;
  add_constants(made.facts, vectors.mask);
  made.picture = [places = vector_mask(vectors, execution), this](std::size_t output) {
    return Picture{.image = encode(places, vectors.values, output_channels(output), outputs.at(output).type)};
  };
  return made;
}

Metadata VectorEntry::metadata(std::size_t, const std::vector<Input>&, const std::filesystem::path&) const {
  Metadata metadata;
  metadata.algorithm = "vector-mask";
  metadata.algorithm_version = kVectorMaskVersion;
  metadata.kind = "vector-mask";
  metadata.facts.add("seed", vectors.mask.seed);
  metadata.facts.add("values", name_of(vectors.values));
  metadata.facts.add("energy", name_of(vectors.energy));
  metadata.facts.add("preset", name_of(vectors.mask.preset));
  metadata.facts.add("slices", vectors.mask.size.depth);
  metadata.facts.add("ranks", vectors.mask.ranks == RankScope::slice ? "slice" : "volume");
  metadata.facts.add("budget", vectors.budget);
  return metadata;
}

}  // namespace bn
