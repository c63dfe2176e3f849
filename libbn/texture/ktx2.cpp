// KTX 2.0, the Khronos container for textures: uncompressed samples as a 2D texture, a 2D array or a 3D
// texture. We wrote this reader and writer from the specification, because Debian packages no library for the
// format.
//
// A file is, in this order: a header that holds the offsets of what follows; an index of the mip levels; the
// data format descriptor, which says again, for readers that know no Vulkan formats, what the bits of a texel
// are; keys with values; the samples. All numbers are little-endian.
//
// What we write is always linear: a UNORM or SFLOAT format, transfer function "linear", colour primaries
// "unspecified" (the samples are no colours), straight alpha, one level, no supercompression. Our metadata
// are the value of the key "bn-metadata".
//
// Reading takes the first level of what others wrote and believes no number: every offset and length is
// checked against the file, in 64 bits, before it is used.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/gpu_format.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

constexpr std::array<unsigned char, 12> kIdentifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                       '0',  0xBB, '\r', '\n', 0x1A, '\n'};
constexpr std::string_view kMetadataKey = "bn-metadata", kOrientationKey = "KTXorientation",
                           kWriterKey = "KTXwriter";

struct Header {
  std::array<unsigned char, 12> identifier;
  std::uint32_t vk_format;
  std::uint32_t type_size;  // bytes of a sample
  std::uint32_t width, height, depth;
  std::uint32_t layers, faces, levels;
  std::uint32_t supercompression;
  std::uint32_t descriptor_offset, descriptor_bytes;
  std::uint32_t keys_offset, keys_bytes;
  std::uint64_t global_offset, global_bytes;
};
static_assert(sizeof(Header) == 80, "the members lie as the specification says, without gaps");

struct Level {
  std::uint64_t offset, bytes, uncompressed_bytes;
};
static_assert(sizeof(Level) == 24);

// The basic data format descriptor, Khronos Data Format Specification 1.3.
struct DescriptorHead {
  std::uint32_t total_bytes;      // of this and all blocks
  std::uint32_t vendor_and_type;  // 0: Khronos, basic
  std::uint16_t version;          // 2: version 1.3
  std::uint16_t block_bytes;      // without total_bytes
  std::uint8_t model, primaries, transfer, flags;
  std::array<std::uint8_t, 4> block_dimensions;  // minus one
  std::array<std::uint8_t, 8> plane_bytes;
};
static_assert(sizeof(DescriptorHead) == 28);

struct DescriptorSample {
  std::uint16_t bit_offset;
  std::uint8_t bit_length;  // minus one
  std::uint8_t channel;     // with flags for signed and float
  std::array<std::uint8_t, 4> position;
  std::uint32_t lower, upper;
};
static_assert(sizeof(DescriptorSample) == 16);

constexpr std::uint16_t kVersion13 = 2;
constexpr std::uint8_t kModelRgbsda = 1, kPrimariesUnspecified = 0, kTransferLinear = 1, kTransferSrgb = 2;
constexpr std::uint8_t kFlagPremultiplied = 1;
constexpr std::array<std::uint8_t, 4> kChannelIds = {0, 1, 2, 15};  // red, green, blue, alpha
constexpr std::uint8_t kSigned = 0x40, kFloat = 0x80;

std::uint64_t round_up(std::uint64_t value, std::uint64_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

template <class T>
void put(Bytes& bytes, const T& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

Bytes descriptor(const GpuFormat& format) {
  const std::size_t bytes = bytes_per_sample(format.type);
  const bool is_float = format.type == SampleType::f16 || format.type == SampleType::f32;
  DescriptorHead head{};
  head.block_bytes =
      static_cast<std::uint16_t>(sizeof head - sizeof head.total_bytes +
                                 sizeof(DescriptorSample) * static_cast<std::size_t>(format.channels));
  head.total_bytes = head.block_bytes + static_cast<std::uint32_t>(sizeof head.total_bytes);
  head.version = kVersion13;
  head.model = kModelRgbsda;
  head.primaries = kPrimariesUnspecified;
  head.transfer = kTransferLinear;
  head.plane_bytes[0] = static_cast<std::uint8_t>(bytes * static_cast<std::size_t>(format.channels));
  Bytes result;
  put(result, head);
  for (int c = 0; c < format.channels; ++c) {
    DescriptorSample sample{};
    sample.bit_offset = static_cast<std::uint16_t>(8 * bytes * static_cast<std::size_t>(c));
    sample.bit_length = static_cast<std::uint8_t>(8 * bytes - 1);
    sample.channel = kChannelIds[static_cast<std::size_t>(c)];
    if (is_float) {
      // The nominal range -1..1, as floats of 32 bits whatever the samples have.
      sample.channel |= kSigned | kFloat;
      sample.lower = std::bit_cast<std::uint32_t>(-1.0f);
      sample.upper = std::bit_cast<std::uint32_t>(1.0f);
    } else {
      sample.upper = format.type == SampleType::u8 ? 0xff : 0xffff;
    }
    put(result, sample);
  }
  return result;
}

/// A key and its value, which is text and ends with a zero, padded to 4 bytes.
void put_key(Bytes& bytes, std::string_view key, std::string_view value) {
  put(bytes, static_cast<std::uint32_t>(key.size() + 1 + value.size() + 1));
  bytes.insert(bytes.end(), key.begin(), key.end());
  bytes.push_back(0);
  bytes.insert(bytes.end(), value.begin(), value.end());
  bytes.push_back(0);
  bytes.resize(round_up(bytes.size(), 4));
}

/// Part of a file, checked to lie in it.
ByteView part(ByteView bytes, std::uint64_t offset, std::uint64_t length, std::string_view what,
              const std::string& name) {
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail_input(
        name,
        fmt::format("its {} should be {} bytes at offset {}: cut short or corrupt", what, length, offset),
        fmt::format("the {} bytes of the file", bytes.size()));
  }
  return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

template <class T>
T get(ByteView bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// What the header says the file holds, or a refusal.
StoredTexel checked_texel(const Header& header, const std::string& name) {
  if (header.supercompression != 0) {
    fail_input(name, fmt::format("supercompression scheme {}", header.supercompression), "none",
               "write it without supercompression");
  }
  const auto texel = texel_of_vulkan(header.vk_format);
  if (!texel) {
    fail_input(name, fmt::format("Vulkan format {}", header.vk_format), std::string(kReadableTexels),
               "write it uncompressed");
  }
  if (header.type_size != bytes_per_sample(texel->type)) {
    fail_input(name, fmt::format("a type of {} bytes", header.type_size),
               fmt::format("{}, for its format", bytes_per_sample(texel->type)), "the file is corrupt");
  }
  if (header.faces != 1) fail_input(name, fmt::format("{} faces", header.faces), "1 face: no cube maps");
  if (header.height == 0) fail_input(name, "a 1D texture", "2D, 2D array, 3D");
  if (header.depth > 0 && header.layers > 0) {
    fail_input(name, fmt::format("{} layers of depth {}", header.layers, header.depth), "2D, 2D array, 3D");
  }
  check_shape(header.width, header.height, texel->channels, name);
  check_depth(std::max({1u, header.depth, header.layers}), name);
  const std::uint32_t longest = std::max({header.width, header.height, header.depth});
  if (header.levels > static_cast<std::uint32_t>(std::bit_width(longest))) {
    fail_input(name, fmt::format("{} mip levels", header.levels), fmt::format("{}", std::bit_width(longest)),
               "the file is corrupt");
  }
  return *texel;
}

void check_descriptor(ByteView bytes, const Header& header, StoredTexel& texel, Decoded& decoded,
                      const std::string& name) {
  const ByteView all =
      part(bytes, header.descriptor_offset, header.descriptor_bytes, "data format descriptor", name);
  const std::size_t needed =
      sizeof(DescriptorHead) + sizeof(DescriptorSample) * static_cast<std::size_t>(texel.stored);
  const auto fail = [&] {
    fail_input(name, "its data format descriptor does not fit its Vulkan format", "", "the file is corrupt");
  };
  if (all.size() < needed) fail();
  const auto head = get<DescriptorHead>(all);
  if (head.total_bytes != all.size() || head.vendor_and_type != 0 || head.model != kModelRgbsda ||
      head.block_bytes < needed - 4 || head.block_bytes > all.size() - 4 ||
      head.plane_bytes[0] != texel_bytes(texel)) {
    fail();
  }
  for (int c = 0; c < texel.stored; ++c) {
    const auto sample = get<DescriptorSample>(
        all.subspan(sizeof head + sizeof(DescriptorSample) * static_cast<std::size_t>(c)));
    if (sample.bit_length + 1u != 8 * bytes_per_sample(texel.type)) fail();
  }
  if (head.transfer == kTransferSrgb) texel.srgb = true;
  if ((head.flags & kFlagPremultiplied) != 0) {
    decoded.notes.push_back(
        "its channels are said to be multiplied by alpha; they are read as they are stored");
  }
}

void read_keys(ByteView keys, Decoded& decoded, const std::string& name) {
  const auto fail = [&] { fail_input(name, "its keys and values are cut short or corrupt"); };
  while (!keys.empty()) {
    if (keys.size() < 4) fail();
    const std::uint64_t length = get<std::uint32_t>(keys);
    keys = keys.subspan(4);
    if (length > keys.size()) fail();
    const std::string_view entry(reinterpret_cast<const char*>(keys.data()),
                                 static_cast<std::size_t>(length));
    const std::size_t key_end = entry.find('\0');
    if (key_end == std::string_view::npos || key_end == 0) fail();
    const std::string_view key = entry.substr(0, key_end);
    std::string_view value = entry.substr(key_end + 1);
    if (value.ends_with('\0')) value.remove_suffix(1);
    if (key == kMetadataKey) decoded.description = value;
    if (key == kOrientationKey && value != "rd" && value != "rdi") {
      decoded.notes.push_back(
          "its rows or columns do not run right and down; they are read as they are stored");
    }
    keys = keys.subspan(static_cast<std::size_t>(std::min<std::uint64_t>(round_up(length, 4), keys.size())));
  }
}

}  // namespace

bool is_ktx2(ByteView bytes) {
  return bytes.size() >= kIdentifier.size() &&
         std::memcmp(bytes.data(), kIdentifier.data(), kIdentifier.size()) == 0;
}

Bytes encode_ktx2(const Image& image, const Metadata& metadata, SliceKind slices) {
  const auto format = gpu_format(image.type, image.channels);
  if (!format) fail_input("image", describe(image), std::string(kReadableTexels));
  const bool volume = image.depth > 1, solid = volume && slices == SliceKind::depth;
  const Bytes data_format = descriptor(*format);
  Bytes keys;  // in the order of their characters, as the specification asks
  put_key(keys, kOrientationKey, solid ? "rdi" : "rd");
  put_key(keys, kWriterKey, "libbn " + metadata.tool_version);
  put_key(keys, kMetadataKey, to_json(metadata));

  const std::uint64_t descriptor_offset = sizeof(Header) + sizeof(Level);
  const std::uint64_t keys_offset = descriptor_offset + data_format.size();
  const std::uint64_t texel = bytes_per_sample(image.type) * static_cast<std::uint64_t>(image.channels);
  const std::uint64_t samples_offset = round_up(keys_offset + keys.size(), std::lcm(texel, std::uint64_t{4}));
  const Header header{.identifier = kIdentifier,
                      .vk_format = format->vulkan,
                      .type_size = static_cast<std::uint32_t>(bytes_per_sample(image.type)),
                      .width = static_cast<std::uint32_t>(image.size.width),
                      .height = static_cast<std::uint32_t>(image.size.height),
                      .depth = solid ? static_cast<std::uint32_t>(image.depth) : 0,
                      .layers = volume && !solid ? static_cast<std::uint32_t>(image.depth) : 0,
                      .faces = 1,
                      .levels = 1,
                      .supercompression = 0,
                      .descriptor_offset = static_cast<std::uint32_t>(descriptor_offset),
                      .descriptor_bytes = static_cast<std::uint32_t>(data_format.size()),
                      .keys_offset = static_cast<std::uint32_t>(keys_offset),
                      .keys_bytes = static_cast<std::uint32_t>(keys.size()),
                      .global_offset = 0,
                      .global_bytes = 0};
  Bytes bytes;
  bytes.reserve(samples_offset + image.samples.size());
  put(bytes, header);
  put(bytes, Level{samples_offset, image.samples.size(), image.samples.size()});
  bytes.insert(bytes.end(), data_format.begin(), data_format.end());
  bytes.insert(bytes.end(), keys.begin(), keys.end());
  bytes.resize(samples_offset + image.samples.size());
  std::memcpy(bytes.data() + samples_offset, image.samples.data(), image.samples.size());
  return bytes;
}

Decoded decode_ktx2(ByteView bytes, const std::string& name, const Execution& execution) {
  const auto header = get<Header>(part(bytes, 0, sizeof(Header), "header", name));
  StoredTexel texel = checked_texel(header, name);
  const std::uint32_t levels = std::max(1u, header.levels);
  const std::uint64_t index_end = sizeof header + levels * sizeof(Level);
  const auto level = get<Level>(part(bytes, sizeof header, levels * sizeof(Level), "level index", name));

  Decoded decoded;
  Image& image = decoded.image;
  image = {.size = {static_cast<int>(header.width), static_cast<int>(header.height)},
           .depth = static_cast<int>(std::max({1u, header.depth, header.layers})),
           .channels = texel.channels,
           .type = texel.type,
           .samples = {}};
  decoded.slices = header.depth > 0 ? SliceKind::depth : SliceKind::layers;
  const std::uint64_t stored = static_cast<std::uint64_t>(image.shape().count()) * texel_bytes(texel);
  if (level.bytes != stored || level.uncompressed_bytes != stored || level.offset < index_end) {
    fail_input(name,
               fmt::format("its largest level is said to be {} bytes, {} uncompressed, at offset {}",
                           level.bytes, level.uncompressed_bytes, level.offset),
               fmt::format("{} bytes, behind the header", stored), "the file is cut short or corrupt");
  }
  const ByteView samples = part(bytes, level.offset, level.bytes, "largest level", name);
  check_descriptor(bytes, header, texel, decoded, name);
  read_keys(part(bytes, header.keys_offset, header.keys_bytes, "list of keys", name), decoded, name);
  if (texel.srgb) {
    decoded.notes.push_back(
        "its format is sRGB, so engines decode the samples; they are read as they are stored");
  }
  if (levels > 1) decoded.notes.push_back(fmt::format("it has {} mip levels; the largest is read", levels));

  const std::uint64_t ours = sample_bytes(image.shape(), image.channels, image.type);
  check_memory(execution, bytes.size() + ours, name);
  throw_if_stopped(execution);
  image.samples.resize(ours);
  copy_texels(texel, samples, image, 0);
  return decoded;
}

}  // namespace bn::texture
