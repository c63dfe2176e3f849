#include "texture/image.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <memory>

#include "texture/error.h"

namespace bn {

// Samples are kept in native order and hashed, written and read as they lie in memory; files and
// hashes are little-endian. A big-endian machine needs a swap in pixel_hash() and bin_format.cpp.
static_assert(std::endian::native == std::endian::little, "libbn supports little-endian machines");

std::string_view name_of(SampleType type) {
  switch (type) {
    case SampleType::u8:
      return "8bit";
    case SampleType::u16:
      return "16bit";
    case SampleType::f32:
      return "float";
    case SampleType::f16:
      return "half";
  }
  return "unknown";
}

std::size_t bytes_per_sample(SampleType type) {
  return type == SampleType::u8 ? 1 : type == SampleType::f32 ? 4 : 2;
}

std::string pixel_hash(const Image& image) {
  texture::check_image(image, "pixel_hash");
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  if (!state) throw std::bad_alloc();
  const std::uint32_t head[4] = {
      static_cast<std::uint32_t>(image.size.width), static_cast<std::uint32_t>(image.size.height),
      static_cast<std::uint32_t>(image.channels), static_cast<std::uint32_t>(image.type)};
  XXH3_128bits_reset(state.get());
  XXH3_128bits_update(state.get(), head, sizeof head);
  // Pictures were hashed before there were volumes, and their hashes are in files.
  const auto depth = static_cast<std::uint32_t>(image.depth);
  if (depth > 1) XXH3_128bits_update(state.get(), &depth, sizeof depth);
  XXH3_128bits_update(state.get(), image.samples.data(), image.samples.size());
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("xxh3-128:{:016x}{:016x}", hash.high64, hash.low64);
}

namespace texture {

void check_shape(std::int64_t width, std::int64_t height, std::int64_t channels, std::string_view where) {
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    fail_input(std::string(where), fmt::format("an image of {}x{} pixels", width, height),
               fmt::format("1..{} pixels a side", kMaxSide));
  }
  if (channels < 1 || channels > kMaxChannels) {
    fail_input(std::string(where), fmt::format("an image of {} channels", channels),
               fmt::format("1..{} channels", kMaxChannels));
  }
}

void check_depth(std::int64_t depth, std::string_view where) {
  if (depth >= 1 && depth <= kMaxDepth) return;
  fail_input(std::string(where), fmt::format("a volume of {} slices", depth),
             fmt::format("1..{} slices", kMaxDepth));
}

std::uint64_t sample_bytes(Shape shape, int channels, SampleType type) {
  return static_cast<std::uint64_t>(shape.count()) * static_cast<std::uint64_t>(channels) *
         bytes_per_sample(type);
}

std::string describe(const Image& image) {
  return fmt::format("{}x{}{} pixels, {} channel{}, {}", image.size.width, image.size.height,
                     image.depth > 1 ? fmt::format("x{}", image.depth) : "", image.channels,
                     image.channels == 1 ? "" : "s", name_of(image.type));
}

bool same_layout(const Image& a, const Image& b) {
  return a.shape() == b.shape() && a.channels == b.channels && a.type == b.type;
}

void check_decoded_size(std::uint64_t decoded_bytes, std::uint64_t file_bytes, std::string_view where) {
  // Deflate packs no better than 1032:1; at one bit a sample, expanded to eight, that makes 8256.
  constexpr std::uint64_t kMaxRatio = 10000, kSmall = 1 << 20;
  if (decoded_bytes <= kSmall || decoded_bytes / kMaxRatio <= file_bytes) return;
  fail_input(std::string(where),
             fmt::format("its {} bytes cannot hold the {} bytes of samples that its header claims",
                         file_bytes, decoded_bytes),
             fmt::format("{} bytes of samples for each byte of the file", kMaxRatio),
             "the file is corrupt or hostile");
}

void check_image(const Image& image, std::string_view where) {
  check_shape(image.size.width, image.size.height, image.channels, where);
  check_depth(image.depth, where);
  const std::uint64_t expected = sample_bytes(image.shape(), image.channels, image.type);
  if (image.samples.size() != expected) {
    fail_input(std::string(where),
               fmt::format("{} bytes of samples for {}", image.samples.size(), describe(image)),
               fmt::format("{} bytes", expected));
  }
}

}  // namespace texture
}  // namespace bn
