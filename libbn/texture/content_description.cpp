// What the channels of a texture mean and how its tiles or slices are laid out, in sentences for people: for
// the comment of a .h and for bn info.

#include <fmt/format.h>

#include <cmath>

#include "bn/texture.h"

namespace bn {
namespace {

std::string mask_samples(SampleType type) {
  switch (type) {
    case SampleType::u8:
      return "floor(rank x 256 / N)";
    case SampleType::u16:
      return "floor(rank x 65536 / N)";
    case SampleType::f32:
    case SampleType::f16:
      break;
  }
  return "(rank + 0.5) / N";
}

void add_mask(std::vector<std::string>& sentences, const Image& image) {
  sentences.push_back(fmt::format("{} a blue-noise mask: samples are {}, rank 0..N-1, N = {} pixels.",
                                  image.channels == 1 ? "The channel is" : "Each channel is",
                                  mask_samples(image.type), image.shape().count()));
}

void add_spatiotemporal(std::vector<std::string>& sentences, const Image& image, const Metadata& metadata) {
  const bool by_slice = metadata.facts.get<std::string>("ranks") == "slice";
  sentences.push_back(fmt::format(
      "Slice t is the blue-noise mask of frame t: samples are {}, rank 0..N-1 {}.", mask_samples(image.type),
      by_slice ? fmt::format("in its slice, N = {} pixels", image.size.area())
               : std::string("in the volume, N its voxels")));
}

void add_vectors(std::vector<std::string>& sentences, const Image& image, const Metadata& metadata) {
  const std::string values = metadata.facts.get<std::string>("values").value_or("vectors");
  const bool directions = values == "sphere" || values == "hemisphere";
  const int levels = image.type == SampleType::u8 ? 256 : 65536;
  const bool whole = image.type == SampleType::u8 || image.type == SampleType::u16;
  const std::string share = whole ? fmt::format("(sample + 0.5) / {}", levels) : "the sample";
  sentences.push_back(
      fmt::format("{}of values {}: {} is {}.",
                  image.depth > 1 ? "Slice t is the blue-noise mask of frame t, " : "A blue-noise mask ",
                  values, values == "circle" ? "the fraction of a turn" : "a component",
                  directions && whole ? fmt::format("2 {} - 1", share) : share));
}

void add_moves(std::vector<std::string>& sentences, const Image& image, const Metadata& metadata) {
  const bool gather = metadata.facts.get<std::string>("form") == "gather";
  const bool volume = metadata.facts.get<int>("step_z").has_value();
  const bool shifted = image.type == SampleType::u8;
  const char* const shift = shifted ? " + 128" : "";
  std::string channels = fmt::format("Channel 0 is x{}, channel 1 is y{}", shift, shift);
  if (image.channels > 2) channels += volume ? fmt::format(", channel 2 is z{}", shift) : ", channel 2 is 0";
  if (image.channels > 3) channels += fmt::format(", channel 3 is {}", shifted ? 255 : 1);
  sentences.push_back(
      fmt::format("{}: {}, in pixels.", channels,
                  gather ? "where the seed of a pixel comes from" : "where the seed of a pixel goes"));
  if (image.depth > 1 && !volume) {
    sentences.push_back(
        metadata.facts.find("to")
            ? "Slice t carries seeds from slice t of its source to slice t of the other mask."
            : "Slice t carries seeds from slice t of its source to the next one, the last to the first.");
  }
}

}  // namespace

std::vector<std::string> content_description(const Image& image, const Metadata& metadata) {
  std::vector<std::string> sentences;
  const bool atlas = metadata.kind == "retarget-atlas";
  if (metadata.kind == "mask") add_mask(sentences, image);
  if (metadata.kind == "spatiotemporal-mask") add_spatiotemporal(sentences, image, metadata);
  if (metadata.kind == "vector-mask") add_vectors(sentences, image, metadata);
  if (atlas || metadata.kind == "retarget-tile") add_moves(sentences, image, metadata);
  if (atlas && !metadata.tiles.empty()) {
    const int count = static_cast<int>(metadata.tiles.size()) / image.depth;
    const int columns = static_cast<int>(std::lround(std::sqrt(count)));
    if (columns * columns == count && image.size.width % columns == 0 && image.size.height % columns == 0) {
      const Offset first = metadata.tiles.front().motion, last = metadata.tiles.back().motion;
      sentences.push_back(
          fmt::format("An atlas of {}x{} tiles of {}x{} pixels, row by row: motions x {}..{} from left to "
                      "right, y {}..{} "
                      "downwards.",
                      columns, columns, image.size.width / columns, image.size.height / columns, first.x,
                      last.x, first.y, last.y));
    }
  }
  if (image.depth > 1) {
    sentences.push_back(
        fmt::format("{} slices of {}x{} pixels, one after the other; the volume wraps in z too.", image.depth,
                    image.size.width, image.size.height));
  }
  return sentences;
}

}  // namespace bn
