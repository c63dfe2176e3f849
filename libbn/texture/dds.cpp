// DDS, the container for textures of Direct3D: uncompressed samples as a 2D texture, a 2D array or a 3D
// texture.
//
// A file is the four letters "DDS ", a header from the time of Direct3D 9, and, where that says "DX10", a
// second header with a DXGI format and the number of layers. Then come the samples: every layer with all its
// mip levels, rows without padding. We always write both headers, a UNORM or FLOAT format (never sRGB),
// straight alpha, one level.
//
// The container has no room for metadata; write_image() puts them into a file beside it.
//
// Reading takes the largest level of what others wrote, also under the old header alone where it describes
// plain samples. Every size is computed in 64 bits and checked against the file before memory is taken.

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/gpu_format.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

constexpr std::uint32_t four_letters(const char (&text)[5]) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(text[i]);
  return value;
}

struct PixelFormat {
  std::uint32_t size, flags, four_letters, bits;
  std::array<std::uint32_t, 4> masks;  // red or luminance, green, blue, alpha
};

struct Header {
  std::uint32_t magic, size, flags, height, width, pitch, depth, levels;
  std::array<std::uint32_t, 11> reserved;
  PixelFormat format;
  std::uint32_t caps, caps2, caps3, caps4, reserved2;
};
static_assert(sizeof(Header) == 128);

struct Header10 {
  std::uint32_t dxgi_format, dimension, misc, layers, alpha_mode;
};
static_assert(sizeof(Header10) == 20);

constexpr std::uint32_t kMagic = four_letters("DDS "), kDx10 = four_letters("DX10");
constexpr std::uint32_t kHeaderSize = 124, kPixelFormatSize = 32;
constexpr std::uint32_t kHasCaps = 1, kHasHeight = 2, kHasWidth = 4, kHasPitch = 8, kHasFormat = 0x1000,
                        kHasDepth = 0x800000;
constexpr std::uint32_t kFormatFourLetters = 4, kFormatAlpha = 1, kFormatRgb = 0x40,
                        kFormatLuminance = 0x20000;
constexpr std::uint32_t kCapsTexture = 0x1000, kCapsComplex = 8;
constexpr std::uint32_t kCaps2Cube = 0x200, kCaps2Volume = 0x200000;
constexpr std::uint32_t kDimension2d = 3, kDimension3d = 4, kMiscCube = 4;
constexpr std::uint32_t kAlphaMask = 7, kAlphaUnknown = 0, kAlphaStraight = 1, kAlphaPremultiplied = 2;
constexpr std::uint32_t kMaxLevels = 17;  // of a side of 65536

/// Numbers that old headers have in the place of the four letters.
constexpr struct {
  std::uint32_t number;
  SampleType type;
  int channels;
} kNumbered[] = {{36, SampleType::u16, 4},  {111, SampleType::f16, 1}, {112, SampleType::f16, 2},
                 {113, SampleType::f16, 4}, {114, SampleType::f32, 1}, {115, SampleType::f32, 2},
                 {116, SampleType::f32, 4}};

/// Plain samples that old headers describe by bit masks.
struct Masked {
  std::uint32_t kind, bits;
  std::array<std::uint32_t, 4> masks;
  StoredTexel texel;
};
constexpr StoredTexel texel(SampleType type, int channels, int stored,
                            std::array<int, 4> order = {0, 1, 2, 3}) {
  return {.type = type, .channels = channels, .stored = stored, .order = order, .srgb = false};
}
constexpr Masked kMasked[] = {
    {kFormatLuminance, 8, {0xff, 0, 0, 0}, texel(SampleType::u8, 1, 1)},
    {kFormatLuminance, 16, {0xffff, 0, 0, 0}, texel(SampleType::u16, 1, 1)},
    {kFormatLuminance, 16, {0xff, 0, 0, 0xff00}, texel(SampleType::u8, 2, 2)},
    {kFormatRgb, 24, {0xff0000, 0xff00, 0xff, 0}, texel(SampleType::u8, 3, 3, {2, 1, 0, 3})},
    {kFormatRgb, 24, {0xff, 0xff00, 0xff0000, 0}, texel(SampleType::u8, 3, 3)},
    {kFormatRgb, 32, {0xff0000, 0xff00, 0xff, 0xff000000}, texel(SampleType::u8, 4, 4, {2, 1, 0, 3})},
    {kFormatRgb, 32, {0xff, 0xff00, 0xff0000, 0xff000000}, texel(SampleType::u8, 4, 4)},
    {kFormatRgb, 32, {0xff0000, 0xff00, 0xff, 0}, texel(SampleType::u8, 3, 4, {2, 1, 0, 3})},
    {kFormatRgb, 32, {0xff, 0xff00, 0xff0000, 0}, texel(SampleType::u8, 3, 4)},
    {kFormatRgb, 32, {0xffff, 0xffff0000, 0, 0}, texel(SampleType::u16, 2, 2)},
};

StoredTexel legacy_texel(const PixelFormat& format, const std::string& name) {
  if ((format.flags & kFormatFourLetters) != 0) {
    for (const auto& known : kNumbered) {
      if (known.number == format.four_letters) return texel(known.type, known.channels, known.channels);
    }
    std::string letters(reinterpret_cast<const char*>(&format.four_letters), 4);
    for (char& c : letters) c = c >= ' ' && c <= '~' ? c : '?';
    fail_input(name, fmt::format("format '{}'", letters), std::string(kReadableTexels),
               "write it uncompressed");
  }
  for (const Masked& known : kMasked) {
    std::array<std::uint32_t, 4> masks = format.masks;
    if ((format.flags & kFormatAlpha) == 0) masks[3] = 0;
    // Some writers repeat the mask of luminance.
    if (known.kind == kFormatLuminance) masks[1] = masks[2] = 0;
    if ((format.flags & known.kind) != 0 && format.bits == known.bits && masks == known.masks)
      return known.texel;
  }
  fail_input(name,
             fmt::format("{} bits a pixel with masks {:x}, {:x}, {:x}, {:x}", format.bits, format.masks[0],
                         format.masks[1], format.masks[2], format.masks[3]),
             std::string(kReadableTexels), "write it with a DX10 header");
}

/// What a file holds, from either header.
struct Content {
  StoredTexel texel;
  SliceKind slices = SliceKind::layers;
  std::uint32_t depth = 1;   // of a 3D texture
  std::uint32_t layers = 1;  // of an array
  std::uint64_t samples_offset = sizeof(Header);
};

Content legacy_content(const Header& header, const std::string& name) {
  Content content;
  content.texel = legacy_texel(header.format, name);
  if ((header.caps2 & kCaps2Cube) != 0) fail_input(name, "a cube map", "2D, 2D array, 3D");
  if ((header.caps2 & kCaps2Volume) != 0) {
    content.slices = SliceKind::depth;
    content.depth = header.depth;
  }
  return content;
}

Content dx10_content(const Header& header, ByteView bytes, Decoded& decoded, const std::string& name) {
  Content content;
  content.samples_offset += sizeof(Header10);
  if (bytes.size() < content.samples_offset) fail_input(name, "cut short in its second header");
  Header10 header10;
  std::memcpy(&header10, bytes.data() + sizeof header, sizeof header10);
  const auto texel = texel_of_dxgi(header10.dxgi_format);
  if (!texel) {
    fail_input(name, fmt::format("DXGI format {}", header10.dxgi_format), std::string(kReadableTexels),
               "write it uncompressed");
  }
  content.texel = *texel;
  if ((header10.misc & kMiscCube) != 0) fail_input(name, "a cube map", "2D, 2D array, 3D");
  if (header10.dimension == kDimension2d) {
    content.layers = header10.layers;
  } else if (header10.dimension == kDimension3d) {
    content.slices = SliceKind::depth;
    content.depth = header.depth;
    if (header10.layers > 1) fail_input(name, fmt::format("{} volumes", header10.layers), "1");
  } else {
    fail_input(name, fmt::format("dimension {}", header10.dimension), "3 (2D), 4 (3D)");
  }
  if ((header10.alpha_mode & kAlphaMask) == kAlphaPremultiplied) {
    decoded.notes.push_back(
        "its channels are said to be multiplied by alpha; they are read as they are stored");
  }
  return content;
}

/// Bytes of one layer with all its levels; the largest comes first.
std::uint64_t layer_bytes(const Header& header, const Content& content) {
  std::uint64_t sum = 0;
  for (std::uint32_t level = 0; level < std::max(1u, header.levels); ++level) {
    const auto side = [level](std::uint32_t length) { return std::uint64_t{std::max(1u, length >> level)}; };
    sum += side(header.width) * side(header.height) * side(content.depth) * texel_bytes(content.texel);
  }
  return sum;
}

}  // namespace

bool is_dds(ByteView bytes) { return bytes.size() >= 4 && std::memcmp(bytes.data(), "DDS ", 4) == 0; }

Bytes encode_dds(const Image& image, SliceKind slices) {
  const auto format = gpu_format(image.type, image.channels);
  if (!format || format->dxgi == 0) fail_input("image", describe(image), std::string(kReadableTexels));
  const bool volume = image.depth > 1, solid = volume && slices == SliceKind::depth;
  const auto depth = static_cast<std::uint32_t>(image.depth);
  const std::size_t row = static_cast<std::size_t>(image.size.width) *
                          static_cast<std::size_t>(image.channels) * bytes_per_sample(image.type);
  Header header{};
  header.magic = kMagic;
  header.size = kHeaderSize;
  header.flags = kHasCaps | kHasHeight | kHasWidth | kHasPitch | kHasFormat | (solid ? kHasDepth : 0);
  header.height = static_cast<std::uint32_t>(image.size.height);
  header.width = static_cast<std::uint32_t>(image.size.width);
  header.pitch = static_cast<std::uint32_t>(row);
  header.depth = solid ? depth : 0;
  header.levels = 1;
  header.format.size = kPixelFormatSize;
  header.format.flags = kFormatFourLetters;
  header.format.four_letters = kDx10;
  header.caps = kCapsTexture | (volume ? kCapsComplex : 0);
  header.caps2 = solid ? kCaps2Volume : 0;
  const Header10 header10{.dxgi_format = format->dxgi,
                          .dimension = solid ? kDimension3d : kDimension2d,
                          .misc = 0,
                          .layers = volume && !solid ? depth : 1,
                          .alpha_mode = image.channels == 4 ? kAlphaStraight : kAlphaUnknown};
  Bytes bytes(sizeof header + sizeof header10 + image.samples.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, &header10, sizeof header10);
  std::memcpy(bytes.data() + sizeof header + sizeof header10, image.samples.data(), image.samples.size());
  return bytes;
}

Decoded decode_dds(ByteView bytes, const std::string& name, const Execution& execution) {
  Header header;
  if (bytes.size() < sizeof header) fail_input(name, "cut short in its header");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.size != kHeaderSize || header.format.size != kPixelFormatSize) {
    fail_input(name, fmt::format("headers of {} and {} bytes", header.size, header.format.size),
               fmt::format("{} and {}", kHeaderSize, kPixelFormatSize), "the file is corrupt");
  }
  Decoded decoded;
  const bool is_dx10 = (header.format.flags & kFormatFourLetters) != 0 && header.format.four_letters == kDx10;
  const Content content = is_dx10 ? dx10_content(header, bytes, decoded, name) : legacy_content(header, name);
  check_shape(header.width, header.height, content.texel.channels, name);
  check_depth(content.depth, name);
  check_depth(content.layers, name);
  if (header.levels > kMaxLevels) {
    fail_input(name, fmt::format("{} mip levels", header.levels), fmt::format("at most {}", kMaxLevels),
               "the file is corrupt");
  }
  const std::uint64_t layer = layer_bytes(header, content);
  const std::uint64_t needed = content.samples_offset + layer * content.layers;
  if (needed > bytes.size()) {
    fail_input(name,
               fmt::format("{} bytes where its header needs {}: cut short or corrupt", bytes.size(), needed));
  }
  Image& image = decoded.image;
  image = {.size = {static_cast<int>(header.width), static_cast<int>(header.height)},
           .depth = static_cast<int>(std::max(content.depth, content.layers)),
           .channels = content.texel.channels,
           .type = content.texel.type,
           .samples = {}};
  decoded.slices = content.slices;
  if (content.texel.srgb) {
    decoded.notes.push_back(
        "its format is sRGB, so engines decode the samples; they are read as they are stored");
  }
  if (header.levels > 1) {
    decoded.notes.push_back(fmt::format("it has {} mip levels; the largest is read", header.levels));
  }
  const std::uint64_t ours = sample_bytes(image.shape(), image.channels, image.type);
  check_memory(execution, bytes.size() + ours, name);
  throw_if_stopped(execution);
  image.samples.resize(ours);
  const std::uint64_t largest =
      static_cast<std::uint64_t>(image.size.area()) * content.depth * texel_bytes(content.texel);
  for (std::uint32_t i = 0; i < content.layers; ++i) {
    copy_texels(content.texel, bytes.subspan(content.samples_offset + i * layer, largest), image,
                i * (ours / content.layers));
  }
  return decoded;
}

}  // namespace bn::texture
