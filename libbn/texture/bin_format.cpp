// The raw format .bin: a fixed header, the metadata, the samples; little-endian. It is made to be
// mapped into memory and used in place, so the samples begin at a multiple of 64 bytes.
// docs/files.md has the layout for readers. Pictures have layout 1, as ever; volumes have layout 2, whose
// header is longer by the number of slices.

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

// The first byte is no text, the line ends catch transfers that translate them, as in PNG.
constexpr std::array<unsigned char, 8> kMagic = {0x89, 'B', 'N', 'T', '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t kPicture = 1, kVolume = 2;  // versions of the layout
constexpr std::uint64_t kAlignment = 64;

struct Header {
  std::array<unsigned char, 8> magic;
  std::uint32_t version;
  std::uint32_t sample_type;  // 0 8bit, 1 16bit, 2 float, 3 half
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t channels;
  std::uint32_t metadata_bytes;
  std::uint64_t samples_offset;
  std::uint64_t samples_bytes;
  std::array<unsigned char, 16> pixel_hash;  // as the 32 digits read
};
static_assert(sizeof(Header) == 64, "the members lie as documented, without gaps");

/// What follows the header in layout 2.
struct VolumeHeader {
  std::uint32_t depth;
  std::array<std::uint32_t, 3> zero;
};
static_assert(sizeof(VolumeHeader) == 16);

std::uint64_t round_up(std::uint64_t value) { return (value + kAlignment - 1) / kAlignment * kAlignment; }

/// The 16 bytes that the digits after "xxh3-128:" name.
std::array<unsigned char, 16> hash_bytes(const std::string& pixel_hash) {
  const std::string digits = pixel_hash.substr(pixel_hash.find(':') + 1);
  std::array<unsigned char, 16> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<unsigned char>(std::stoi(digits.substr(2 * i, 2), nullptr, 16));
  }
  return bytes;
}

}  // namespace

bool is_bin(ByteView bytes) {
  return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

Bytes encode_bin(const Image& image, const Metadata& metadata) {
  const std::string json = to_json(metadata);
  const bool volume = image.depth > 1;
  const std::uint64_t json_offset = sizeof(Header) + (volume ? sizeof(VolumeHeader) : 0);
  const std::uint64_t samples_offset = round_up(json_offset + json.size());
  const Header header{.magic = kMagic,
                      .version = volume ? kVolume : kPicture,
                      .sample_type = static_cast<std::uint32_t>(image.type),
                      .width = static_cast<std::uint32_t>(image.size.width),
                      .height = static_cast<std::uint32_t>(image.size.height),
                      .channels = static_cast<std::uint32_t>(image.channels),
                      .metadata_bytes = static_cast<std::uint32_t>(json.size()),
                      .samples_offset = samples_offset,
                      .samples_bytes = image.samples.size(),
                      .pixel_hash = hash_bytes(metadata.pixel_hash)};
  Bytes bytes(samples_offset + image.samples.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  if (volume) {
    const VolumeHeader more{.depth = static_cast<std::uint32_t>(image.depth), .zero = {}};
    std::memcpy(bytes.data() + sizeof header, &more, sizeof more);
  }
  std::memcpy(bytes.data() + json_offset, json.data(), json.size());
  std::memcpy(bytes.data() + samples_offset, image.samples.data(), image.samples.size());
  return bytes;
}

Decoded decode_bin(ByteView bytes, const std::string& name, const Execution& execution) {
  Header header;
  if (bytes.size() < sizeof header) fail_input(name, "cut short in its header");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version != kPicture && header.version != kVolume) {
    fail_input(name, fmt::format(".bin of version {}", header.version),
               fmt::format("{}, {}", kPicture, kVolume), "read it with a newer version of bn");
  }
  if (header.sample_type > 3) fail_input(name, fmt::format("sample type {}", header.sample_type), "0..3");
  check_shape(header.width, header.height, header.channels, name);
  VolumeHeader more{.depth = 1, .zero = {}};
  std::uint64_t json_offset = sizeof header;
  if (header.version == kVolume) {
    json_offset += sizeof more;
    if (bytes.size() < json_offset) fail_input(name, "cut short in its header");
    std::memcpy(&more, bytes.data() + sizeof header, sizeof more);
    check_depth(more.depth, name);
    if (more.depth == 1 || more.zero != std::array<std::uint32_t, 3>{}) {
      fail_input(name,
                 fmt::format("{} slices, and words {}, {}, {} after them, in layout 2", more.depth,
                             more.zero[0], more.zero[1], more.zero[2]),
                 "2 slices or more, and zeros");
    }
  }

  Decoded decoded;
  Image& image = decoded.image;
  image = {.size = {static_cast<int>(header.width), static_cast<int>(header.height)},
           .depth = static_cast<int>(more.depth),
           .channels = static_cast<int>(header.channels),
           .type = static_cast<SampleType>(header.sample_type),
           .samples = {}};
  const std::uint64_t samples_bytes = sample_bytes(image.shape(), image.channels, image.type);
  const std::uint64_t samples_offset = round_up(json_offset + header.metadata_bytes);
  if (header.samples_bytes != samples_bytes || header.samples_offset != samples_offset ||
      bytes.size() != samples_offset + samples_bytes) {
    fail_input(name, fmt::format("{} bytes where its header needs {}: cut short or corrupt", bytes.size(),
                                 samples_offset + samples_bytes));
  }
  check_memory(execution, bytes.size() + samples_bytes, name);
  decoded.description.assign(reinterpret_cast<const char*>(bytes.data()) + json_offset,
                             header.metadata_bytes);
  const ByteView samples = bytes.subspan(samples_offset);
  image.samples.assign(samples.begin(), samples.end());
  return decoded;
}

}  // namespace bn::texture
