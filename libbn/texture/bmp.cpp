// BMP, uncompressed: 1, 4 and 8 bits with a palette, 24 and 32 bits of colour.
//
// A palette of greys gives one channel, since BMP has no other way to store grey; other palettes give three.
// Own code, because the format is simple and a damaged file can crash OpenImageIO 2.4.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"
#include "texture/palette_image.h"

namespace bn::texture {
namespace {

constexpr std::size_t kFileHeader = 14;
constexpr std::uint32_t kCoreHeader = 12, kInfoHeader = 40, kMasksInHeader = 52, kAlphaInHeader = 56;
constexpr std::uint32_t kPlain = 0, kBitFields = 3, kAlphaBitFields = 6;
constexpr std::array<std::uint32_t, 7> kHeaderSizes = {
    kCoreHeader, kInfoHeader, kMasksInHeader, kAlphaInHeader, 64, 108, 124};

struct Reader {
  ByteView bytes;
  const std::string& name;

  std::uint32_t number(std::size_t at, std::size_t count) const {
    if (at + count > bytes.size()) fail_input(name, "cut short in its header");
    std::uint32_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
  }
  std::uint32_t u16(std::size_t at) const { return number(at, 2); }
  std::uint32_t u32(std::size_t at) const { return number(at, 4); }
};

struct Header {
  std::int64_t width = 0, height = 0;
  bool top_down = false;
  std::uint32_t bits = 0;
  bool has_alpha = false;
  std::size_t palette = 0, palette_entry = 4, colours = 0;
  std::size_t samples = 0;
};

/// The masks of 32 bit pixels; only whole bytes, blue first, are read.
bool has_alpha_mask(const Reader& reader, std::uint32_t size, std::uint32_t compression) {
  const std::size_t masks = kFileHeader + kInfoHeader;
  const bool with_alpha = compression == kAlphaBitFields || size >= kAlphaInHeader;
  const std::uint32_t alpha = with_alpha ? reader.u32(masks + 12) : 0;
  if (reader.u32(masks) != 0xff0000u || reader.u32(masks + 4) != 0xff00u || reader.u32(masks + 8) != 0xffu ||
      (alpha != 0 && alpha != 0xff000000u)) {
    fail_input(reader.name, "channels that are no whole bytes, blue first", "8 bits a channel",
               "convert it to PNG");
  }
  return alpha != 0;
}

Header read_header(const Reader& reader) {
  Header header;
  const std::uint32_t size = reader.u32(kFileHeader);
  header.samples = reader.u32(10);
  std::uint32_t compression = kPlain, colours = 0;
  if (size == kCoreHeader) {
    header.width = reader.u16(18);
    header.height = reader.u16(20);
    header.bits = reader.u16(24);
    header.palette_entry = 3;
  } else {
    header.width = static_cast<std::int32_t>(reader.u32(18));
    header.height = static_cast<std::int32_t>(reader.u32(22));
    header.bits = reader.u16(28);
    compression = reader.u32(30);
    colours = reader.u32(46);
    header.top_down = header.height < 0;
    header.height = std::abs(header.height);
  }
  const bool palette = header.bits == 1 || header.bits == 4 || header.bits == 8;
  if (!palette && header.bits != 24 && header.bits != 32) {
    fail_input(reader.name, fmt::format("{} bits a pixel", header.bits), "1, 4, 8, 24, 32",
               "convert it to PNG");
  }
  const bool fields = header.bits == 32 && (compression == kBitFields || compression == kAlphaBitFields);
  if (compression != kPlain && !fields)
    fail_input(reader.name, fmt::format("compression {}", compression), "uncompressed", "convert it to PNG");
  if (fields) header.has_alpha = has_alpha_mask(reader, size, compression);
  if (palette) {
    header.palette = kFileHeader + size;
    header.colours = colours == 0 ? std::size_t{1} << header.bits : colours;
    if (header.colours > 256)
      fail_input(reader.name, fmt::format("a palette of {} colours", colours), "1..256");
    reader.number(header.palette + header.colours * header.palette_entry, 0);
  }
  return header;
}

/// The bytes of row `y`, from the top.
class Rows {
 public:
  Rows(const Header& header, const Reader& reader)
      : header_(header), stride_((static_cast<std::uint64_t>(header.width) * header.bits + 31) / 32 * 4) {
    const std::uint64_t needed = header.samples + stride_ * static_cast<std::uint64_t>(header.height);
    if (needed > reader.bytes.size()) {
      fail_input(reader.name, fmt::format("{} bytes where its header needs {}: cut short or corrupt",
                                          reader.bytes.size(), needed));
    }
    samples_ = reader.bytes.subspan(header.samples);
  }
  ByteView row(std::int64_t y) const {
    const std::int64_t at = header_.top_down ? y : header_.height - 1 - y;
    return samples_.subspan(static_cast<std::size_t>(at) * stride_, stride_);
  }

 private:
  const Header& header_;
  std::uint64_t stride_;
  ByteView samples_;
};

void read_indices(const Header& header, const Rows& rows, const Reader& reader, PaletteImage& picture) {
  for (std::size_t i = 0; i < header.colours; ++i) {
    const std::size_t at = header.palette + i * header.palette_entry;
    picture.palette[i] = {reader.bytes[at + 2], reader.bytes[at + 1], reader.bytes[at], std::byte{255}};
  }
  picture.colours = header.colours;
  picture.indices.reserve(static_cast<std::size_t>(picture.size.area()));
  const std::uint32_t per_byte = 8 / header.bits;
  for (std::int64_t y = 0; y < header.height; ++y) {
    const ByteView row = rows.row(y);
    for (std::int64_t x = 0; x < header.width; ++x) {
      const auto byte = std::to_integer<std::uint32_t>(row[static_cast<std::size_t>(x) / per_byte]);
      const std::uint32_t shift = 8 - header.bits * (1 + static_cast<std::uint32_t>(x) % per_byte);
      picture.indices.push_back(static_cast<unsigned char>(byte >> shift & ((1u << header.bits) - 1)));
    }
  }
}

/// Whether a byte was left out that is not 0.
bool read_colours(const Header& header, const Rows& rows, Image& image) {
  const auto bytes = static_cast<std::size_t>(header.bits / 8),
             channels = static_cast<std::size_t>(image.channels);
  bool left_out = false;
  std::byte* to = image.samples.data();
  for (std::int64_t y = 0; y < header.height; ++y) {
    const ByteView row = rows.row(y);
    for (std::size_t x = 0; x < static_cast<std::size_t>(header.width); ++x, to += channels) {
      const std::byte* const from = row.data() + x * bytes;
      to[0] = from[2], to[1] = from[1], to[2] = from[0];
      if (channels == 4) to[3] = from[3];
      left_out |= bytes == 4 && channels == 3 && from[3] != std::byte{0};
    }
  }
  return left_out;
}

}  // namespace

bool is_bmp(ByteView bytes) {
  if (bytes.size() < kFileHeader + 4 || std::memcmp(bytes.data(), "BM", 2) != 0) return false;
  const std::string none;
  const std::uint32_t size = Reader{bytes, none}.u32(kFileHeader);
  return std::find(kHeaderSizes.begin(), kHeaderSizes.end(), size) != kHeaderSizes.end();
}

Decoded decode_bmp(ByteView bytes, const std::string& name, const Execution& execution) {
  const Reader reader{bytes, name};
  const Header header = read_header(reader);
  const int channels = header.has_alpha ? 4 : 3;
  check_shape(header.width, header.height, channels, name);
  const Rows rows(header, reader);
  const Extent size{static_cast<int>(header.width), static_cast<int>(header.height)};
  check_memory(execution, sample_bytes(size, 4, SampleType::u8) + bytes.size(), name);
  throw_if_stopped(execution);
  Decoded decoded;
  if (header.colours > 0) {
    PaletteImage picture{.size = size};
    read_indices(header, rows, reader, picture);
    decoded.image = expand_palette(picture, name);
    return decoded;
  }
  Image& image = decoded.image;
  image = {.size = size, .channels = channels, .samples = {}};
  image.samples.resize(sample_bytes(size, channels, SampleType::u8));
  if (read_colours(header, rows, image))
    decoded.notes.emplace_back("the fourth byte of its pixels has no meaning by its header and is left out");
  return decoded;
}

}  // namespace bn::texture
