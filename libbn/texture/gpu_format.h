// The uncompressed formats that KTX2 and DDS share: their numbers in Vulkan and in DXGI, and how the samples
// of a foreign file are put into our order.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bn/texture.h"
#include "texture/codec.h"

namespace bn::texture {

/// How a file stores a texel, and what we make of it.
struct StoredTexel {
  SampleType type = SampleType::u8;
  int channels = 0;                         ///< that we read
  int stored = 0;                           ///< that a texel has in the file
  std::array<int, 4> order = {0, 1, 2, 3};  ///< our channel c is the file's channel order[c]
  bool srgb = false;                        ///< engines decode the samples
};

/// The names and numbers of what we write. 0 where DXGI has no such format.
struct GpuFormat {
  SampleType type;
  int channels;
  std::uint32_t vulkan;
  std::uint32_t dxgi;
};

/// The format of such samples, if there is one in Vulkan.
std::optional<GpuFormat> gpu_format(SampleType type, int channels);
std::optional<StoredTexel> texel_of_vulkan(std::uint32_t format);
std::optional<StoredTexel> texel_of_dxgi(std::uint32_t format);

/// What formats are read, for messages.
inline constexpr std::string_view kReadableTexels =
    "uncompressed 8bit, 16bit, half and float of 1 to 4 channels";

std::uint64_t texel_bytes(const StoredTexel& texel);

/// Copies `from`, of exactly the right length, into image.samples at `at`, and puts the channels in order.
void copy_texels(const StoredTexel& texel, ByteView from, Image& image, std::size_t at);

}  // namespace bn::texture
