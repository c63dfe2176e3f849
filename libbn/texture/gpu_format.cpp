#include "texture/gpu_format.h"

#include <cstring>

namespace bn::texture {
namespace {

constexpr GpuFormat kFormats[] = {
    {SampleType::u8, 1, 9, 61},     // R8_UNORM
    {SampleType::u8, 2, 16, 49},    // R8G8_UNORM
    {SampleType::u8, 3, 23, 0},     // R8G8B8_UNORM
    {SampleType::u8, 4, 37, 28},    // R8G8B8A8_UNORM
    {SampleType::u16, 1, 70, 56},   // R16_UNORM
    {SampleType::u16, 2, 77, 35},   // R16G16_UNORM
    {SampleType::u16, 3, 84, 0},    // R16G16B16_UNORM
    {SampleType::u16, 4, 91, 11},   // R16G16B16A16_UNORM
    {SampleType::f16, 1, 76, 54},   // R16_SFLOAT, in DXGI R16_FLOAT, and so on
    {SampleType::f16, 2, 83, 34},   // R16G16
    {SampleType::f16, 3, 90, 0},    // R16G16B16
    {SampleType::f16, 4, 97, 10},   // R16G16B16A16
    {SampleType::f32, 1, 100, 41},  // R32
    {SampleType::f32, 2, 103, 16},  // R32G32
    {SampleType::f32, 3, 106, 6},   // R32G32B32
    {SampleType::f32, 4, 109, 2},   // R32G32B32A32
};

/// Formats that others write and that hold samples of our types. Whole numbers (UINT) are read as they are.
struct Foreign {
  std::uint32_t number;
  StoredTexel texel;
};

constexpr StoredTexel plain(SampleType type, int channels, bool srgb = false) {
  return {.type = type, .channels = channels, .stored = channels, .order = {0, 1, 2, 3}, .srgb = srgb};
}
constexpr StoredTexel blue_first(int channels, int stored, bool srgb = false) {
  return {
      .type = SampleType::u8, .channels = channels, .stored = stored, .order = {2, 1, 0, 3}, .srgb = srgb};
}

constexpr Foreign kVulkan[] = {
    {13, plain(SampleType::u8, 1)},
    {20, plain(SampleType::u8, 2)},
    {27, plain(SampleType::u8, 3)},
    {41, plain(SampleType::u8, 4)},
    {74, plain(SampleType::u16, 1)},
    {81, plain(SampleType::u16, 2)},
    {88, plain(SampleType::u16, 3)},
    {95, plain(SampleType::u16, 4)},
    {15, plain(SampleType::u8, 1, true)},
    {22, plain(SampleType::u8, 2, true)},
    {29, plain(SampleType::u8, 3, true)},
    {43, plain(SampleType::u8, 4, true)},
    {30, blue_first(3, 3)},
    {36, blue_first(3, 3, true)},
    {44, blue_first(4, 4)},
    {50, blue_first(4, 4, true)},
};

constexpr Foreign kDxgi[] = {
    {62, plain(SampleType::u8, 1)},
    {50, plain(SampleType::u8, 2)},
    {30, plain(SampleType::u8, 4)},
    {57, plain(SampleType::u16, 1)},
    {36, plain(SampleType::u16, 2)},
    {12, plain(SampleType::u16, 4)},
    {29, plain(SampleType::u8, 4, true)},
    {65, plain(SampleType::u8, 1)},  // A8
    {87, blue_first(4, 4)},
    {91, blue_first(4, 4, true)},
    {88, blue_first(3, 4)},
    {93, blue_first(3, 4, true)},
};

template <std::size_t n>
std::optional<StoredTexel> find(const Foreign (&list)[n], std::uint32_t number) {
  for (const Foreign& foreign : list) {
    if (foreign.number == number) return foreign.texel;
  }
  return std::nullopt;
}

}  // namespace

std::optional<GpuFormat> gpu_format(SampleType type, int channels) {
  for (const GpuFormat& format : kFormats) {
    if (format.type == type && format.channels == channels) return format;
  }
  return std::nullopt;
}

std::optional<StoredTexel> texel_of_vulkan(std::uint32_t number) {
  for (const GpuFormat& format : kFormats) {
    if (format.vulkan == number) return plain(format.type, format.channels);
  }
  return find(kVulkan, number);
}

std::optional<StoredTexel> texel_of_dxgi(std::uint32_t number) {
  for (const GpuFormat& format : kFormats) {
    if (format.dxgi == number && number != 0) return plain(format.type, format.channels);
  }
  return find(kDxgi, number);
}

std::uint64_t texel_bytes(const StoredTexel& texel) {
  return static_cast<std::uint64_t>(texel.stored) * bytes_per_sample(texel.type);
}

void copy_texels(const StoredTexel& texel, ByteView from, Image& image, std::size_t at) {
  std::byte* to = image.samples.data() + at;
  if (texel.stored == texel.channels && texel.order == std::array<int, 4>{0, 1, 2, 3}) {
    std::memcpy(to, from.data(), from.size());
    return;
  }
  const std::size_t sample = bytes_per_sample(texel.type);
  const std::size_t texels = from.size() / texel_bytes(texel);
  for (std::size_t i = 0; i < texels; ++i) {
    for (int c = 0; c < texel.channels; ++c) {
      const std::size_t source = i * texel_bytes(texel) +
                                 sample * static_cast<std::size_t>(texel.order[static_cast<std::size_t>(c)]);
      std::memcpy(to, from.data() + source, sample);
      to += sample;
    }
  }
}

}  // namespace bn::texture
