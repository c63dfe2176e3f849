// Slices and channels: taking images apart and putting them together, sample by sample as they are.

#include <fmt/format.h>

#include <cstring>

#include "bn/texture.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn {

using texture::fail_input;

Image slice_of(const Image& volume, int z) {
  texture::check_image(volume, "slice_of");
  if (z < 0 || z >= volume.depth) {
    fail_input("slice_of", fmt::format("slice {}", z), fmt::format("0..{}", volume.depth - 1));
  }
  const std::size_t bytes = volume.samples.size() / static_cast<std::size_t>(volume.depth);
  const auto first =
      volume.samples.begin() + static_cast<std::ptrdiff_t>(bytes * static_cast<std::size_t>(z));
  return {.size = volume.size,
          .channels = volume.channels,
          .type = volume.type,
          .samples = {first, first + static_cast<std::ptrdiff_t>(bytes)}};
}

Image stack_slices(std::span<const Image> slices) {
  if (slices.empty()) fail_input("stack_slices", "no slices", fmt::format("1..{}", texture::kMaxDepth));
  texture::check_depth(static_cast<std::int64_t>(slices.size()), "stack_slices");
  Image volume{.size = slices[0].size,
               .depth = static_cast<int>(slices.size()),
               .channels = slices[0].channels,
               .type = slices[0].type,
               .samples = {}};
  volume.samples.reserve(slices[0].samples.size() * slices.size());
  for (std::size_t z = 0; z < slices.size(); ++z) {
    const std::string where = fmt::format("stack_slices, slice {}", z);
    texture::check_image(slices[z], where);
    if (slices[z].depth > 1) fail_input(where, texture::describe(slices[z]), "one slice");
    if (!texture::same_layout(slices[z], slices[0])) {
      fail_input(where, texture::describe(slices[z]), texture::describe(slices[0]) + ", as the first");
    }
    volume.samples.insert(volume.samples.end(), slices[z].samples.begin(), slices[z].samples.end());
  }
  return volume;
}

Image pack_channels(std::span<const ChannelRef> channels) {
  if (channels.empty())
    fail_input("pack_channels", "no channels", fmt::format("1..{}", texture::kMaxChannels));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::string where = fmt::format("pack_channels, channel {}", c);
    if (channels[c].image == nullptr) fail_input(where, "no image");
    const Image& image = *channels[c].image;
    const Image& first = *channels[0].image;
    texture::check_image(image, where);
    if (channels[c].channel < 0 || channels[c].channel >= image.channels) {
      fail_input(where, fmt::format("the image has no channel {}", channels[c].channel),
                 fmt::format("0..{}", image.channels - 1));
    }
    if (image.shape() != first.shape() || image.type != first.type) {
      fail_input(where, texture::describe(image), texture::describe(first) + ", as the first");
    }
  }
  const Image& first = *channels[0].image;
  texture::check_shape(first.size.width, first.size.height, static_cast<std::int64_t>(channels.size()),
                       "pack_channels");
  Image packed{.size = first.size,
               .depth = first.depth,
               .channels = static_cast<int>(channels.size()),
               .type = first.type,
               .samples = {}};
  packed.samples.resize(texture::sample_bytes(packed.shape(), packed.channels, packed.type));
  const std::size_t sample = bytes_per_sample(packed.type);
  const auto pixels = static_cast<std::size_t>(packed.shape().count());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::size_t from_stride = sample * static_cast<std::size_t>(channels[c].image->channels);
    const std::byte* from =
        channels[c].image->samples.data() + sample * static_cast<std::size_t>(channels[c].channel);
    std::byte* to = packed.samples.data() + c * sample;
    for (std::size_t i = 0; i < pixels; ++i) {
      std::memcpy(to + i * channels.size() * sample, from + i * from_stride, sample);
    }
  }
  return packed;
}

}  // namespace bn
